#pragma once
// A picture in memory, and its encoding as a PNG file.

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/file_writer.h"
#include "base/result.h"

namespace sgm {

inline constexpr int kMaxPicture = 4096;  ///< maximal width and height in pixels

/// 8-bit sRGB with alpha, rows from the top, 4 bytes a pixel without padding.
struct Image {
  int width = 0;
  int height = 0;
  std::vector<uint8_t> rgba;
};

/// Encodes a linear value of light, 0..1, for sRGB (IEC 61966-2-1).
inline float encodedSrgb(float linear) {
  return linear <= 0.0031308f ? 12.92f * linear : 1.055f * std::pow(linear, 1 / 2.4f) - 0.055f;
}

/// The bytes of a PNG file. Errors: invalid_argument if the image is empty or its sizes do not match; out_of_memory.
Result<std::vector<std::byte>> encodePng(const Image& image);

/// Writes a PNG and commits the file. Errors: those of encodePng(), io.
Result<void> writePng(const Image& image, FileWriter& file);

}  // namespace sgm
