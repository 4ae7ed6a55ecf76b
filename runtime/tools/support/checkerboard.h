#pragma once
// A checkerboard texture, which shows the layout of texture coordinates.

#include <cstddef>
#include <vector>

#include "base/result.h"

namespace sgm::cli {

/// One tile of the texture as a PNG file: 2 x 2 squares, with a red line along u and a green line along v.
Result<std::vector<std::byte>> checkerboardPng();

}  // namespace sgm::cli
