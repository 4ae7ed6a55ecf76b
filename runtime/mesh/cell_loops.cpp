#include "mesh/cell_loops.h"

#include "mesh/triangulate_any.h"
#include "mesh/vertex.h"

namespace sgm {
namespace {

/// Adds the vertex where the surface crosses an edge of a cell.
uint32_t addCrossing(const ChunkGrid& grid, const Int3& cell, uint32_t edge, const std::array<int32_t, 8>& q,
                     MeshPart& part) {
  const auto axis = static_cast<int>(edge / 4);
  Int3 start;  // the corner at which the edge starts, relative to the cell
  start[axis == 0 ? 1 : 0] = static_cast<int32_t>(edge & 1);
  start[axis == 2 ? 1 : 2] = static_cast<int32_t>(edge >> 1 & 1);
  const auto from = static_cast<size_t>(start.x | start.y << 1 | start.z << 2);
  const auto along = static_cast<int32_t>(crossing(q[from], q[from | size_t{1} << axis]));
  VertexKey key;
  key.level = static_cast<uint8_t>(grid.level);
  key.axis = static_cast<uint8_t>(axis);
  Int3 at;
  for (int k = 0; k < 3; ++k) {
    key.corner[k] = grid.origin[k] + (cell[k] + start[k]) * grid.cell;
    at[k] = (cell[k] + start[k]) * kSubcell + (k == axis ? along : 0);
  }
  Vertex vertex{};
  vertex.x = static_cast<int16_t>(at.x);
  vertex.y = static_cast<int16_t>(at.y);
  vertex.z = static_cast<int16_t>(at.z);
  part.vertices.push_back(vertex);
  part.keys.push_back(key);
  return static_cast<uint32_t>(part.vertices.size() - 1);
}

}  // namespace

void addCellLoops(const ChunkGrid& grid, const Int3& cell, const std::array<int32_t, 8>& q, MeshPart& part,
                  std::pmr::vector<SurfaceLoop>& loops) {
  uint32_t solid = 0;
  for (size_t corner = 0; corner < 8; ++corner) solid |= uint32_t{q[corner] < 0} << corner;
  const uint8_t* edges = kCubeLoops + kCubeLoopStart[solid];
  const uint8_t* const end = kCubeLoops + kCubeLoopStart[solid + 1];
  while (edges != end) {
    const int n = *edges++;
    SurfaceLoop loop;
    loop.cell = cell;
    loop.first_index = static_cast<uint32_t>(part.indices.size());
    std::array<LoopPoint, kLongestCubeLoop> points;
    for (int i = 0; i < n; ++i) {
      const uint32_t number = addCrossing(grid, cell, edges[i], q, part);
      const Vertex& at = part.vertices[number];
      points[static_cast<size_t>(i)] = {at.x, at.y, at.z, chordMask(kCubeEdgeFaces[edges[i]], edges[i], n), number};
      loop.vertices[loop.count++] = number;
    }
    std::array<uint32_t, 3 * (kLongestCubeLoop - 2)> triangles;
    uint32_t* const last = triangulateAnyLoop<kLongestCubeLoop>(points.data(), n, triangles.data());
    part.indices.insert(part.indices.end(), triangles.data(), last);
    loop.end_index = static_cast<uint32_t>(part.indices.size());
    loops.push_back(loop);
    edges += n;
  }
}

}  // namespace sgm
