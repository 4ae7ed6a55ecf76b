#pragma once
// Kernels that write the vertices and triangles of seams (strips between a chunk and a coarser neighbour), in the same
// order as mesh/seam.cpp on the CPU.

#include "cuda/kernels/census.h"
#include "cuda/kernels/field.h"
#include "mesh/triangulate_any.h"

namespace sgm::cuda {

/// Computes the number of a seam's vertex from the edge on which the vertex lies.
struct SeamNumbers {
  const SeamCensus& census;
  const uint32_t* coarse_signs;

  SGM_KERNEL uint32_t fine(uint32_t a, uint32_t b, bool along_v) const {
    return census.fine[b] + PlaneEdges(census.plane, b, kChunkCells).before(a, along_v);
  }
  SGM_KERNEL uint32_t coarse(uint32_t a, uint32_t b, bool along_v) const {
    return census.first_coarse + census.coarse[b] + PlaneEdges(coarse_signs, b, kCoarseSide - 1).before(a, along_v);
  }
  SGM_KERNEL uint32_t lateral(uint32_t a, uint32_t b) const {
    const uint64_t before = (uint64_t{1} << a) - 1;
    return census.first_lateral + census.lateral[b] + countOf(lateralEdges(census.plane, coarse_signs, b) & before);
  }
  /// Returns the number of the vertex on edge e of the seam cell over coarse square (a, b). Edge numbers are those of
  /// mesh/tables.h.
  SGM_KERNEL uint32_t ofEdge(uint32_t a, uint32_t b, uint32_t e) const {
    if (e < 6) return fine(2 * a + e % 2, 2 * b + e / 2, false);
    if (e < 12) return fine(2 * a + (e - 6) % 3, 2 * b + (e - 6) / 3, true);
    if (e < 14) return coarse(a, b + e - 12, false);
    if (e < 16) return coarse(a + e - 14, b, true);
    return lateral(a + (e - 16) % 2, b + (e - 16) / 2);
  }
};

/// Kernel: writes the vertices of a seam; their attributes come from the field of the level to which the vertex
/// belongs. One block per seam.
struct SeamVertices {
  static constexpr uint32_t kThreads = 96;
  struct Shared {
    uint32_t hash[2];
  };

  template <class Block>
  SGM_KERNEL static void run(Block& block, const Batch& b, Shared& shared) {
    const Seam& seam = b.seams[block.number()];
    const Part& part = b.parts[seam.part];
    if (part.vertices == 0 || part.first_vertex == kNone) return;
    block.each([&](uint32_t thread) {
      if (thread < 2) shared.hash[thread] = 0;
    });
    block.each([&](uint32_t thread) {
      PartSum sum;
      for (uint32_t i = thread; i < part.vertices; i += kThreads) emit(b, block.number(), i, sum);
      sum.giveTo(shared.hash);
    });
    block.each([&](uint32_t thread) {
      if (thread < 2) addTo(b.parts[seam.part].hash[thread], shared.hash[thread]);
    });
  }

  /// An edge in the face's plane. It starts at (a, b), and runs along v if along_v is true, otherwise along u.
  struct Edge {
    uint32_t a, b;
    bool along_v;
  };

  /// Returns crossed edge n, counted from 0, of a sign plane. (An edge is crossed if the signs at its ends differ.)
  /// before: for each row, the number of crossed edges in all previous rows.
  template <class Word>
  SGM_KERNEL static Edge edgeOf(const Word* plane, const uint32_t* before, uint32_t side, uint32_t n) {
    const uint32_t row = lastAtMost(before, side, n);
    n -= before[row];
    const PlaneEdges edges(plane, row, side - 1);
    for (uint64_t left = edges.u | edges.v;; left &= left - 1) {
      const uint32_t a = lowestOf(left), here = edges.countIn(uint64_t{1} << a);
      if (n < here) return {a, row, n == 1 || (edges.u >> a & 1) == 0};
      n -= here;
    }
  }

  SGM_KERNEL static Vertex vertexAt(Face face, Edge edge, uint32_t step, uint32_t t, bool lateral) {
    const int axis = faceAxis(face), u = (axis + 1) % 3, v = (axis + 2) % 3;
    uint32_t at[3];
    at[axis] = faceIsHigh(face) ? kChunkCells * kSubcell : 0;
    at[u] = edge.a * step * kSubcell + (lateral || edge.along_v ? 0 : t * step);
    at[v] = edge.b * step * kSubcell + (lateral || !edge.along_v ? 0 : t * step);
    Vertex vertex{};
    vertex.x = static_cast<int16_t>(at[0]);
    vertex.y = static_cast<int16_t>(at[1]);
    vertex.z = static_cast<int16_t>(at[2]);
    vertex.kind = step == 1 ? kOwnEdge : lateral ? kLateralEdge : kCoarserEdge;
    return vertex;
  }

