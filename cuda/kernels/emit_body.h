#pragma once
// Kernels that write the vertices and triangles of bodies (the chunks' meshes without seams to coarser neighbours), in
// the same order as mesh/body.cpp on the CPU.

#include "cuda/kernels/census.h"
#include "cuda/kernels/field.h"
#include "mesh/triangulate_any.h"

namespace sgm::cuda {

/// Kernel: writes the vertices of a brick (8 x 8 x 8 cells). The program pruned to this brick computes their
/// attributes. One block of threads per sampled brick.
struct BodyVertices {
  static constexpr uint32_t kThreads = 96;
  static constexpr uint32_t kBrickRows = (kBrickCells + 1) * (kBrickCells + 1);
  struct Shared {
    uint32_t before[kBrickRows];
    uint32_t hash[2];
  };

  template <class Block>
  SGM_KERNEL static void run(Block& block, const Batch& b, Shared& shared) {
    for (uint32_t entry = block.number(); entry < b.head->sampled; entry += block.count()) {
      const uint32_t number = b.sampled[entry];
      if (number >= kBricks * b.chunk_count) continue;
      const uint32_t chunk = number / kBricks, body = b.chunks[chunk].body;
      if (body == kNone || b.parts[body].first_vertex == kNone) continue;
      const uint64_t* signs = b.signs + size_t{kRows} * chunk;
      const Brick brick(number % kBricks);
      const uint32_t rows_y = static_cast<uint32_t>(brick.count(1)),
                     rows = rows_y * static_cast<uint32_t>(brick.count(2));
      const auto edgesOf = [&](uint32_t row) {
        return RowEdges(signs, brick.first(1) + static_cast<int>(row % rows_y),
                        brick.first(2) + static_cast<int>(row / rows_y));
      };
      block.each([&](uint32_t thread) {
        if (thread < kBrickRows) shared.before[thread] = thread < rows ? edgesOf(thread).countIn(brick.bits()) : 0;
        if (thread < 2) shared.hash[thread] = 0;
      });
      const uint32_t vertices = block.scan(shared.before, kBrickRows);
      block.each([&](uint32_t thread) {
        const ProgramView view = viewOf(b, b.items[number]);
        PartSum sum;
        for (uint32_t i = thread; i < vertices; i += kThreads) {
          const uint32_t row = lastAtMost(shared.before, rows, i);
          emit(b, chunk, view, brick.first(1) + static_cast<int>(row % rows_y),
               brick.first(2) + static_cast<int>(row / rows_y), brick.bits(), i - shared.before[row], sum);
        }
        sum.giveTo(shared.hash);
      });
      block.each([&](uint32_t thread) {
        if (thread < 2) addTo(b.parts[body].hash[thread], shared.hash[thread]);
      });
    }
  }

  /// Writes vertex n of row (y, z), counting only vertices on edges that start at the samples in the mask `owners`.
  SGM_KERNEL static void emit(const Batch& b, uint32_t chunk_number, const ProgramView& view, int y, int z,
                              uint64_t owners, uint32_t n, PartSum& sum) {
    const Chunk& chunk = b.chunks[chunk_number];
    const Part& part = b.parts[chunk.body];
    const RowEdges edges(b.signs + size_t{kRows} * chunk_number, y, z);
    uint32_t x = 0;
    for (uint64_t left = (edges.x | edges.y | edges.z) & owners;; left &= left - 1) {
      x = lowestOf(left);
      const uint32_t here = edges.countIn(uint64_t{1} << x);
      if (n < here) break;
      n -= here;
    }
    uint32_t axis = 0;
    for (;; ++axis) {
      const uint64_t crossed = axis == 0 ? edges.x : axis == 1 ? edges.y : edges.z;
      if ((crossed >> x & 1) != 0 && n-- == 0) break;
    }
    const int32_t* q = b.samples + size_t{kSamples} * chunk_number + rowOf(y, z) * kSide + x;
    const uint32_t t = crossing(q[0], q[axis == 0 ? 1 : axis == 1 ? kSide : kRows]);
    Vertex v{};
    v.x = static_cast<int16_t>(x * kSubcell + (axis == 0 ? t : 0));
    v.y = static_cast<int16_t>(static_cast<uint32_t>(y) * kSubcell + (axis == 1 ? t : 0));
    v.z = static_cast<int16_t>(static_cast<uint32_t>(z) * kSubcell + (axis == 2 ? t : 0));
    if (b.meshes) giveAttributes(view, vertexUnits(gridOf(chunk), v), v);
    const uint32_t number = b.rows[size_t{kRows} * chunk_number + rowOf(y, z)].vertices + edges.before(x, axis);
    b.vertices[part.first_vertex + number] = v;
    sum.add(v, number);
  }
};

/// Kernel: lists the active cells of a chunk. One block per chunk.
struct ListCells {
  static constexpr uint32_t kThreads = 256;
  struct Shared {
    uint32_t unused;
  };

