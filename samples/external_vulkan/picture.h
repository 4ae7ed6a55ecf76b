#pragma once
// Pictures in host memory: compares them, and writes PNG files.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

struct Picture {
  uint32_t width = 0, height = 0;
  std::vector<uint8_t> rgba;  ///< four bytes for each pixel, rows from the top

  size_t pixels() const { return rgba.size() / 4; }
  /// Number of pixels without a surface: their alpha is 0.
  size_t uncovered() const {
    size_t count = 0;
    for (size_t i = 3; i < rgba.size(); i += 4) count += rgba[i] == 0;
    return count;
  }
  /// Number of pixels that differ from another picture of the same size.
  size_t differences(const Picture& other) const {
    size_t count = 0;
    for (size_t i = 0; i < rgba.size(); i += 4) count += !std::equal(&rgba[i], &rgba[i] + 4, &other.rgba[i]);
    return count;
  }
};

/// Throws if the file cannot be written.
void writePng(const Picture& picture, const std::string& path);
