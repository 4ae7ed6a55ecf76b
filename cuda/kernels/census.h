#pragma once
// Counts the vertices and indices of each mesh part from the samples' signs alone: for each row of a body (a chunk's
// own surface), and for each row and cell of a seam (the strip between a chunk and a coarser neighbour). Then computes
// the offset of each part in the output.

#include "cuda/kernels/grid.h"

namespace sgm::cuda {

/// Returns the marching cubes case of the cell at (x, y, z), one bit for each corner that is solid.
SGM_KERNEL uint32_t caseOf(const uint64_t* signs, uint32_t x, int y, int z) {
  const uint64_t* row = signs + rowOf(y, z);
  const auto two = [&](size_t at) { return static_cast<uint32_t>(row[at] >> x & 3); };
  return two(0) | two(1) << 2 | two(kSide) << 4 | two(kSide + 1) << 6;
}

/// Returns a mask of the active cells in row (y, z): those that the surface crosses.
SGM_KERNEL uint64_t activeCells(const uint64_t* signs, int y, int z) {
  const uint64_t* row = signs + rowOf(y, z);
  const uint64_t a = row[0], b = row[1], c = row[kSide], d = row[kSide + 1];
  const uint64_t some = a | b | c | d, all = a & b & c & d;
  return (some | some >> 1) & ~(all & all >> 1) & ((uint64_t{1} << kChunkCells) - 1);
}

/// Kernel: counts the vertices and indices of bodies. One block per chunk.
struct CensusBody {
  static constexpr uint32_t kThreads = 256;
  struct Shared {
    uint32_t vertices[kRows], indices[kRows], cells[kRows];
  };

  template <class Block>
  SGM_KERNEL static void run(Block& block, const Batch& b, Shared& shared) {
    const Chunk& chunk = b.chunks[block.number()];
    if (chunk.body == kNone) return;
    const uint64_t* signs = b.signs + size_t{kRows} * block.number();
    block.each([&](uint32_t thread) {
      for (uint32_t row = thread; row < kRows; row += kThreads) count(b, signs, row, shared);
    });
    const uint32_t vertices = block.scan(shared.vertices, kRows);
    const uint32_t indices = block.scan(shared.indices, kRows);
    block.scan(shared.cells, kRows);
    block.each([&](uint32_t thread) {
      Row* rows = b.rows + size_t{kRows} * block.number();
      for (uint32_t row = thread; row < kRows; row += kThreads) {
        rows[row] = {shared.vertices[row], shared.indices[row], shared.cells[row]};
      }
      if (thread > 0) return;
      b.parts[chunk.body].vertices = vertices;
      b.parts[chunk.body].indices = indices;
    });
  }

  SGM_KERNEL static void count(const Batch& b, const uint64_t* signs, uint32_t row, Shared& shared) {
    const int y = static_cast<int>(row % kSide), z = static_cast<int>(row / kSide);
    shared.vertices[row] = RowEdges(signs, y, z).countIn(~uint64_t{0});
    shared.indices[row] = shared.cells[row] = 0;
    if (y == kChunkCells || z == kChunkCells) return;
    uint32_t triangles = 0;
    const uint64_t active = activeCells(signs, y, z);
    for (uint64_t left = active; left != 0; left &= left - 1) {
      triangles += b.tables->cube_triangles[caseOf(signs, lowestOf(left), y, z)];
    }
    shared.indices[row] = 3 * triangles;
    shared.cells[row] = countOf(active);
  }
};

/// The samples of a chunk that lie on one of its faces, addressed by coordinates u and v.
struct FacePlane {
  uint32_t origin, step_u, step_v;  ///< number of the first sample, and the differences of sample numbers along u and
                                    ///< along v
  SGM_KERNEL explicit FacePlane(Face face) {
    const uint32_t steps[3] = {1, kSide, kRows};
    const int axis = faceAxis(face);
    origin = faceIsHigh(face) ? kChunkCells * steps[axis] : 0;
    step_u = steps[(axis + 1) % 3];
    step_v = steps[(axis + 2) % 3];
  }
  SGM_KERNEL uint32_t sample(uint32_t a, uint32_t b) const { return origin + a * step_u + b * step_v; }
};

/// The crossed edges (edges whose two ends have different signs) that start in one row of a sign plane, along u and
/// along v. cells: number of cells along each side of the plane.
struct PlaneEdges {
  uint64_t u, v;
  template <class Word>
  SGM_KERNEL PlaneEdges(const Word* plane, uint32_t row, uint32_t cells) {
    const uint64_t signs = plane[row];
    u = (signs ^ signs >> 1) & ((uint64_t{1} << cells) - 1);
    v = row < cells ? signs ^ plane[row + 1] : 0;
  }
  SGM_KERNEL uint32_t countIn(uint64_t samples) const { return countOf(u & samples) + countOf(v & samples); }
  SGM_KERNEL uint32_t before(uint32_t at, bool along_v) const {
    return countIn((uint64_t{1} << at) - 1) + (along_v ? static_cast<uint32_t>(u >> at & 1) : 0);
  }
};

/// Returns a mask of the corners in a coarse row at which the fine and the coarse level have different signs.
SGM_KERNEL uint64_t lateralEdges(const uint64_t* plane, const uint32_t* coarse, uint32_t row) {
  uint64_t edges = 0;
  for (uint32_t a = 0; a < kCoarseSide; ++a) {
    edges |= uint64_t{(plane[2 * row] >> 2 * a & 1) != (coarse[row] >> a & 1)} << a;
  }
  return edges;
}

/// Kernel: counts the vertices and indices of seams. One block per seam, one thread per cell.
struct CensusSeam {
  static constexpr uint32_t kThreads = kSeamCells;
  struct Shared {
    uint64_t plane[kSide];
    uint32_t coarse_signs[kCoarseSide];
    uint32_t fine[kSide], coarse[kCoarseSide], lateral[kCoarseSide], indices[kSeamCells];
  };

