#pragma once
// A mesh with texture coordinates, as unwrap.h makes it.

#include <array>
#include <cstdint>
#include <memory_resource>
#include <vector>

namespace sgm {

/// A vertex as one chart and one pair of materials sees it.
struct Wedge {
  uint32_t vertex = 0;                    ///< of the mesh: position, normal and label
  float u = 0, v = 0;                     ///< tiles
  std::array<uint16_t, 2> materials{};    ///< of the triangles that have it, rising; both the same where they have one
  uint8_t share = 0;                      ///< of the second material here, in 255ths
  std::array<uint8_t, 3> plane_shares{};  ///< planeShares(), where the world's axes texture it; else all 0
  friend bool operator==(const Wedge&, const Wedge&) = default;
};

struct Unwrapped {
  std::pmr::vector<Wedge> wedges;      ///< in the order in which triangles come to them
  std::pmr::vector<uint32_t> corners;  ///< into wedges, three a triangle: the mesh's indices, one by one

  explicit Unwrapped(std::pmr::memory_resource* memory = std::pmr::get_default_resource())
      : wedges(memory), corners(memory) {}

  friend bool operator==(const Unwrapped&, const Unwrapped&) = default;
  size_t bytes() const { return wedges.capacity() * sizeof(Wedge) + corners.capacity() * sizeof(uint32_t); }
};

}  // namespace sgm
