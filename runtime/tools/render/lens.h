#pragma once
// Converts light into a picture: adds glare of the lens and film grain.

#include <cstdint>
#include <span>

#include "tools/render/image.h"

namespace sgm {

/// A pixel in the layout that shade.comp and compose.comp write: six half floats, two in each word. First red, green
/// and blue of the tone-mapped film colour, linear, 0..1; then red, green and blue of the light itself, which may
/// exceed 1.
struct ExposedPixel {
  uint32_t film_red_green, film_blue_light_red, light_green_blue;
};

/// Adds glare and a fine film grain. Glare: a real lens spreads a small share of the light of very bright places over
/// the whole picture (after Jimenez, "Next generation post processing in Call of Duty: Advanced Warfare", 2014). The
/// same pixels give the same bytes. pixels: width * height, rows from the top. May throw std::bad_alloc.
Image developed(std::span<const ExposedPixel> pixels, int width, int height);

}  // namespace sgm
