#pragma once
// Checksums that detect damage of bytes read from a disk or a network.

#include <cstddef>
#include <cstdint>
#include <span>

namespace sgm {

/// XXH64 with seed 0; the value is the same on every machine. It detects accidental damage, but not malicious changes.
uint64_t checksum(std::span<const std::byte> bytes);

}  // namespace sgm