  template <class Block>
  SGM_KERNEL static void run(Block& block, const Batch& b, Shared& shared) {
    const Seam& seam = b.seams[block.number()];
    SeamCensus& census = b.seam_census[block.number()];
    block.each([&](uint32_t thread) {
      if (thread < kSide) shared.plane[thread] = planeRow(b, seam, thread);
      if (thread < kCoarseSide) {
        shared.coarse_signs[thread] = b.coarse_signs[size_t{kCoarseSide} * block.number() + thread];
      }
    });
    block.each([&](uint32_t thread) {
      if (thread < kSide) {
        census.plane[thread] = shared.plane[thread];
        shared.fine[thread] = PlaneEdges(shared.plane, thread, kChunkCells).countIn(~uint64_t{0});
      }
      if (thread < kCoarseSide) {
        shared.coarse[thread] = PlaneEdges(shared.coarse_signs, thread, kCoarseSide - 1).countIn(~uint64_t{0});
        shared.lateral[thread] = countOf(lateralEdges(shared.plane, shared.coarse_signs, thread));
      }
      const uint32_t seam_case = caseOfCell(shared.plane, shared.coarse_signs, thread % 16, thread / 16);
      shared.indices[thread] = 3u * b.tables->seam_triangles[seam_case];
    });
    const uint32_t fine = block.scan(shared.fine, kSide), coarse = block.scan(shared.coarse, kCoarseSide);
    const uint32_t lateral = block.scan(shared.lateral, kCoarseSide), indices = block.scan(shared.indices, kSeamCells);
    block.each([&](uint32_t thread) {
      if (thread < kSide) census.fine[thread] = shared.fine[thread];
      if (thread < kCoarseSide) census.coarse[thread] = shared.coarse[thread];
      if (thread < kCoarseSide) census.lateral[thread] = shared.lateral[thread];
      census.indices[thread] = shared.indices[thread];
      if (thread > 0) return;
      census.first_coarse = fine;
      census.first_lateral = fine + coarse;
      b.parts[seam.part].vertices = fine + coarse + lateral;
      b.parts[seam.part].indices = indices;
    });
  }

  SGM_KERNEL static uint64_t planeRow(const Batch& b, const Seam& seam, uint32_t row) {
    const uint64_t* signs = b.signs + size_t{kRows} * seam.chunk;
    const FacePlane face(static_cast<Face>(seam.face));
    uint64_t bits = 0;
    for (uint32_t a = 0; a < kSide; ++a) {
      const uint32_t sample = face.sample(a, row);
      bits |= (signs[sample / kSide] >> sample % kSide & 1) << a;
    }
    return bits;
  }

  SGM_KERNEL static uint32_t caseOfCell(const uint64_t* plane, const uint32_t* coarse, uint32_t a, uint32_t b) {
    const auto fine = [&](uint32_t row) { return static_cast<uint32_t>(plane[2 * b + row] >> 2 * a & 7); };
    const uint32_t coarse_bits = (coarse[b] >> a & 3) | (coarse[b + 1] >> a & 3) << 2;
    return fine(0) | fine(1) << 3 | fine(2) << 6 | coarse_bits << 9;
  }
};

/// Kernel of one block: assigns each part consecutive ranges in the output arrays, as long as there is room.
struct Allocate {
  static constexpr uint32_t kThreads = 256;
  struct Shared {
    uint32_t vertices[kThreads], indices[kThreads];
  };

  template <class Block>
  SGM_KERNEL static void run(Block& block, const Batch& b, Shared& shared) {
    uint32_t vertices = 0, indices = 0;
    for (uint32_t first = 0; first < b.part_count; first += kThreads) {
      block.each([&](uint32_t thread) {
        const bool is_part = first + thread < b.part_count;
        shared.vertices[thread] = is_part ? b.parts[first + thread].vertices : 0;
        shared.indices[thread] = is_part ? b.parts[first + thread].indices : 0;
      });
      const uint32_t more_vertices = block.scan(shared.vertices, kThreads);
      const uint32_t more_indices = block.scan(shared.indices, kThreads);
      block.each([&](uint32_t thread) {
        if (first + thread >= b.part_count) return;
        Part& part = b.parts[first + thread];
        const uint32_t vertex = vertices + shared.vertices[thread], index = indices + shared.indices[thread];
        const bool has_room = vertex + part.vertices <= b.vertices_room && index + part.indices <= b.indices_room;
        part.first_vertex = has_room ? vertex : kNone;
        part.first_index = has_room ? index : kNone;
        if (!has_room) return;
        raiseTo(b.head->vertices, vertex + part.vertices);
        raiseTo(b.head->indices, index + part.indices);
      });
      vertices += more_vertices;
      indices += more_indices;
    }
  }
};

}  // namespace sgm::cuda
