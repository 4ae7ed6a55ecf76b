#pragma once
// The identity that version 0.2 gave a program: a hash of its meaning as printed text. Journals and stores of 0.2 are
// found by it.

#include <cstdint>

#include "grammar/syntax/program.h"

namespace sgm {

/// Parses and prints the program's files again at the first call, which takes milliseconds, and keeps the number in the
/// program. Thread-safe. Throws std::bad_alloc.
uint64_t formerHash(const Program& program);

}  // namespace sgm
