// Replaces Highway's function TimerResolution, which executes rdtscp when the library is loaded: valgrind rejects that
// instruction if the processor does not announce it. No code here uses Highway's timer.

#include <cstdint>

namespace hwy::platform {

[[gnu::visibility("default")]] uint64_t TimerResolution() { return 1; }

}  // namespace hwy::platform
