#include "tools/render/light_filter.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

namespace sgm {
namespace {

constexpr std::array<float, 5> kSpline{1.0f / 16, 1.0f / 4, 3.0f / 8, 1.0f / 4, 1.0f / 16};  // B3 spline

/// Weight with which the light at element b contributes to the filtered light at element a. The weight is large if the
/// surfaces at a and b lie in one plane and have similar normals.
float kinship(const Guides& guides, size_t a, size_t b, float apart) {
  const glm::vec4 &pa = guides.positions[a], &pb = guides.positions[b];
  if (pb.w < 0) return 0;
  const float off = std::abs(glm::dot(glm::vec3(pb) - glm::vec3(pa), guides.normals[a])) / (pa.w * apart + 1e-6f);
  if (off > 4) return 0;
  const float facing = std::max(0.0f, glm::dot(guides.normals[a], guides.normals[b]));
  const float f2 = facing * facing, f4 = f2 * f2, f8 = f4 * f4;
  return f8 * f4 * std::exp(-off);
}

/// Calls body(at, tell) for the index `at` of each element that has a surface. `tell` is a function for the use of
/// `body`: tell(add) calls add(neighbour, weight) for each element of the filter kernel around `at`.
template <class Body>
void overNeighbours(const Guides& guides, int step, float element, JobSystem& jobs, Body body) {
  parallelFor(jobs, guides.height, [&](size_t row) {
    const auto y = static_cast<int>(row), width = static_cast<int>(guides.width),
               height = static_cast<int>(guides.height);
    const float apart = 2.0f * element * static_cast<float>(step);
    for (int x = 0; x < width; ++x) {
      const size_t at = row * guides.width + static_cast<size_t>(x);
      if (guides.positions[at].w < 0) continue;
      body(at, [&](auto add) {
        for (int j = -2; j <= 2; ++j) {
          for (int i = -2; i <= 2; ++i) {
            const int u = x + i * step, v = y + j * step;
            if (u < 0 || v < 0 || u >= width || v >= height) continue;
            const size_t other = static_cast<size_t>(v) * guides.width + static_cast<size_t>(u);
            const float w = kSpline[static_cast<size_t>(i + 2)] * kSpline[static_cast<size_t>(j + 2)];
            add(other, other == at ? w : w * kinship(guides, at, other, apart));
          }
        }
      });
    }
  });
}

}  // namespace

void filterSoft(std::vector<SoftLight>& light, const Guides& guides, float element, JobSystem& jobs) {
  std::vector<SoftLight> next(light);
  for (const int step : {1, 2, 4, 8}) {
    overNeighbours(guides, step, element, jobs, [&](size_t at, auto tell) {
      SoftLight sum;
      float weights = 0, near = 0;
      tell([&](size_t other, float weight) {
        sum.light += weight * light[other].light;
        sum.lean += weight * light[other].lean;
        near += weight * light[other].lie.x;
        weights += weight;
      });
      // Filter only lie.x (the share of directions in which a surface is near): it is the mean of samples, and thus
      // noisy. The other components are exact, and their sharp edges must stay.
      const glm::vec4 lie(near / weights, light[at].lie.y, light[at].lie.z, light[at].lie.w);
      next[at] = {sum.light / weights, sum.lean / weights, lie};
    });
    light.swap(next);
  }
}

void filterDirect(std::vector<DirectLight>& light, const Guides& guides, float element, JobSystem& jobs) {
  std::vector<DirectLight> next(light);
  overNeighbours(guides, 1, element, jobs, [&](size_t at, auto tell) {
    std::array<float, 8> sums{};
    float weights = 0;
    tell([&](size_t other, float weight) {
      weights += weight;
      for (uint32_t i = 0; i < 8; ++i)
        sums[i] += weight * static_cast<float>(light[other].open[i / 4] >> (8 * (i % 4)) & 255u);
    });
    next[at].open[0] = next[at].open[1] = 0;
    for (uint32_t i = 0; i < 8; ++i)
      next[at].open[i / 4] |= static_cast<uint32_t>(sums[i] / weights + 0.5f) << (8 * (i % 4));
  });
  light.swap(next);
}

}  // namespace sgm
