#pragma once
// The program hash of version 0.2, computed from the texts that printMeaning() prints and from the assets. Needed to
// find journals and stores written by version 0.2.

#include <cstdint>

#include "grammar/syntax/program.h"

namespace sgm {

/// On the first call, parses and prints the program's files again, which takes milliseconds; caches the hash in
/// Program::former_hash. Thread-safe. Throws std::bad_alloc.
uint64_t formerHash(const Program& program);

}  // namespace sgm
