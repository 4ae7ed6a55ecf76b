#pragma once
// The loops of marching cubes in some cells of one level: those of a chunk, and cells around it that are sampled when
// they are asked for. Features of a cell depend on the cells near it; a patch gives them to a chunk that knows its own
// cells alone, the same loops that the chunk beside it has.

#include <array>
#include <cstdint>
#include <memory_resource>
#include <span>
#include <unordered_map>
#include <utility>
#include <vector>

#include "mesh/cell_set.h"
#include "mesh/creases.h"
#include "mesh/tables.h"

namespace sgm {

/// A loop of cut edges in one cell. Its vertices go round counter-clockwise seen from the void, from the lowest edge.
struct SurfaceLoop {
  Int3 cell;                                          ///< from the patch's origin, in cells
  std::array<uint32_t, kLongestCubeLoop> vertices{};  ///< of the patch
  uint32_t count = 0;
  uint32_t first_index = 0, end_index = 0;  ///< its triangles, in the patch's indices
};

/// Throws std::bad_alloc.
class SurfacePatch {
 public:
  /// Borrows field and memory. grid: of the patch's level.
  SurfacePatch(const ChunkGrid& grid, const FieldSampler& field, std::pmr::memory_resource* memory);

  /// Takes a copy of a chunk's body, as meshed. First of all, once.
  void addBody(const MeshPart& body);
  /// Takes the vertex of a grid edge that is in no body; returns its number.
  uint32_t addVertex(const Vertex& vertex, const VertexKey& key);
  /// Samples those of the cells that the patch does not have, and appends their loops and vertices. A cell that reaches
  /// beyond the world has none. Each call invalidates what loopsOf() gave.
  void addCells(const CellSet& cells);

  const ChunkGrid& grid() const { return grid_; }
  MeshPart& part() { return part_; }
  const MeshPart& part() const { return part_; }
  const std::pmr::vector<SurfaceLoop>& loops() const { return loops_; }
  /// Numbers of the loops of a cell.
  std::span<const uint32_t> loopsOf(const Int3& cell) const;
  /// Calls visit(number) for the loops of all cells lo <= cell <= hi.
  template <class Visit>
  void forLoops(const Int3& lo, const Int3& hi, const Visit& visit) const {
    for (int32_t z = lo.z; z <= hi.z; ++z) {
      for (int32_t y = lo.y; y <= hi.y; ++y) {
        const size_t row = CellSet::codeOf({-CellSet::kBelow, y, z}) >> 6;
        for (uint32_t i = row_starts_[row]; i < row_starts_[row + 1]; ++i) {
          if (cells_[i] < CellSet::codeOf({lo.x, y, z})) continue;
          if (cells_[i] > CellSet::codeOf({hi.x, y, z})) break;
          visit(numbers_[i]);
        }
      }
    }
  }
  /// In units. Precondition: the patch has loops there.
  Int3 cornerOf(const Int3& cell) const;

 private:
  using EdgeNumbers = std::pmr::unordered_map<uint64_t, uint32_t>;

  bool isInBody(const Int3& cell) const;
  bool isInWorld(const Int3& cell) const;
  void takeLoops(size_t first_index, size_t end_index);
  void addLoops(const Int3& cell, const std::array<int32_t, 8>& q);
  uint32_t vertexOnEdge(const Int3& cell, uint32_t edge, const Int3& at);
  void index(size_t first_loop);

  const ChunkGrid grid_;
  const FieldSampler& field_;
  std::pmr::memory_resource* memory_;
  bool has_body_ = false;
  MeshPart part_;
  std::pmr::vector<SurfaceLoop> loops_;
  std::pmr::vector<uint32_t> cells_, numbers_;  ///< by loop, sorted by cell: the cell's code, the loop's number
  std::pmr::vector<uint32_t> row_starts_;       ///< in cells_, by the cells' y and z; one more at the end
  CellSet sampled_;                             ///< cells that were asked for
  EdgeNumbers outer_;                           ///< vertices that cells outside of the body may share, by edge
};

}  // namespace sgm
