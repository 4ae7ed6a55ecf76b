#pragma once
// Makes random programs for tests and as seeds for fuzzing. Their syntax is valid, and many also have no other errors.

#include <cstdint>
#include <string>

namespace sgm::test {

/// Makes a random program: the same seed gives the same text.
std::string randomProgram(uint64_t seed);

}  // namespace sgm::test
