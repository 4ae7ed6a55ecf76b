#pragma once
// The checkerboard texture that shows how texture coordinates lie.

#include <cstddef>
#include <vector>

#include "base/result.h"

namespace sgm::cli {

/// The bytes of a .png file with one tile of the texture: 2 x 2 squares, a red line along u and a green line along v.
Result<std::vector<std::byte>> checkerboardPng();

}  // namespace sgm::cli
