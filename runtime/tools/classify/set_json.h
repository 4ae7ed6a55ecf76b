#pragma once
// Reads external reference histograms from JSON, completely or not at all.

#include <optional>
#include <string>
#include <string_view>

#include "tools/classify/base.h"

namespace sgm::masters {

/// Maximum numbers of bytes of the JSON text, of keys, and of reference histograms. Each key and its histograms must
/// also be valid for binsOf() and checkHistogram().
inline constexpr size_t kMaxSetBytes = size_t{4} << 20, kMaxSetKeys = 256, kMaxSetMasters = 10'000;

struct ReadSet {
  std::optional<MasterSet> set;  ///< set if the whole text is valid
  bool malformed = false;        ///< true if the text is not JSON
  std::string what;     ///< the first problem, in one line; without its position in the text if the JSON is well-formed
  std::string pointer;  ///< JSON pointer (RFC 6901) to the wrong value; "" if the text as a whole is wrong, for example
                        ///< if it is not JSON
};

/// Parses {"masters": [{"class", "name", "models", "key", "shares"}, ...], "limits": [{"key", "mse", "emd"}, ...]},
/// where each key is {"mode", "bins", "length", "density", "version"}. Other members that `sgm inspect --list-masters`
/// writes are ignored; any further members are errors. Every key needs limits exactly once, and at least one reference
/// histogram; names must be short, and unique in their class and key; shares must be valid for a histogram of that key.
/// Takes time linear in the text's size.
ReadSet readSet(std::string_view json);

}  // namespace sgm::masters