  SGM_KERNEL static void emit(const Batch& b, uint32_t seam_number, uint32_t number, PartSum& sum) {
    const Seam& seam = b.seams[seam_number];
    const auto face = static_cast<Face>(seam.face);
    const SeamCensus& census = b.seam_census[seam_number];
    const uint32_t* coarse_signs = b.coarse_signs + size_t{kCoarseSide} * seam_number;
    const bool coarse = number >= census.first_coarse && number < census.first_lateral;
    Vertex v;
    if (number < census.first_coarse) {
      const Edge edge = edgeOf(census.plane, census.fine, kSide, number);
      const FacePlane plane(face);
      const int32_t* q = b.samples + size_t{kSamples} * seam.chunk + plane.sample(edge.a, edge.b);
      v = vertexAt(face, edge, 1, crossing(q[0], q[edge.along_v ? plane.step_v : plane.step_u]), false);
    } else if (coarse) {
      const Edge edge = edgeOf(coarse_signs, census.coarse, kCoarseSide, number - census.first_coarse);
      const int32_t* q = b.coarse_samples + size_t{kCoarsePlane} * seam_number + edge.a + size_t{kCoarseSide} * edge.b;
      v = vertexAt(face, edge, 2, crossing(q[0], q[edge.along_v ? kCoarseSide : 1]), false);
    } else {
      uint32_t n = number - census.first_lateral;
      const uint32_t row = lastAtMost(census.lateral, kCoarseSide, n);
      n -= census.lateral[row];
      uint64_t left = lateralEdges(census.plane, coarse_signs, row);
      for (; n > 0; --n) left &= left - 1;
      v = vertexAt(face, {lowestOf(left), row, false}, 2, 0, true);
    }
    const Item& item = b.items[planeItem(b, seam_number, coarse)];
    if (b.meshes) giveAttributes(viewOf(b, item), vertexUnits(gridOf(b.chunks[seam.chunk]), v), v);
    b.vertices[b.parts[seam.part].first_vertex + number] = v;
    sum.add(v, number);
  }
};

/// Kernel: writes the triangles of a seam. One block per seam, one thread per cell.
struct SeamTriangles {
  static constexpr uint32_t kThreads = kSeamCells;
  struct Shared {
    uint32_t hash[2];
  };

  template <class Block>
  SGM_KERNEL static void run(Block& block, const Batch& b, Shared& shared) {
    const Seam& seam = b.seams[block.number()];
    if (b.parts[seam.part].indices == 0 || b.parts[seam.part].first_index == kNone) return;
    block.each([&](uint32_t thread) {
      if (thread < 2) shared.hash[thread] = 0;
    });
    block.each([&](uint32_t thread) {
      PartSum sum;
      emit(b, block.number(), thread % 16, thread / 16, sum);
      sum.giveTo(shared.hash);
    });
    block.each([&](uint32_t thread) {
      if (thread < 2) addTo(b.parts[seam.part].hash[thread], shared.hash[thread]);
    });
  }

  SGM_KERNEL static void emit(const Batch& b, uint32_t seam_number, uint32_t at_a, uint32_t at_b, PartSum& sum) {
    const Seam& seam = b.seams[seam_number];
    const SeamCensus& census = b.seam_census[seam_number];
    const Part& part = b.parts[seam.part];
    const SeamNumbers numbers{census, b.coarse_signs + size_t{kCoarseSide} * seam_number};
    const uint32_t seam_case = CensusSeam::caseOfCell(census.plane, numbers.coarse_signs, at_a, at_b);
    const uint8_t* loop = b.tables->seam_loops + b.tables->seam_start[seam_case];
    const uint8_t* const end = b.tables->seam_loops + b.tables->seam_start[seam_case + 1];
    const bool high = faceIsHigh(static_cast<Face>(seam.face));
    uint32_t index = census.indices[at_a + 16 * at_b];
    while (loop != end) {
      const int n = *loop++;
      LoopPoint points[kLongestLoop];
      for (int i = 0; i < n; ++i) {
        const uint32_t edge = loop[i == 0 || high ? i : n - i];
        const uint32_t number = numbers.ofEdge(at_a, at_b, edge);
        const Vertex& v = b.vertices[part.first_vertex + number];
        points[i] = {v.x, v.y, v.z, b.tables->seam_edge_faces[edge], number};
      }
      loop += n;
      uint32_t triangles[3 * (kLongestLoop - 2)];
      const uint32_t* const last = triangulateFlatLoop(points, n, triangles);
      for (const uint32_t* corner = triangles; corner != last; ++corner, ++index) {
        b.indices[part.first_index + index] = *corner;
        sum.addIndex(*corner, index);
      }
    }
  }
};

}  // namespace sgm::cuda
