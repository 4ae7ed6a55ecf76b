#include "tools/support/checkerboard.h"

#include <array>

#include "tools/render/image.h"

namespace sgm::cli {
namespace {

constexpr int kCheckerboardPixels = 128;

}  // namespace

Result<std::vector<std::byte>> checkerboardPng() {
  using Colour = std::array<uint8_t, 4>;
  constexpr Colour kDark{150, 150, 150, 255}, kLight{225, 225, 225, 255}, kAlongU{200, 60, 50, 255},
      kAlongV{60, 160, 70, 255};
  Image image{kCheckerboardPixels, kCheckerboardPixels, {}};
  const int half = kCheckerboardPixels / 2, line = kCheckerboardPixels / 32;
  for (int y = 0; y < kCheckerboardPixels; ++y) {
    for (int x = 0; x < kCheckerboardPixels; ++x) {
      const Colour& field = (x < half) != (y < half) ? kDark : kLight;
      const Colour& colour = y < line ? kAlongU : x < line ? kAlongV : field;
      image.rgba.insert(image.rgba.end(), colour.begin(), colour.end());
    }
  }
  return encodePng(image);
}

}  // namespace sgm::cli
