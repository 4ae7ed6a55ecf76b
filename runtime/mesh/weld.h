#pragma once
// Many parts become one indexed mesh. Vertices are one where their keys are equal, without any tolerance.

#include <array>
#include <memory_resource>
#include <span>
#include <vector>

#include "base/result.h"
#include "mesh/chunk.h"
#include "mesh/hash.h"

namespace sgm {

/// What a welded vertex keeps of its packed vertex.
struct VertexAttributes {
  int16_t normal_x = 0, normal_y = 0;
  uint16_t material = 0, tag = 0;
  friend bool operator==(const VertexAttributes&, const VertexAttributes&) = default;
};

/// An indexed triangle mesh of a region. All arrays but indices have one entry a vertex.
struct WorldMesh {
  Int3 origin;  ///< where positions count from, in units
  /// In metres from origin. Exact: positions are multiples of 1/2^18 m.
  std::pmr::vector<std::array<double, 3>> positions;
  std::pmr::vector<VertexAttributes> attributes;
  std::pmr::vector<VertexKey> keys;
  std::pmr::vector<uint32_t> indices;  ///< three a triangle, counter-clockwise seen from the void

  explicit WorldMesh(std::pmr::memory_resource* memory = std::pmr::get_default_resource())
      : positions(memory), attributes(memory), keys(memory), indices(memory) {}
};

/// Welds bodies and seams of any number of chunks. The result does not depend on the order of parts: they are taken by
/// level, then origin (z, y, x), then number; vertices come first seen first in that order, with the attributes of that
/// first copy, triangles follow their parts. Border vertices come once; open edges remain only where no part adjoins.
/// Error: Code::limit where the region has 2^32 vertices or more before welding.
Result<WorldMesh> weld(std::span<const PlacedPart> parts, Int3 origin,
                       std::pmr::memory_resource* memory = std::pmr::get_default_resource());

/// A hash of the whole of a welded mesh: origin, positions, attributes and indices.
ContentHash hashMesh(const WorldMesh& mesh);

}  // namespace sgm
