#pragma once
// A mesh with texture coordinates, the result of unwrap.h.

#include <array>
#include <cstdint>
#include <memory_resource>
#include <vector>

namespace sgm {

/// A vertex in one chart and with one pair of materials.
struct Wedge {
  uint32_t vertex = 0;                    ///< of the mesh: position, normal and label
  float u = 0, v = 0;                     ///< tiles
  std::array<uint16_t, 2> materials{};    ///< of its triangles, ascending; both the same if they have one
  uint8_t share = 0;                      ///< of the second material here, in 255ths
  std::array<uint8_t, 3> plane_shares{};  ///< planeShares() if the world's axes texture it, else all 0
  friend bool operator==(const Wedge&, const Wedge&) = default;
};

struct Unwrapped {
  std::pmr::vector<Wedge> wedges;      ///< in the order of their first use by triangles
  std::pmr::vector<uint32_t> corners;  ///< into wedges, three per triangle, parallel to the mesh's indices

  explicit Unwrapped(std::pmr::memory_resource* memory = std::pmr::get_default_resource())
      : wedges(memory), corners(memory) {}

  friend bool operator==(const Unwrapped&, const Unwrapped&) = default;
  size_t bytes() const { return wedges.capacity() * sizeof(Wedge) + corners.capacity() * sizeof(uint32_t); }
};

}  // namespace sgm
