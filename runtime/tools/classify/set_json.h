#pragma once
// Reads external reference histograms from JSON, completely or not at all.

#include <optional>
#include <string>
#include <string_view>

#include "tools/classify/base.h"

namespace sgm::masters {

/// In addition to these, keys have the limits of binsOf() and checkHistogram().
inline constexpr size_t kMostSetBytes = size_t{4} << 20, kMostSetKeys = 256, kMostSetMasters = 10'000;

struct ReadSet {
  std::optional<MasterSet> set;  ///< set if there is no problem
  bool malformed = false;        ///< the text is not JSON
  std::string what;              ///< the first problem, in one line; for well-formed JSON without the place
  std::string pointer;           ///< the place (RFC 6901); "" also means the whole text
};

/// {"masters": [{"class", "name", "models", "key", "shares"}, ...], "limits": [{"key", "mse", "emd"}, ...]}, each key
/// {"mode", "bins", "length", "density", "version"}. Further members of `sgm inspect --list-masters` are ignored; any
/// others are errors. Every key needs limits exactly once, and at least one reference histogram; names are short, and
/// unique in their class and key; shares must be valid for a histogram of that key. Linear in the text's size.
ReadSet readSet(std::string_view json);

}  // namespace sgm::masters
