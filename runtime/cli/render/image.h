#pragma once
// A picture in memory, and as a PNG file.

#include <cstdint>
#include <string>
#include <vector>

#include "base/result.h"

namespace sgm {

/// 8-bit sRGB with alpha, rows from the top, 4 bytes a pixel without padding.
struct Image {
  int width = 0;
  int height = 0;
  std::vector<uint8_t> rgba;
};

/// Writes a PNG beside `path` and renames it into place, so that no reader sees half a picture and a failure leaves
/// nothing behind. Errors: invalid_argument (empty, or sizes that do not match), io (with the path and the reason).
Result<void> writePng(const std::string& path, const Image& image);

}  // namespace sgm
