// Highway measures its clock by rdtscp as it is loaded, which valgrind refuses where the processor does not announce
// that instruction. Nothing here reads that clock: this stands in the place of the library's own function.

#include <cstdint>

namespace hwy::platform {

[[gnu::visibility("default")]] uint64_t TimerResolution() { return 1; }

}  // namespace hwy::platform
