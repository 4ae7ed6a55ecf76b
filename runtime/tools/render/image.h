#pragma once
// A picture in memory, and as a PNG file.

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/file_writer.h"
#include "base/result.h"

namespace sgm {

inline constexpr int kMaxPicture = 4096;  ///< pixels of an edge

/// 8-bit sRGB with alpha, rows from the top, 4 bytes a pixel without padding.
struct Image {
  int width = 0;
  int height = 0;
  std::vector<uint8_t> rgba;
};

/// sRGB's encoding of a share of light, 0..1 (IEC 61966-2-1).
inline float encodedSrgb(float linear) {
  return linear <= 0.0031308f ? 12.92f * linear : 1.055f * std::pow(linear, 1 / 2.4f) - 0.055f;
}

/// The bytes of a PNG file. Errors: invalid_argument (empty, or sizes that do not match), out_of_memory.
Result<std::vector<std::byte>> encodePng(const Image& image);

/// Writes a PNG and commits the file. Errors: invalid_argument (empty, or sizes that do not match), out_of_memory, io.
Result<void> writePng(const Image& image, FileWriter& file);

}  // namespace sgm
