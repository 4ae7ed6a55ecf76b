// Replaces Highway's function that measures the clock by rdtscp when the library is loaded: valgrind rejects that
// instruction if the processor does not announce it. Nothing here reads that clock.

#include <cstdint>

namespace hwy::platform {

[[gnu::visibility("default")]] uint64_t TimerResolution() { return 1; }

}  // namespace hwy::platform
