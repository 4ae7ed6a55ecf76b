#pragma once
// Checksums of bytes that come back from a disk or a network.

#include <cstddef>
#include <cstdint>
#include <span>

namespace sgm {

/// XXH64 with seed 0: finds damage, not malice. The same on every machine.
uint64_t checksum(std::span<const std::byte> bytes);

}  // namespace sgm
