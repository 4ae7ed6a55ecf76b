#pragma once
// The loops of marching cubes that a chunk's body is made of: as meshed, or with joined faces (mesh/ambiguous_faces.h).

#include <algorithm>
#include <array>
#include <cstdint>
#include <memory_resource>
#include <vector>

#include "mesh/chunk.h"
#include "mesh/tables.h"

namespace sgm {

/// The axis of the face that two edges of a cell share; -1 if they share none.
int sharedFace(const VertexKey& a, const VertexKey& b);

/// Of a cell: as meshed it has at most kLongestCubeLoop vertices, but joined loops have more (mesh/ambiguous_faces.h).
inline constexpr int kLongestBodyLoop = kCubeEdges;

/// The number of a cube's edge that a vertex is on (mesh/tables.h). corner: the cube's lowest, in units.
uint8_t cubeEdge(const VertexKey& key, const Int3& corner);

/// A loop of cut edges in one cell. Its vertices go round counter-clockwise seen from the void, from the lowest edge.
struct SurfaceLoop {
  Int3 cell;                                          ///< from the chunk's origin, in cells
  std::array<uint32_t, kLongestBodyLoop> vertices{};  ///< of the body
  uint32_t count = 0;
  uint32_t first_index = 0, end_index = 0;  ///< its triangles, in the body's indices
};

/// The loops of a body without features, in the order of its triangles. Throws std::bad_alloc.
class BodyLoops {
 public:
  /// Borrows the body. Good until its triangles change.
  BodyLoops(const ChunkGrid& grid, const MeshPart& body, std::pmr::memory_resource* memory);

  const ChunkGrid& grid() const { return grid_; }
  const MeshPart& part() const { return part_; }
  const std::pmr::vector<SurfaceLoop>& all() const { return loops_; }
  /// Calls visit(number) for the loops of all cells lo <= cell <= hi.
  template <class Visit>
  void visitWithin(Int3 lo, Int3 hi, const Visit& visit) const {
    for (int axis = 0; axis < 3; ++axis) {
      lo[axis] = std::max(lo[axis], 0);
      hi[axis] = std::min(hi[axis], kChunkCells - 1);
      if (lo[axis] > hi[axis]) return;
    }
    for (int32_t z = lo.z; z <= hi.z; ++z) {
      for (int32_t y = lo.y; y <= hi.y; ++y) {
        const uint32_t end = starts_[pieceOf({0, y, z}) + kPieces];
        for (uint32_t i = starts_[pieceOf({lo.x, y, z})]; i < end && loops_[i].cell.x <= hi.x; ++i)
          if (loops_[i].cell.x >= lo.x) visit(i);
      }
    }
  }
  /// In units.
  Int3 cornerOf(const Int3& cell) const;

 private:
  /// Of a row of cells.
  static constexpr int32_t kPieces = 4;
  static size_t pieceOf(const Int3& cell) {
    return static_cast<size_t>((cell.z * kChunkCells + cell.y) * kPieces + cell.x / (kChunkCells / kPieces));
  }

  void findLoops();
  Int3 cellOf(size_t first_index) const;

  const ChunkGrid grid_;
  const MeshPart& part_;
  std::pmr::vector<SurfaceLoop> loops_;
  std::pmr::vector<uint32_t> starts_;  ///< in loops_, by piece; one more at the end
};

}  // namespace sgm
