#pragma once
// The origin of the positions in a file exported by this library.

#include <cstddef>
#include <span>

#include "asset/point.h"

namespace sgm::asset {

/// In metres, as mesh/export/export.h writes it into every format: exports keep their positions near 0, where floats
/// are precise. {0, 0, 0} for any other file. Reads only the file's first megabyte.
Point originOf(std::span<const std::byte> bytes);

}  // namespace sgm::asset
