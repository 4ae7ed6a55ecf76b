#pragma once
// A shader made for the constants that it will have, so that a driver reads nothing that cannot run.

#include <cstdint>
#include <span>
#include <vector>

#include "base/result.h"

namespace sgm {

/// The SPIR-V module `code` with its specialization constant 0 set to `constant`: branches that cannot be taken are
/// gone, and with them the functions that nothing else calls. A driver would drop them too, but first it writes all
/// calls out: software Vulkan spends seconds on the patterns of materials that a scene does not have.
/// Errors: `unsupported` if `code` is not SPIR-V for Vulkan 1.2, `out_of_memory`. Thread-safe.
Result<std::vector<uint32_t>> specialized(std::span<const uint32_t> code, uint32_t constant);

}  // namespace sgm
