#pragma once
// Reads the origin of the positions from a file that this library exported.

#include <cstddef>
#include <span>

#include "asset/point.h"

namespace sgm::asset {

/// Returns the origin in metres, which mesh/export/export.h writes into every format: exported positions are relative
/// to it, because floats are precise near 0. {0, 0, 0} for any other file. Reads only the file's first megabyte.
Point originOf(std::span<const std::byte> bytes);

}  // namespace sgm::asset
