#include "mesh/body_loops.h"

namespace sgm {
int sharedFace(const VertexKey& a, const VertexKey& b) {
  if (a.axis != b.axis) {
    const int axis = 3 - a.axis - b.axis;
    return a.corner[axis] == b.corner[axis] ? axis : -1;
  }
  const int first = (a.axis + 1) % 3, second = (a.axis + 2) % 3;
  if (a.corner[first] == b.corner[first]) return first;
  return a.corner[second] == b.corner[second] ? second : -1;
}

uint8_t cubeEdge(const VertexKey& key, const Int3& corner) {
  int edge = 4 * key.axis, bit = 1;
  for (int axis = 0; axis < 3; ++axis) {
    if (axis == key.axis) continue;
    edge += key.corner[axis] == corner[axis] ? 0 : bit;
    bit = 2;
  }
  return static_cast<uint8_t>(edge);
}

BodyLoops::BodyLoops(const ChunkGrid& grid, const MeshPart& body, std::pmr::memory_resource* memory)
    : grid_(grid), part_(body), loops_(memory), starts_(size_t{kChunkCells} * kChunkCells * kPieces + 1, memory) {
  findLoops();
  for (const SurfaceLoop& loop : loops_) ++starts_[pieceOf(loop.cell) + 1];
  for (size_t piece = 1; piece < starts_.size(); ++piece) starts_[piece] += starts_[piece - 1];
}

Int3 BodyLoops::cornerOf(const Int3& cell) const {
  Int3 corner = grid_.origin;
  for (int axis = 0; axis < 3; ++axis) corner[axis] += cell[axis] * grid_.cell;
  return corner;
}

/// Returns the cell that contains a triangle. The triangle's corners lie on three grid edges; only one cell has all
/// three.
Int3 BodyLoops::cellOf(size_t first_index) const {
  Int3 cell;
  for (int axis = 0; axis < 3; ++axis) {
    int32_t lo = 0;
    for (size_t k = 0; k < 3; ++k) {
      const uint32_t v = part_.indices[first_index + k];
      const Vertex& vertex = part_.vertices[v];
      const int32_t sample = (axis == 0 ? vertex.x : axis == 1 ? vertex.y : vertex.z) / kSubcell;
      lo = std::max(lo, sample - (part_.keys[v].axis == axis ? 0 : 1));
    }
    cell[axis] = lo;
  }
  return cell;
}

void BodyLoops::findLoops() {
  const RawVector<uint32_t>& indices = part_.indices;
  for (size_t at = 0; at < indices.size();) {
    SurfaceLoop loop;
    loop.cell = cellOf(at);
    loop.first_index = static_cast<uint32_t>(at);
    std::array<std::array<uint32_t, 2>, kLongestBodyLoop> sides{};
    uint32_t count = 0;
    const auto take = [&] {
      for (size_t k = 0; k < 3; ++k) {
        const uint32_t a = indices[at + k], b = indices[at + (k + 1) % 3];
        if (sharedFace(part_.keys[a], part_.keys[b]) >= 0) sides[count++] = {a, b};
      }
      at += 3;
    };
    const auto joins = [&](uint32_t v) {
      return std::find(indices.data() + loop.first_index, indices.data() + at, v) != indices.data() + at;
    };
    take();
    // Takes the other triangles of the loop: they are consecutive, and share no vertex with another loop of the cell.
    while (at < indices.size() && cellOf(at) == loop.cell &&
           (joins(indices[at]) || joins(indices[at + 1]) || joins(indices[at + 2]))) {
      take();
    }
    loop.end_index = static_cast<uint32_t>(at);
    uint32_t next = indices[loop.first_index];
    for (uint32_t i = 0; i < count; ++i) {
      loop.vertices[loop.count++] = next;
      next = (*std::find_if(sides.begin(), sides.end(), [&](const auto& side) { return side[0] == next; }))[1];
    }
    loops_.push_back(loop);
  }
}

}  // namespace sgm
