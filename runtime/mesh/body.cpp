#include "mesh/body.h"

#include <bit>

#include "mesh/tables.h"
#include "mesh/triangulate.h"
#include "mesh/vertex.h"

namespace sgm {
namespace {

constexpr size_t kSide = kChunkSamples;
constexpr size_t kPlane = kSide * kSide;
constexpr uint64_t kCellBits = (uint64_t{1} << kChunkCells) - 1;

/// The crossed edges (edges whose ends differ in sign) that start at the samples of one row: one word per axis of the
/// edge, one bit per sample.
struct RowEdges {
  uint64_t x, y, z;
};

RowEdges crossedEdges(const uint64_t* signs, size_t y, size_t z) {
  const uint64_t* row = signs + y + z * kSide;
  return {(row[0] ^ row[0] >> 1) & kCellBits, y < kChunkCells ? row[0] ^ row[1] : 0,
          z < kChunkCells ? row[0] ^ row[kSide] : 0};
}

/// The result of the first pass over the samples: the numbers of vertices and of triangles, and the marching-cubes
/// cases of the cells that the surface crosses, in canonical order.
struct Census {
  size_t vertices = 0;
  size_t triangles = 0;
  uint32_t active[size_t{kChunkCells} * kChunkCells];
  uint8_t cases[size_t{kChunkCells} * kChunkCells * kChunkCells];
};

void takeCensus(const uint64_t* signs, Census& census) {
  for (size_t z = 0; z < kSide; ++z) {
    for (size_t y = 0; y < kSide; ++y) {
      const RowEdges e = crossedEdges(signs, y, z);
      if ((e.x | e.y | e.z) == 0) continue;
      // Packs the 32 + 33 + 33 bits of x, y and z into two words of 64 bits, so that two calls of popcount suffice.
      census.vertices += static_cast<size_t>(std::popcount(e.x | e.y << 32) + std::popcount(e.z | e.y >> 32 << 33));
    }
  }
  uint8_t* next_case = census.cases;
  for (size_t z = 0; z < kChunkCells; ++z) {
    for (size_t y = 0; y < kChunkCells; ++y) {
      const uint64_t* row = signs + y + z * kSide;
      const uint64_t a = row[0], b = row[1], c = row[kSide], d = row[kSide + 1];
      const uint64_t some = a | b | c | d, all = a & b & c & d;
      uint64_t active = (some | some >> 1) & ~(all & all >> 1) & kCellBits;
      census.active[z * kChunkCells + y] = static_cast<uint32_t>(active);
      for (; active != 0; active &= active - 1) {
        const int x = std::countr_zero(active);
        const auto cell_case =
            static_cast<uint8_t>((a >> x & 3) | (b >> x & 3) << 2 | (c >> x & 3) << 4 | (d >> x & 3) << 6);
        *next_case++ = cell_case;
        census.triangles += kCubeTriangles[cell_case];
      }
    }
  }
}

/// The numbers of the vertices on crossed edges, indexed by the sample at which an edge starts and by the edge's axis.
/// Stored for two planes of samples: those below and above the current layer of cells.
struct EdgeNumbers {
  uint32_t of[2][kPlane * 3];
};

/// For each edge of a cube: the offset of its vertex number in EdgeNumbers, from the entry of the cell's lowest sample.
/// There is one set of offsets for even layers of cells and one for odd layers, because the two planes in EdgeNumbers
/// swap their roles with each layer.
struct EdgeOffsets {
  int32_t of[2][kCubeEdges];
};

constexpr EdgeOffsets makeEdgeOffsets() {
  EdgeOffsets offsets{};
  for (int parity = 0; parity < 2; ++parity) {
    for (int e = 0; e < kCubeEdges; ++e) {
      const int axis = e / 4, first = e & 1, second = e >> 1 & 1;
      const int x = axis == 0 ? 0 : first, y = axis == 0 ? first : axis == 1 ? 0 : second, z = axis == 2 ? 0 : second;
      const int plane = z == 0 ? 0 : parity == 0 ? 1 : -1;
      offsets.of[parity][e] = ((plane * static_cast<int>(kSide) + y) * static_cast<int>(kSide) + x) * 3 + axis;
    }
  }
  return offsets;
}
constexpr EdgeOffsets kEdgeOffsets = makeEdgeOffsets();

/// Writes the vertices on the crossed edges that start in plane z of the samples, numbered from `number`, and stores
/// the numbers in `numbers`. Returns the next free number.
uint32_t writeVertices(const ChunkSamples& samples, const ChunkGrid& grid, size_t z, uint32_t number, MeshPart& part,
                       uint32_t* numbers) {
  const int32_t corner_z = grid.origin.z + static_cast<int32_t>(z) * grid.cell;
  const auto level = static_cast<uint8_t>(grid.level);
  for (size_t y = 0; y < kSide; ++y) {
    const RowEdges edges = crossedEdges(samples.signs.data(), y, z);
    const int32_t* q = samples.q.data() + (y + z * kSide) * kSide;
    const int32_t corner_y = grid.origin.y + static_cast<int32_t>(y) * grid.cell;
    for (uint64_t owners = edges.x | edges.y | edges.z; owners != 0; owners &= owners - 1) {
      const auto x = static_cast<size_t>(std::countr_zero(owners));
      const Int3 corner{grid.origin.x + static_cast<int32_t>(x) * grid.cell, corner_y, corner_z};
      const auto add = [&](uint8_t axis, size_t step) {
        const uint32_t t = crossing(q[x], q[x + step]);
        Vertex v{};
        v.x = static_cast<int16_t>(x * kSubcell + (axis == 0 ? t : 0));
        v.y = static_cast<int16_t>(y * kSubcell + (axis == 1 ? t : 0));
        v.z = static_cast<int16_t>(z * kSubcell + (axis == 2 ? t : 0));
        part.vertices[number] = v;
        part.keys[number] = {corner, level, axis, 0};
        numbers[(y * kSide + x) * 3 + axis] = number++;
      };
      if (edges.x >> x & 1) add(0, 1);
      if (edges.y >> x & 1) add(1, kSide);
      if (edges.z >> x & 1) add(2, kPlane);
    }
  }
  return number;
}

}  // namespace

void polygonizeBody(const ChunkSamples& samples, const ChunkGrid& grid, MeshPart& part) {
  Census census;
  takeCensus(samples.signs.data(), census);
  part.vertices.resize(census.vertices);
  part.keys.resize(census.vertices);
  part.indices.resize(census.triangles * 3);
  part.hash = {};
  if (census.vertices == 0) return;

  EdgeNumbers numbers;
  uint32_t next_vertex = 0;
  uint32_t* next_index = part.indices.data();
  const uint8_t* next_case = census.cases;
  const Vertex* vertices = part.vertices.data();
  for (size_t z = 0; z < kSide; ++z) {
    next_vertex = writeVertices(samples, grid, z, next_vertex, part, numbers.of[z & 1]);
    if (z == 0) continue;
    const size_t parity = (z - 1) & 1;
    const int32_t* offsets = kEdgeOffsets.of[parity];
    for (size_t y = 0; y < kChunkCells; ++y) {
      for (uint32_t active = census.active[(z - 1) * kChunkCells + y]; active != 0; active &= active - 1) {
        const auto x = static_cast<size_t>(std::countr_zero(active));
        const uint32_t* of_cell = numbers.of[parity] + (y * kSide + x) * 3;
        const uint8_t cell_case = *next_case++;
        const uint8_t* loop = kCubeLoops + kCubeLoopStart[cell_case];
        const uint8_t* end = kCubeLoops + kCubeLoopStart[cell_case + 1];
        while (loop != end) {
          const int length = *loop++;
          next_index = triangulateLoop(length, next_index, [&](size_t i, int n) -> LoopPoint {
            const uint8_t e = loop[i];
            const uint32_t number = of_cell[offsets[e]];
            const Vertex& v = vertices[number];
            return {v.x, v.y, v.z, chordMask(kCubeEdgeFaces[e], e, n), number};
          });
          loop += length;
        }
      }
    }
  }
}

}  // namespace sgm
