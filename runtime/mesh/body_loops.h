#pragma once
// The marching-cubes loops in the cells of a chunk's body. A loop is a closed polygon through crossed edges of one
// cell. Cells can have other loops after ambiguous faces were joined (mesh/ambiguous_faces.h).

#include <algorithm>
#include <array>
#include <cstdint>
#include <memory_resource>
#include <vector>

#include "mesh/chunk.h"
#include "mesh/tables.h"

namespace sgm {

/// Returns the axis of the normal of the cell face that contains both edges; -1 if no face contains both. a, b: the
/// keys of two edges of one cell.
int sharedFace(const VertexKey& a, const VertexKey& b);

/// Maximum number of vertices of a loop in one cell. Marching cubes makes loops of at most kLongestCubeLoop vertices,
/// but a loop in a cell with joined faces (mesh/ambiguous_faces.h) can pass through all edges of the cell.
inline constexpr int kLongestBodyLoop = kCubeEdges;

/// Returns the number (mesh/tables.h) of the cube edge that a vertex lies on. corner: the lowest corner of the cube, in
/// units.
uint8_t cubeEdge(const VertexKey& key, const Int3& corner);

/// A loop of crossed edges in one cell. Its vertices are counter-clockwise seen from the void, and start at the loop's
/// edge of lowest number.
struct SurfaceLoop {
  Int3 cell;                                          ///< position of the cell: 0..kChunkCells - 1 on each axis
  std::array<uint32_t, kLongestBodyLoop> vertices{};  ///< indices of the body's vertices
  uint32_t count = 0;
  uint32_t first_index = 0, end_index = 0;  ///< range of the loop's triangles in the body's index array
};

/// The loops of a body that has no feature vertices, in the order of its triangles. The constructor throws
/// std::bad_alloc.
class BodyLoops {
 public:
  /// Borrows the body. The object is valid until the body's triangles change.
  BodyLoops(const ChunkGrid& grid, const MeshPart& body, std::pmr::memory_resource* memory);

  const ChunkGrid& grid() const { return grid_; }
  const MeshPart& part() const { return part_; }
  const std::pmr::vector<SurfaceLoop>& all() const { return loops_; }
  /// Calls visit(number) for each loop of the cells lo <= cell <= hi. number: index of the loop.
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
  /// The lowest corner of a cell, in units.
  Int3 cornerOf(const Int3& cell) const;

 private:
  /// Each row of cells is divided into this number of pieces. starts_ has one entry per piece, so that the loops of a
  /// cell are found fast.
  static constexpr int32_t kPieces = 4;
  static size_t pieceOf(const Int3& cell) {
    return static_cast<size_t>((cell.z * kChunkCells + cell.y) * kPieces + cell.x / (kChunkCells / kPieces));
  }

  void findLoops();
  Int3 cellOf(size_t first_index) const;

  const ChunkGrid grid_;
  const MeshPart& part_;
  std::pmr::vector<SurfaceLoop> loops_;
  std::pmr::vector<uint32_t> starts_;  ///< for each piece (kPieces) of each row of cells: index in loops_ of the
                                       ///< piece's first loop; the last entry is the end of loops_
};

}  // namespace sgm
