#pragma once
// Welds many parts into one indexed mesh. Vertices with equal keys are merged, without any tolerance.

#include <array>
#include <memory_resource>
#include <span>
#include <vector>

#include "base/result.h"
#include "mesh/chunk.h"
#include "mesh/hash.h"

namespace sgm {

/// The attributes of a welded vertex, copied from a packed vertex.
struct VertexAttributes {
  int16_t normal_x = 0, normal_y = 0;
  uint16_t material = 0, tag = 0;
  friend bool operator==(const VertexAttributes&, const VertexAttributes&) = default;
};

/// An indexed triangle mesh of a region. All arrays except indices have one entry per vertex.
struct WorldMesh {
  Int3 origin;  ///< origin of the positions, in units
  /// Positions of the vertices in metres from origin. Exact: positions are multiples of 1/2^18 m.
  std::pmr::vector<std::array<double, 3>> positions;
  std::pmr::vector<VertexAttributes> attributes;
  std::pmr::vector<VertexKey> keys;
  std::pmr::vector<uint32_t> indices;  ///< three per triangle, counter-clockwise seen from the void

  explicit WorldMesh(std::pmr::memory_resource* memory = std::pmr::get_default_resource())
      : positions(memory), attributes(memory), keys(memory), indices(memory) {}
};

/// Welds the bodies and seams of any number of chunks. The order of `parts` does not affect the result, because the
/// parts are sorted by level, then origin (z, y, x), then number. Vertices are in the order of their first occurrence,
/// with the attributes of the first copy; triangles follow the order of the parts. A vertex that several parts share
/// appears once; open edges remain only where no part adjoins. Error: Code::limit if the parts have 2^32 vertices or
/// more in total.
Result<WorldMesh> weld(std::span<const PlacedPart> parts, Int3 origin,
                       std::pmr::memory_resource* memory = std::pmr::get_default_resource());

/// A hash of the whole of a welded mesh: origin, positions, attributes and indices.
ContentHash hashMesh(const WorldMesh& mesh);

}  // namespace sgm
