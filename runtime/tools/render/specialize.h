#pragma once
// Specializes a shader for a given constant, so that a driver does not process unreachable code.

#include <cstdint>
#include <span>
#include <vector>

#include "base/result.h"

namespace sgm {

/// The SPIR-V module `code` with specialization constant 0 set to `constant`, without the branches and functions that
/// this makes unreachable. A driver would also remove them, but only after inlining all calls: software Vulkan devices
/// then spend seconds on unused material patterns. Errors: `unsupported` if `code` is not SPIR-V for Vulkan 1.2,
/// `out_of_memory`. Thread-safe.
Result<std::vector<uint32_t>> specialized(std::span<const uint32_t> code, uint32_t constant);

}  // namespace sgm
