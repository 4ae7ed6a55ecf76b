#pragma once
// Sets a specialization constant of a shader and removes the code that becomes unreachable.

#include <cstdint>
#include <span>
#include <vector>

#include "base/result.h"

namespace sgm {

/// Returns the SPIR-V module `code` with specialization constant 0 set to `constant`, without the branches and
/// functions that this makes unreachable. A driver would remove them too, but only after inlining all calls: a software
/// Vulkan device then spends seconds on unused material patterns. Errors: unsupported if `code` is not SPIR-V for
/// Vulkan 1.2; out_of_memory. Thread-safe.
Result<std::vector<uint32_t>> specialized(std::span<const uint32_t> code, uint32_t constant);

}  // namespace sgm