  template <class Block>
  SGM_KERNEL static void run(Block& block, const Batch& b, Shared&) {
    block.each([&](uint32_t thread) {
      const Chunk& chunk = b.chunks[block.number()];
      if (chunk.body == kNone || b.parts[chunk.body].indices == 0) return;
      for (uint32_t row = thread; row < kChunkCells * kChunkCells; row += kThreads) {
        list(b, b.signs + size_t{kRows} * block.number(), b.rows + size_t{kRows} * block.number(),
             static_cast<int>(row % kChunkCells), static_cast<int>(row / kChunkCells),
             b.cells + size_t{kCells} * block.number());
      }
    });
  }

  SGM_KERNEL static void list(const Batch& b, const uint64_t* signs, const Row* rows, int y, int z, Cell* cells) {
    const Row& row = rows[rowOf(y, z)];
    uint32_t at = row.cells, index = row.indices;
    for (uint64_t left = activeCells(signs, y, z); left != 0; left &= left - 1) {
      const uint32_t x = lowestOf(left), cell_case = caseOf(signs, x, y, z);
      const auto place =
          x + static_cast<uint32_t>(y) * kChunkCells + static_cast<uint32_t>(z) * (kChunkCells * kChunkCells);
      cells[at++] = {place | cell_case << 15, index};
      index += 3u * b.tables->cube_triangles[cell_case];
    }
  }
};

/// Kernel: writes the triangles of bodies, one thread per active cell. kSlices blocks share the active cells of a
/// chunk.
struct BodyTriangles {
  static constexpr uint32_t kThreads = 128;
  static constexpr uint32_t kSlices = 8;
  struct Shared {
    uint32_t hash[2];
  };

  template <class Block>
  SGM_KERNEL static void run(Block& block, const Batch& b, Shared& shared) {
    const uint32_t chunk_number = block.number() / kSlices, slice = block.number() % kSlices;
    const Chunk& chunk = b.chunks[chunk_number];
    if (chunk.body == kNone || b.parts[chunk.body].indices == 0 || b.parts[chunk.body].first_index == kNone) return;
    const uint64_t* signs = b.signs + size_t{kRows} * chunk_number;
    const Row* rows = b.rows + size_t{kRows} * chunk_number;
    const Cell* cells = b.cells + size_t{kCells} * chunk_number;
    // The counts of a row exclude the row itself, so the entry after the last row of cells has the chunk's totals.
    const uint32_t active = rows[rowOf(kChunkCells, kChunkCells - 1)].cells;
    block.each([&](uint32_t thread) {
      if (thread < 2) shared.hash[thread] = 0;
    });
    block.each([&](uint32_t thread) {
      PartSum sum;
      for (uint32_t i = kThreads * slice + thread; i < active; i += kThreads * kSlices) {
        emit(b, b.parts[chunk.body], signs, rows, cells[i], sum);
      }
      sum.giveTo(shared.hash);
    });
    block.each([&](uint32_t thread) {
      if (thread < 2) addTo(b.parts[chunk.body].hash[thread], shared.hash[thread]);
    });
  }

  SGM_KERNEL static void emit(const Batch& b, const Part& part, const uint64_t* signs, const Row* rows,
                              const Cell& cell, PartSum& sum) {
    const uint32_t x = cell.place & 31, cell_case = cell.place >> 15;
    const int y = static_cast<int>(cell.place >> 5 & 31), z = static_cast<int>(cell.place >> 10 & 31);
    const uint8_t* loop = b.tables->cube_loops + b.tables->cube_start[cell_case];
    const uint8_t* const end = b.tables->cube_loops + b.tables->cube_start[cell_case + 1];
    uint32_t index = cell.first_index;
    while (loop != end) {
      const int n = *loop++;
      LoopPoint points[kLongestCubeLoop];
      for (int i = 0; i < n; ++i) {
        // An edge's number within a cell is 4 * axis + b0 + 2 * b1 (mesh/tables.h): split it into these parts.
        const uint32_t edge = loop[i], axis = edge / 4, first = edge & 1, second = edge >> 1 & 1;
        const uint32_t dx = axis == 0 ? 0 : first, dy = axis == 0 ? first : axis == 1 ? 0 : second;
        const int row_y = y + static_cast<int>(dy), row_z = z + static_cast<int>(axis == 2 ? 0 : second);
        const uint32_t number = rows[rowOf(row_y, row_z)].vertices + RowEdges(signs, row_y, row_z).before(x + dx, axis);
        const Vertex& v = b.vertices[part.first_vertex + number];
        points[i] = {v.x, v.y, v.z, chordMask(b.tables->cube_edge_faces[edge], edge, n), number};
      }
      loop += n;
      uint32_t triangles[3 * (kLongestCubeLoop - 2)];
      const uint32_t* const last = triangulateAnyLoop<kLongestCubeLoop>(points, n, triangles);
      for (const uint32_t* corner = triangles; corner != last; ++corner, ++index) {
        b.indices[part.first_index + index] = *corner;
        sum.addIndex(*corner, index);
      }
    }
  }
};

}  // namespace sgm::cuda
