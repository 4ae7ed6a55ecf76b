#pragma once
// Materials that pass into each other: of each triangle the two that it shows most of, and how much of each at its
// corners. And how a place is textured by three planes, where no shape has coordinates for it.

#include <array>
#include <cstddef>
#include <cstdint>

namespace sgm {

/// Materials at a vertex and at eight places around it on the surface.
inline constexpr size_t kMaterialSamples = 9;
using MaterialMix = std::array<uint16_t, kMaterialSamples>;

/// Two materials, rising, both the same where a triangle has but one. share: of the second at each corner, in 255ths.
struct MaterialBlend {
  std::array<uint16_t, 2> materials{};
  std::array<uint8_t, 3> share{};
  friend bool operator==(const MaterialBlend&, const MaterialBlend&) = default;
};

/// Of a triangle with these corners. Corners of two triangles have the same share where these show the same two
/// materials. Pure; the same for corners in another order, as far as their shares go with them.
MaterialBlend materialBlend(const MaterialMix& a, const MaterialMix& b, const MaterialMix& c);

/// How much of the planes across x, y and z a surface with this normal (any length but 0) takes, together 255: by the
/// fourth powers of its parts.
std::array<uint8_t, 3> planeShares(const std::array<double, 3>& normal);

}  // namespace sgm
