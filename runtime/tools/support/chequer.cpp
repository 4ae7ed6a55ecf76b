#include "tools/support/chequer.h"

#include <array>

#include "tools/render/image.h"

namespace sgm::cli {
namespace {

constexpr int kChequerPixels = 128;

}  // namespace

Result<std::vector<std::byte>> chequerPng() {
  using Colour = std::array<uint8_t, 4>;
  constexpr Colour kDark{150, 150, 150, 255}, kLight{225, 225, 225, 255}, kAlongU{200, 60, 50, 255},
      kAlongV{60, 160, 70, 255};
  Image image{kChequerPixels, kChequerPixels, {}};
  const int half = kChequerPixels / 2, line = kChequerPixels / 32;
  for (int y = 0; y < kChequerPixels; ++y) {
    for (int x = 0; x < kChequerPixels; ++x) {
      const Colour& field = (x < half) != (y < half) ? kDark : kLight;
      const Colour& colour = y < line ? kAlongU : x < line ? kAlongV : field;
      image.rgba.insert(image.rgba.end(), colour.begin(), colour.end());
    }
  }
  return encodePng(image);
}

}  // namespace sgm::cli
