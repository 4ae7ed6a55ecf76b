#pragma once
// Masters from outside, as JSON: all that a base holds, or nothing.

#include <optional>
#include <string>
#include <string_view>

#include "tools/classify/base.h"

namespace sgm::masters {

/// Beside these, keys as binsOf() and checkHistogram() have them.
inline constexpr size_t kMostSetBytes = size_t{4} << 20, kMostSetKeys = 256, kMostSetMasters = 10'000;

struct ReadSet {
  std::optional<MasterSet> set;  ///< there where nothing is wrong
  bool malformed = false;        ///< it is no JSON at all
  std::string what;              ///< is wrong first, in one line; of JSON that is well formed without the place
  std::string pointer;           ///< the place (RFC 6901); "" is also the whole text
};

/// {"masters": [{"class", "name", "models", "key", "shares"}, ...], "limits": [{"key", "mse", "emd"}, ...]}, each key
/// {"mode", "bins", "length", "density", "version"}. What else `sgm inspect --list-masters` says is passed over, and
/// any other member refused. A set is taken where every key has limits, once, and one master at least; names are short
/// texts, unique in their class and key; and shares are what a histogram of that key may be. Linear in the text's size.
ReadSet readSet(std::string_view json);

}  // namespace sgm::masters
