#pragma once
// Builds the marching-cubes loops of a single cell from samples at its corners, for cells that no meshed body contains.

#include <array>
#include <memory_resource>
#include <vector>

#include "mesh/body_loops.h"

namespace sgm {

/// Appends the loops of a cell to `loops`, and their vertices and triangles to `part`, the same as polygonizeBody
/// makes. cell: position in the grid, -1..kChunkCells on each axis. q: the quantised field at the cell's corners,
/// numbered as in tables.h. Throws std::bad_alloc.
void addCellLoops(const ChunkGrid& grid, const Int3& cell, const std::array<int32_t, 8>& q, MeshPart& part,
                  std::pmr::vector<SurfaceLoop>& loops);

}  // namespace sgm
