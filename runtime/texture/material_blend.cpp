#include "texture/material_blend.h"

#include <algorithm>

namespace sgm {

MaterialBlend materialBlend(const MaterialMix& a, const MaterialMix& b, const MaterialMix& c) {
  const std::array<const MaterialMix*, 3> corners{&a, &b, &c};
  std::array<uint16_t, 3 * kMaterialSamples> all{};
  for (size_t i = 0; i < 3; ++i) {
    std::copy(corners[i]->begin(), corners[i]->end(), all.begin() + static_cast<std::ptrdiff_t>(i * kMaterialSamples));
  }
  std::sort(all.begin(), all.end());
  // A material and the number of its occurrences at a triangle's corners. If counts are equal, the lower material
  // number is preferred.
  struct Counted {
    uint16_t material;
    size_t count;
  } most{all[0], 0}, next{all[0], 0};
  for (size_t first = 0; first < all.size();) {
    size_t end = first + 1;
    while (end < all.size() && all[end] == all[first]) ++end;
    const Counted here{all[first], end - first};
    if (here.count > most.count) {
      next = most;
      most = here;
    } else if (here.count > next.count) {
      next = here;
    }
    first = end;
  }
  MaterialBlend blend;
  if (next.count == 0) {
    blend.materials = {most.material, most.material};
    return blend;
  }
  blend.materials = {std::min(most.material, next.material), std::max(most.material, next.material)};
  for (size_t i = 0; i < 3; ++i) {
    const auto of = [&](uint16_t material) { return std::count(corners[i]->begin(), corners[i]->end(), material); };
    const auto low = of(blend.materials[0]), high = of(blend.materials[1]);
    if (low + high > 0) blend.share[i] = static_cast<uint8_t>((255 * high + (low + high) / 2) / (low + high));
  }
  return blend;
}

std::array<uint8_t, 3> planeShares(const std::array<double, 3>& normal) {
  std::array<double, 3> power{};
  for (size_t axis = 0; axis < 3; ++axis) power[axis] = normal[axis] * normal[axis] * normal[axis] * normal[axis];
  const double whole = power[0] + power[1] + power[2];
  std::array<uint8_t, 3> shares{};
  // Add the rounding remainder to the largest share, where it is least visible.
  int left = 255;
  size_t largest = 0;
  for (size_t axis = 0; axis < 3; ++axis) {
    shares[axis] = static_cast<uint8_t>(255 * power[axis] / whole);
    left -= shares[axis];
    if (power[axis] > power[largest]) largest = axis;
  }
  shares[largest] = static_cast<uint8_t>(shares[largest] + left);
  return shares;
}

}  // namespace sgm
