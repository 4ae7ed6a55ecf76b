#pragma once
// Blends materials: finds the two materials that occur most at a triangle's corners, and their shares there. Also
// computes the weights of triplanar mapping, for surfaces whose shape has no coordinates.

#include <array>
#include <cstddef>
#include <cstdint>

namespace sgm {

/// Number of places at which the materials of a vertex are sampled: itself, and eight positions around it on the
/// surface.
inline constexpr size_t kMaterialSamples = 9;
using MaterialMix = std::array<uint16_t, kMaterialSamples>;

/// Two materials in ascending order, equal if a triangle has only one; and the share of the second material at each
/// corner, in 255ths.
struct MaterialBlend {
  std::array<uint16_t, 2> materials{};
  std::array<uint8_t, 3> share{};
  friend bool operator==(const MaterialBlend&, const MaterialBlend&) = default;
};

/// Returns the blend of a triangle with these corners. If two triangles have the same two materials, a common corner
/// has the same share in both. Pure; permuting the corners permutes only the shares.
MaterialBlend materialBlend(const MaterialMix& a, const MaterialMix& b, const MaterialMix& c);

/// Returns the weights of projections along x, y and z for a surface with this normal (any length except 0). They are
/// proportional to the fourth powers of its components; their sum is 255.
std::array<uint8_t, 3> planeShares(const std::array<double, 3>& normal);

}  // namespace sgm
