#pragma once
// The loops of single cells, without a body.

#include <array>
#include <memory_resource>
#include <vector>

#include "mesh/body_loops.h"

namespace sgm {

/// Appends the loops of a cell to `loops`, and their vertices and triangles to `part`, as meshing makes them. cell:
/// from the grid's origin, from -1 to kChunkCells. q: the field at the cell's corners, quantised. Throws
/// std::bad_alloc.
void addCellLoops(const ChunkGrid& grid, const Int3& cell, const std::array<int32_t, 8>& q, MeshPart& part,
                  std::pmr::vector<SurfaceLoop>& loops);

}  // namespace sgm
