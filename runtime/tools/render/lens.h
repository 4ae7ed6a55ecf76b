#pragma once
// What a camera makes of the light that comes to it: glare in the lens, and the grain of the film.

#include <cstdint>
#include <span>

#include "tools/render/image.h"

namespace sgm {

/// A pixel as shade.comp and compose.comp write it: two numbers of 16 bits a word. The film's red, green and blue,
/// 0..1, linear, then the light's, which the film may be too small for.
struct ExposedPixel {
  uint32_t film_red_green, film_blue_light_red, light_green_blue;
};

/// Spreads a small share of the light over the whole picture, as glass does, which is seen around what is far brighter
/// than white (after Jimenez, "Next generation post processing in Call of Duty: Advanced Warfare", 2014), and adds a
/// fine grain. The same pixels give the same bytes. pixels: width * height, rows from the top. May throw
/// std::bad_alloc.
Image developed(std::span<const ExposedPixel> pixels, int width, int height);

}  // namespace sgm
