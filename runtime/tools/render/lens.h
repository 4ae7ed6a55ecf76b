#pragma once
// Converts light into a picture: adds glare in the lens, and film grain.

#include <cstdint>
#include <span>

#include "tools/render/image.h"

namespace sgm {

/// A pixel as shade.comp and compose.comp write it, two 16-bit numbers in each word. First the film's red, green and
/// blue, 0..1, linear; then red, green and blue of the light, which may exceed the film's range.
struct ExposedPixel {
  uint32_t film_red_green, film_blue_light_red, light_green_blue;
};

/// Spreads a small share of the light over the whole picture, as a lens does around very bright places (after Jimenez,
/// "Next generation post processing in Call of Duty: Advanced Warfare", 2014), and adds a fine grain. The same pixels
/// give the same bytes. pixels: width * height, rows from the top. May throw std::bad_alloc.
Image developed(std::span<const ExposedPixel> pixels, int width, int height);

}  // namespace sgm
