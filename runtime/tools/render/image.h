#pragma once
// A picture in memory, and its encoding as a PNG file.

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/file_writer.h"
#include "base/result.h"

namespace sgm {

inline constexpr int kMaxPicture = 4096;  ///< maximum width and height of a picture in pixels

/// Pixels in 8-bit sRGB with alpha: 4 bytes each, rows from the top, without padding.
struct Image {
  int width = 0;
  int height = 0;
  std::vector<uint8_t> rgba;
};

/// Encodes a linear light value, 0..1, as sRGB (IEC 61966-2-1).
inline float encodedSrgb(float linear) {
  return linear <= 0.0031308f ? 12.92f * linear : 1.055f * std::pow(linear, 1 / 2.4f) - 0.055f;
}

/// Encodes the image as a PNG file and returns its bytes. Errors: invalid_argument if the image is empty or its byte
/// count does not match its size; out_of_memory.
Result<std::vector<std::byte>> encodePng(const Image& image);

/// Writes the image as PNG and commits the file. Errors: io and the errors of encodePng().
Result<void> writePng(const Image& image, FileWriter& file);

}  // namespace sgm
