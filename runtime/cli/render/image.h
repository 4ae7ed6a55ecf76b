#pragma once
// A picture in memory, and as a PNG file.

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

/// The bytes of a PNG file. Errors: invalid_argument (empty, or sizes that do not match), out_of_memory.
Result<std::vector<std::byte>> encodePng(const Image& image);

/// Writes a PNG and commits the file. Errors: invalid_argument (empty, or sizes that do not match), out_of_memory, io.
Result<void> writePng(const Image& image, FileWriter& file);

}  // namespace sgm
