#pragma once
// The seed of the random numbers in tests.

#include <cstdio>
#include <cstdlib>
#include <random>

namespace sgm {

/// Returns the same number in every run, so that only a change of the code can make a test fail. In the long run
/// (tests/run.sh --long) it returns a new number. SGM_SEED=n repeats a failed run; a failure of the long run needs
/// SGM_LONG=1 SGM_SEED=n, because rounds() is larger there. The caller must print the number with each failure:
/// CAPTURE(seed).
inline unsigned testSeed() {
  if (const char* chosen = std::getenv("SGM_SEED")) {
    char* end = nullptr;
    const unsigned long seed = std::strtoul(chosen, &end, 10);
    if (end == chosen || *end != '\0' || seed > 0xffffffff) {
      std::fprintf(stderr, "SGM_SEED is '%s': set it to a number from 0 to 4294967295\n", chosen);
      std::exit(2);
    }
    return static_cast<unsigned>(seed);
  }
  if (std::getenv("SGM_LONG") != nullptr) return std::random_device()();
  return 20'260'701;
}

}  // namespace sgm
