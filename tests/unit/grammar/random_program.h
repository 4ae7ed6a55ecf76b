#pragma once
// Makes random programs with valid syntax, and often with valid meaning, for tests and as seeds for fuzzing.

#include <cstdint>
#include <string>

namespace sgm::test {

/// Makes a random program: the same seed gives the same text.
std::string randomProgram(uint64_t seed);

}  // namespace sgm::test
