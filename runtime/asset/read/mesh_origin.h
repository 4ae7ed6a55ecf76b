#pragma once
// Reads the origin of the positions from a mesh file that this library exported.

#include <cstddef>
#include <span>

#include "asset/point.h"

namespace sgm::asset {

/// Returns the world position of the file's origin in metres; {0, 0, 0} for a file of another program. Exported
/// positions are relative to this origin, because floats are precise near 0; mesh/export/export.h writes the origin
/// into every format. Reads only the file's first megabyte.
Point originOf(std::span<const std::byte> bytes);

}  // namespace sgm::asset
