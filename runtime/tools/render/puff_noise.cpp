#include "tools/render/puff_noise.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <vector>

namespace sgm {
namespace {

constexpr int kSide = 64;       // samples along an edge of the precomputed noise tile
constexpr int kPuffs = 4;       // puffs along an edge of the tile in the first octave
constexpr float kWorld = 1024;  // period of the noise, in metres

/// Three random numbers from a hash of three integers: pcg3d (Jarzynski and Olano, "Hash functions for GPU rendering").
glm::vec3 random3(glm::uvec3 v) {
  v = v * 1664525u + 1013904223u;
  v.x += v.y * v.z, v.y += v.z * v.x, v.z += v.x * v.y;
  v ^= v >> 16u;
  v.x += v.y * v.z, v.y += v.z * v.x, v.z += v.x * v.y;
  return glm::vec3(v >> 8u) / 16777216.0f;
}

/// Random points in the unit cube: one in each cell of a periodic grid with `cells` cells along each edge.
class Points {
 public:
  Points(int cells, uint32_t salt) : cells_(cells) {
    for (int i = 0; i < cells * cells * cells; ++i)
      points_.push_back(random3(glm::uvec3(i % cells, i / cells % cells, i / cells / cells) + salt));
  }

  /// Distance in cells from `at` to the nearest point (Worley 1996, "A cellular texture basis function").
  float nearest(glm::vec3 at) const {
    const glm::vec3 p = at * static_cast<float>(cells_);
    const glm::ivec3 cell(glm::floor(p));
    float best = 9;
    for (int i = 0; i < 27; ++i) {
      const glm::ivec3 c = cell + glm::ivec3(i % 3, i / 3 % 3, i / 9) - 1, w = (c + cells_) % cells_;
      const glm::vec3 off = glm::vec3(c) + points_[static_cast<size_t>((w.z * cells_ + w.y) * cells_ + w.x)] - p;
      best = std::min(best, glm::dot(off, off));
    }
    return std::sqrt(best);
  }

 private:
  int cells_;
  std::vector<glm::vec3> points_;
};

const std::vector<uint8_t>& puffTile() {
  static const std::vector<uint8_t> made = [] {
    const Points large(kPuffs, 11), middle(2 * kPuffs, 23), small(4 * kPuffs, 37);
    std::vector<uint8_t> values;
    for (int z = 0; z < kSide; ++z) {
      for (int y = 0; y < kSide; ++y) {
        for (int x = 0; x < kSide; ++x) {
          const glm::vec3 at = glm::vec3(x, y, z) / static_cast<float>(kSide);
          const float hollow = 0.64f * large.nearest(at) + 0.24f * middle.nearest(at) + 0.12f * small.nearest(at);
          values.push_back(static_cast<uint8_t>(std::min(1.0f, hollow) * 255));
        }
      }
    }
    return values;
  }();
  return made;
}

float tileAt(const std::vector<uint8_t>& tile, glm::vec3 p) {
  const glm::vec3 floored = glm::floor(p), f = p - floored;
  const glm::ivec3 a(floored);
  const auto at = [&](int x, int y, int z) {
    const auto wrapped = [](int i) { return static_cast<size_t>(i & (kSide - 1)); };
    return static_cast<float>(tile[(wrapped(a.z + z) * kSide + wrapped(a.y + y)) * kSide + wrapped(a.x + x)]);
  };
  const auto along = [&](int y, int z) { return glm::mix(at(0, y, z), at(1, y, z), f.x); };
  return glm::mix(glm::mix(along(0, 0), along(1, 0), f.y), glm::mix(along(0, 1), along(1, 1), f.y), f.z) / 255;
}

}  // namespace

float puffHollows(glm::vec3 position, float period, float finest) {
  // The tile's edge is kWorld divided by a power of two, so that the noise repeats after kWorld.
  float edge = std::exp2(std::round(std::log2(std::clamp(period * kPuffs, 1.0f / 16, kWorld))));
  const std::vector<uint8_t>& tile = puffTile();
  float sum = 0, weights = 0;
  constexpr std::array kWeights{0.80f, 0.15f, 0.05f};
  for (size_t i = 0; i < kWeights.size(); ++i, edge /= 8) {
    if (i > 0 && edge / kPuffs < 2 * finest) break;
    sum += kWeights[i] * tileAt(tile, position * (kSide / edge));
    weights += kWeights[i];
  }
  // The weighted mean varies little: stretch its range to 0..1.
  return std::clamp((sum / weights - 0.30f) / 0.48f, 0.0f, 1.0f);
}

}  // namespace sgm
