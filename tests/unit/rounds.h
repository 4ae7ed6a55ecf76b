#pragma once
// How often a property is tried on something random.

#include <algorithm>
#include <cstdlib>

namespace sgm {

/// As often as said, and ten times as often in the long run (tests/run.sh --long). Under a sanitizer, which looks for
/// other faults than the property's and is slow, a fifth of that.
inline unsigned rounds(unsigned often) {
  if (std::getenv("SGM_LONG") != nullptr) often *= 10;
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  often /= 5;
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
  often /= 5;
#endif
#endif
  return std::max(often, 1u);
}

}  // namespace sgm
