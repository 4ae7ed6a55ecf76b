#pragma once
// What shows how a texture lies.

#include <cstddef>
#include <vector>

#include "base/result.h"

namespace sgm::cli {

/// A .png file of one tile: 2 x 2 fields, a red line along u and a green one along v.
Result<std::vector<std::byte>> chequerPng();

}  // namespace sgm::cli
