#pragma once
// Triangles with materials by name: what a file holds, in metres.

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "asset/point.h"

namespace sgm::asset {

inline constexpr uint32_t kNoMaterial = 0xFFFFFFFFu;

struct TriangleMesh {
  std::vector<Point> points;
  std::vector<std::array<uint32_t, 3>> triangles;  ///< counter-clockwise seen from outside
  std::vector<uint32_t> materials;                 ///< of each triangle, into material_names, or kNoMaterial
  std::vector<std::string> material_names;
};

}  // namespace sgm::asset
