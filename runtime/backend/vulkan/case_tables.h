#pragma once
// The case tables of mesh/tables.h, packed into 32-bit words for descriptor binding 5 of the mesher's shaders.

#include <cstdint>
#include <vector>

namespace sgm {
namespace case_layout {

using uint = uint32_t;
#include "mesher/case_layout.h"

}  // namespace case_layout

/// Returns case_layout::kTableWords words, the same on every call.
std::vector<uint32_t> caseTables();

}  // namespace sgm
