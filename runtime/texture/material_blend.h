#pragma once
// Blends materials: for each triangle, the two materials that it shows most, and their shares at its corners. Also the
// weights of triplanar mapping, for surfaces whose shape has no coordinates.

#include <array>
#include <cstddef>
#include <cstdint>

namespace sgm {

/// The materials at a vertex and at eight positions around it on the surface.
inline constexpr size_t kMaterialSamples = 9;
using MaterialMix = std::array<uint16_t, kMaterialSamples>;

/// Two materials in ascending order, equal if a triangle has only one. share: of the second at each corner, in 255ths.
struct MaterialBlend {
  std::array<uint16_t, 2> materials{};
  std::array<uint8_t, 3> share{};
  friend bool operator==(const MaterialBlend&, const MaterialBlend&) = default;
};

/// The blend of a triangle with these corners. If two triangles show the same two materials, a common corner has the
/// same share in both. Pure; if the corners are permuted, only their shares are permuted.
MaterialBlend materialBlend(const MaterialMix& a, const MaterialMix& b, const MaterialMix& c);

/// The weights of the planes across x, y and z for a surface with this normal (any length but 0), by the fourth powers
/// of its components; their sum is 255.
std::array<uint8_t, 3> planeShares(const std::array<double, 3>& normal);

}  // namespace sgm
