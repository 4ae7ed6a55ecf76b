#pragma once
// Where the positions of a file that we exported count from.

#include <cstddef>
#include <span>

#include "asset/point.h"

namespace sgm::asset {

/// Metres, as mesh/export/export.h writes it into every format: exports keep their positions near 0, where floats are
/// fine. {0, 0, 0} of any other file. Looks at the file's first megabyte alone.
Point originOf(std::span<const std::byte> bytes);

}  // namespace sgm::asset
