#pragma once
// The number of random cases in the test of a property.

#include <algorithm>
#include <cstdlib>

namespace sgm {

/// Returns the number of cases to test: `often`, or ten times as many in the long run (tests/run.sh --long); with a
/// sanitizer, which is slow and looks for other faults, a fifth of that.
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
