#pragma once
// Programs that are right by syntax and often by meaning, for tests and fuzzing seeds.

#include <cstdint>
#include <string>

namespace sgm::test {

/// The same text for the same seed.
std::string randomProgram(uint64_t seed);

}  // namespace sgm::test
