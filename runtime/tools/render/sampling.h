#pragma once
// Random numbers and directions for ray tracing, reproducible for each pixel.

#include <cmath>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace sgm {

/// A low-discrepancy sequence: points that cover the unit square evenly, however many are drawn (Roberts, "The
/// unreasonable effectiveness of quasirandom sequences", 2018). Each pixel and each purpose gets its own random offset.
class UnitPoints {
 public:
  UnitPoints(uint32_t x, uint32_t y, uint32_t purpose) {
    uint32_t h = x * 0x9E3779B1u ^ (y * 0x85EBCA77u + purpose * 0xC2B2AE3Du);
    shift_ = {part(h), part(h)};
  }

  glm::vec2 next() {
    ++count_;
    return glm::fract(shift_ + static_cast<float>(count_) * glm::vec2(0.7548776662f, 0.5698402910f));
  }

 private:
  static float part(uint32_t& h) {
    h ^= h >> 16;
    h *= 0x7FEB352Du;
    h ^= h >> 15;
    h *= 0x846CA68Bu;
    h ^= h >> 16;
    return static_cast<float>(h >> 8) / 16777216.0f;
  }

  glm::vec2 shift_{0};
  int count_ = 0;
};

/// Two unit vectors perpendicular to a unit normal and to each other (Duff et al., "Building an orthonormal basis,
/// revisited", 2017).
struct Across {
  glm::vec3 x, y;

  explicit Across(glm::vec3 n) {
    const float sign = std::copysign(1.0f, n.z), a = -1 / (sign + n.z), b = n.x * n.y * a;
    x = {1 + sign * n.x * n.x * a, sign * b, -sign * n.x};
    y = {b, sign + n.y * n.y * a, -n.y};
  }
};

/// Maps the unit square to the unit disc. The concentric map of Shirley and Chiu would be more even; this one suffices,
/// since a filter smooths the results.
inline glm::vec2 onDisc(glm::vec2 unit) {
  const float r = std::sqrt(unit.x), angle = 6.28318531f * unit.y;
  return r * glm::vec2(std::cos(angle), std::sin(angle));
}

/// A random direction in the hemisphere around the unit normal n, with a density proportional to the cosine.
inline glm::vec3 cosineDirection(glm::vec3 n, glm::vec2 unit) {
  const glm::vec2 at = onDisc(unit);
  const Across across(n);
  return at.x * across.x + at.y * across.y + std::sqrt(std::max(0.0f, 1 - unit.x)) * n;
}

}  // namespace sgm
