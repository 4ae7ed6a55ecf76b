#pragma once
// The checkerboard texture that shows how texture coordinates lie.

#include <cstddef>
#include <vector>

#include "base/result.h"

namespace sgm::cli {

/// A .png file of one tile: 2 x 2 squares, a red line along u and a green one along v.
Result<std::vector<std::byte>> chequerPng();

}  // namespace sgm::cli
