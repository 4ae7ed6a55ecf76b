#include "base/checksum.h"

// Compiled in, so that whoever links the library needs nothing of it.
#define XXH_INLINE_ALL
#include <xxhash.h>

namespace sgm {

uint64_t checksum(std::span<const std::byte> bytes) { return XXH64(bytes.data(), bytes.size(), 0); }

}  // namespace sgm
