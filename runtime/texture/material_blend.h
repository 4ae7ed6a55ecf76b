#pragma once
// Blends materials: finds the two most frequent materials at a triangle's corners, and their shares at each corner.
// Also computes the weights of triplanar mapping, for surfaces whose shape has no texture coordinates.

#include <array>
#include <cstddef>
#include <cstdint>

namespace sgm {

/// Number of samples of the material around a vertex: one at the vertex, and eight around it on the surface.
inline constexpr size_t kMaterialSamples = 9;
using MaterialMix = std::array<uint16_t, kMaterialSamples>;

/// Two material numbers in ascending order, equal if a triangle has only one material; and for each corner the share of
/// the second material, in 255ths.
struct MaterialBlend {
  std::array<uint16_t, 2> materials{};
  std::array<uint8_t, 3> share{};
  friend bool operator==(const MaterialBlend&, const MaterialBlend&) = default;
};

/// Returns the blend of a triangle from its corners' materials. Triangles that blend the same two materials have the
/// same share at a common corner, so there is no seam. Pure; permuting the corners only permutes the shares.
MaterialBlend materialBlend(const MaterialMix& a, const MaterialMix& b, const MaterialMix& c);

/// Returns the triplanar weights of projections along x, y and z for a surface with this normal (any length except 0).
/// They are proportional to the fourth powers of the normal's components; their sum is 255.
std::array<uint8_t, 3> planeShares(const std::array<double, 3>& normal);

}  // namespace sgm
