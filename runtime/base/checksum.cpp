#include "base/checksum.h"

// xxHash is compiled in (header-only), so that programs that link this library do not have to link xxHash.
#define XXH_INLINE_ALL
#include <xxhash.h>

namespace sgm {

uint64_t checksum(std::span<const std::byte> bytes) { return XXH64(bytes.data(), bytes.size(), 0); }

}  // namespace sgm
