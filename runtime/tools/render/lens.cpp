#include "tools/render/lens.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/packing.hpp>
#include <glm/vec3.hpp>
#include <vector>

namespace sgm {
namespace {

constexpr float kGlare = 0.045f;  // share of the light that the lens scatters
// Limit of a pixel's light in multiples of white, so that glints in single pixels do not dominate the glare.
constexpr float kBrightest = 24.0f;
constexpr float kGrain = 0.010f;  // strength of the film grain in a medium grey pixel, as a share of the sRGB range
/// Shares of the scattered light in successive blurs, each twice as wide as the previous one.
constexpr std::array kSpread = {0.16f, 0.18f, 0.17f, 0.15f, 0.13f, 0.11f, 0.10f};

/// Light of each pixel of a picture, at full or reduced resolution.
struct LightMap {
  LightMap(int w, int h) : width(w), height(h), light(static_cast<size_t>(w) * static_cast<size_t>(h)) {}

  glm::vec3& at(int x, int y) { return light[index(x, y)]; }
  const glm::vec3& at(int x, int y) const { return light[index(x, y)]; }

  int width, height;
  std::vector<glm::vec3> light;

 private:
  size_t index(int x, int y) const {
    const auto column = static_cast<size_t>(std::clamp(x, 0, width - 1));
    return static_cast<size_t>(std::clamp(y, 0, height - 1)) * static_cast<size_t>(width) + column;
  }
};

LightMap halved(const LightMap& map) {
  LightMap half((map.width + 1) / 2, (map.height + 1) / 2);
  for (int y = 0; y < half.height; ++y) {
    for (int x = 0; x < half.width; ++x) {
      half.at(x, y) = 0.25f * (map.at(2 * x, 2 * y) + map.at(2 * x + 1, 2 * y) + map.at(2 * x, 2 * y + 1) +
                               map.at(2 * x + 1, 2 * y + 1));
    }
  }
  return half;
}

/// Upsamples `half`, which has half of the map's size, with smooth interpolation and adds it to `map`.
void addDoubled(LightMap& map, const LightMap& half) {
  for (int y = 0; y < map.height; ++y) {
    const int row = y / 2, beside_row = y % 2 == 0 ? row - 1 : row + 1;
    for (int x = 0; x < map.width; ++x) {
      const int column = x / 2, beside = x % 2 == 0 ? column - 1 : column + 1;
      const glm::vec3 near = 0.75f * half.at(column, row) + 0.25f * half.at(beside, row);
      const glm::vec3 next = 0.75f * half.at(column, beside_row) + 0.25f * half.at(beside, beside_row);
      map.at(x, y) += 0.75f * near + 0.25f * next;
    }
  }
}

/// The part of the light that the lens scatters, at the same resolution.
LightMap glareOf(LightMap light) {
  std::vector<LightMap> maps;
  maps.push_back(halved(light));
  while (maps.size() < kSpread.size()) maps.push_back(halved(maps.back()));
  for (size_t i = 0; i < maps.size(); ++i) {
    for (glm::vec3& one : maps[i].light) one *= kGlare * kSpread[i];
  }
  for (size_t i = maps.size(); --i > 0;) addDoubled(maps[i - 1], maps[i]);
  std::ranges::fill(light.light, glm::vec3(0));
  addDoubled(light, maps[0]);
  return light;
}

/// A pseudorandom number from 0 to 1 (O'Neill's PCG, used as a hash).
float chance(uint32_t& state) {
  state = state * 747796405u + 2891336453u;
  const uint32_t word = ((state >> ((state >> 28u) + 4u)) ^ state) * 277803737u;
  return static_cast<float>((word >> 22u) ^ word) * 0x1p-32f;
}

/// The colour with each channel clamped to 0..limit. NaN becomes 0, since the blurs would spread it over the whole
/// picture.
glm::vec3 held(const glm::vec3& c, float limit) {
  const auto one = [&](float v) { return v > 0 ? std::min(v, limit) : 0.0f; };
  return {one(c.x), one(c.y), one(c.z)};
}

}  // namespace

Image developed(std::span<const ExposedPixel> pixels, int width, int height) {
  LightMap light(width, height);
  for (size_t i = 0; i < pixels.size(); ++i) {
    const glm::vec2 middle = glm::unpackHalf2x16(pixels[i].film_blue_light_red);
    const glm::vec2 last = glm::unpackHalf2x16(pixels[i].light_green_blue);
    light.light[i] = held(glm::vec3(middle.y, last.x, last.y), kBrightest);
  }
  const LightMap glare = glareOf(std::move(light));
  Image image;
  image.width = width;
  image.height = height;
  image.rgba.resize(4 * pixels.size());
  for (size_t i = 0; i < pixels.size(); ++i) {
    const glm::vec2 first = glm::unpackHalf2x16(pixels[i].film_red_green);
    const glm::vec3 film = held({first.x, first.y, glm::unpackHalf2x16(pixels[i].film_blue_light_red).x}, 1);
    const glm::vec3 added = glare.light[i] / (1.0f + glare.light[i]);
    const glm::vec3 lit = film * (1 - kGlare) + (1.0f - film) * added;
    auto state = static_cast<uint32_t>(i);
    float grain = -2;  // sum of four uniform random numbers minus its mean of 2: nearly Gaussian
    for (int draw = 0; draw < 4; ++draw) grain += chance(state);
    for (int channel = 0; channel < 3; ++channel) {
      const float value = encodedSrgb(std::clamp(lit[channel], 0.0f, 1.0f));
      // Film grain is strongest in medium greys. Noise of half a quantization step, added everywhere, prevents banding
      // in dark gradients.
      const float rough = kGrain * 4 * value * (1 - value) * grain * 1.7f + (chance(state) - 0.5f) / 255;
      image.rgba[4 * i + static_cast<size_t>(channel)] =
          static_cast<uint8_t>(std::clamp(value + rough, 0.0f, 1.0f) * 255 + 0.5f);
    }
    image.rgba[4 * i + 3] = 255;
  }
  return image;
}

}  // namespace sgm
