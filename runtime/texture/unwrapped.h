#pragma once
// A mesh with texture coordinates, as unwrap.h computes it.

#include <array>
#include <cstdint>
#include <memory_resource>
#include <vector>

namespace sgm {

/// A vertex of the textured mesh: a copy of a vertex of the original mesh. A vertex has one copy for each combination
/// of shape, texture chart, period of the texture and pair of blended materials in which its triangles use it.
struct Wedge {
  uint32_t vertex = 0;                  ///< index of the vertex of the mesh; the wedge has the position, normal and
                                        ///< label of this vertex
  float u = 0, v = 0;                   ///< texture coordinates in tiles
  std::array<uint16_t, 2> materials{};  ///< material numbers of the wedge's triangles, ascending; equal if there is
                                        ///< only one
  uint8_t share = 0;                    ///< share of the second material at this vertex, in 255ths
  /// triplanar weights (planeShares()) if the texture is mapped along the world's axes, otherwise all 0
  std::array<uint8_t, 3> plane_shares{};
  friend bool operator==(const Wedge&, const Wedge&) = default;
};

struct Unwrapped {
  std::pmr::vector<Wedge> wedges;      ///< in the order in which triangles first use them
  std::pmr::vector<uint32_t> corners;  ///< indices of wedges, three per triangle, parallel to the mesh's indices

  explicit Unwrapped(std::pmr::memory_resource* memory = std::pmr::get_default_resource())
      : wedges(memory), corners(memory) {}

  friend bool operator==(const Unwrapped&, const Unwrapped&) = default;
  size_t bytes() const { return wedges.capacity() * sizeof(Wedge) + corners.capacity() * sizeof(uint32_t); }
};

}  // namespace sgm
