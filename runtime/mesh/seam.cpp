#include "mesh/seam.h"

#include <algorithm>
#include <bit>

#include "mesh/tables.h"
#include "mesh/triangulate_any.h"
#include "mesh/vertex.h"

namespace sgm {
namespace {

constexpr size_t kFineSide = kChunkSamples;
constexpr size_t kCoarseSide = kCoarseSamples;

/// The fine samples in the seam's face: their signs (bit a of word b), and their offset and strides in ChunkSamples::q.
struct FinePlane {
  std::array<uint64_t, kFineSide> signs{};
  size_t origin = 0, step_u = 0, step_v = 0;
};

FinePlane planeOfFace(const ChunkSamples& samples, Face face) {
  constexpr std::array<size_t, 3> kStep{1, kFineSide, kFineSide * kFineSide};
  const auto axis = static_cast<size_t>(faceAxis(face));
  FinePlane plane;
  plane.origin = faceIsHigh(face) ? kChunkCells * kStep[axis] : 0;
  plane.step_u = kStep[(axis + 1) % 3];
  plane.step_v = kStep[(axis + 2) % 3];
  for (size_t b = 0; b < kFineSide; ++b) {
    uint64_t word = 0;
    for (size_t a = 0; a < kFineSide; ++a) {
      const size_t sample = plane.origin + a * plane.step_u + b * plane.step_v;
      word |= (samples.signs[sample / kFineSide] >> sample % kFineSide & 1) << a;
    }
    plane.signs[b] = word;
  }
  return plane;
}

/// Builds one seam. Stores the number of the vertex on each crossed edge, by the sample at which the edge starts.
class SeamBuilder {
 public:
  SeamBuilder(Face face, const ChunkGrid& grid, MeshPart& part)
      : face_(face), axis_(faceAxis(face)), u_((axis_ + 1) % 3), v_((axis_ + 2) % 3), grid_(grid), part_(part) {}

  void addFineVertices(const FinePlane& plane, const ChunkSamples& samples) {
    for (size_t b = 0; b < kFineSide; ++b) {
      const uint64_t row = plane.signs[b];
      const uint64_t along_u = (row ^ row >> 1) & ((uint64_t{1} << kChunkCells) - 1);
      const uint64_t along_v = b < kChunkCells ? row ^ plane.signs[b + 1] : 0;
      for (uint64_t owners = along_u | along_v; owners != 0; owners &= owners - 1) {
        const auto a = static_cast<size_t>(std::countr_zero(owners));
        const size_t sample = plane.origin + a * plane.step_u + b * plane.step_v;
        if (along_u >> a & 1) {
          fine_[b][a][0] = addVertex(a, b, 1, u_, crossing(samples.q[sample], samples.q[sample + plane.step_u]));
        }
        if (along_v >> a & 1) {
          fine_[b][a][1] = addVertex(a, b, 1, v_, crossing(samples.q[sample], samples.q[sample + plane.step_v]));
        }
      }
    }
  }

  void addCoarseVertices(const CoarseFace& coarse) {
    for (size_t b = 0; b < kCoarseSide; ++b) {
      const uint32_t row = coarse.signs[b];
      const uint32_t along_u = (row ^ row >> 1) & ((1u << kCoarseCells) - 1);
      const uint32_t along_v = b < kCoarseCells ? row ^ coarse.signs[b + 1] : 0;
      for (uint32_t owners = along_u | along_v; owners != 0; owners &= owners - 1) {
        const auto a = static_cast<size_t>(std::countr_zero(owners));
        const int32_t* q = coarse.q.data() + a + b * kCoarseSide;
        if (along_u >> a & 1) coarse_[b][a][0] = addVertex(a, b, 2, u_, crossing(q[0], q[1]));
        if (along_v >> a & 1) coarse_[b][a][1] = addVertex(a, b, 2, v_, crossing(q[0], q[kCoarseSide]));
      }
    }
  }

  void addLateralVertices(const FinePlane& plane, const CoarseFace& coarse, const SeamFans& fans) {
    const auto place = [](size_t i) { return i == 0 ? size_t{0} : i == kCoarseCells ? size_t{2} : size_t{1}; };
    for (size_t b = 0; b < kCoarseSide; ++b) {
      for (size_t a = 0; a < kCoarseSide; ++a) {
        if ((plane.signs[2 * b] >> 2 * a & 1) == (coarse.signs[b] >> a & 1)) continue;
        lateral_[b][a] = addVertex(a, b, 2, kLateral, 0);
        part_.keys.back().fan = fans[place(b)][place(a)];
      }
    }
  }

  void addCell(size_t a, size_t b, uint32_t cell_case) {
    const uint8_t* at = kSeamLoops + kSeamLoopStart[cell_case];
    const uint8_t* end = kSeamLoops + kSeamLoopStart[cell_case + 1];
    while (at != end) {
      const int n = *at++;
      LoopPoint points[kLongestLoop];
      for (int i = 0; i < n; ++i) {
        const int e = at[i == 0 || faceIsHigh(face_) ? i : n - i];
        const uint32_t number = vertexOfEdge(a, b, static_cast<size_t>(e));
        const Vertex& v = part_.vertices[number];
        points[i] = {v.x, v.y, v.z, kSeamEdgeFaces[e], number};
      }
      at += n;
      uint32_t triangles[3 * (kLongestLoop - 2)];
      part_.indices.insert(part_.indices.end(), triangles, triangulateFlatLoop(points, n, triangles));
    }
  }

 private:
  /// Adds a vertex, and returns its number. The edge of the vertex starts at point (a, b) of the face, counted in steps
  /// of `step` fine cells; the vertex lies at t / 256 of the edge's length.
  uint32_t addVertex(size_t a, size_t b, int32_t step, int edge_axis, uint32_t t) {
    Int3 at, corner = grid_.origin;
    at[axis_] = faceIsHigh(face_) ? kChunkCells : 0;
    at[u_] = static_cast<int32_t>(a) * step;
    at[v_] = static_cast<int32_t>(b) * step;
    for (int i = 0; i < 3; ++i) {
      corner[i] += at[i] * grid_.cell;
      at[i] = at[i] * kSubcell + (i == edge_axis ? static_cast<int32_t>(t) * step : 0);
    }
    Vertex v{};
    v.x = static_cast<int16_t>(at.x);
    v.y = static_cast<int16_t>(at.y);
    v.z = static_cast<int16_t>(at.z);
    v.kind = step == 1 ? kOwnEdge : edge_axis == kLateral ? kLateralEdge : kCoarserEdge;
    const int level = grid_.level + (v.kind == kCoarserEdge ? 1 : 0);
    part_.vertices.push_back(v);
    part_.keys.push_back({corner, static_cast<uint8_t>(level), static_cast<uint8_t>(edge_axis), 0});
    return static_cast<uint32_t>(part_.vertices.size() - 1);
  }

  /// Returns the vertex on edge e of the seam cell at coarse square (a, b); edges are numbered as in tables.h.
  uint32_t vertexOfEdge(size_t a, size_t b, size_t e) const {
    if (e < 6) return fine_[2 * b + e / 2][2 * a + e % 2][0];
    if (e < 12) return fine_[2 * b + (e - 6) / 3][2 * a + (e - 6) % 3][1];
    if (e < 14) return coarse_[b + e - 12][a][0];
    if (e < 16) return coarse_[b][a + e - 14][1];
    return lateral_[b + (e - 16) / 2][a + (e - 16) % 2];
  }

  Face face_;
  int axis_, u_, v_;
  const ChunkGrid& grid_;
  MeshPart& part_;
  // Uninitialised, but safe: an entry is read only for a crossed edge, and the vertex of that edge has been stored
  // before.
  std::array<std::array<std::array<uint32_t, 2>, kFineSide>, kFineSide> fine_;
  std::array<std::array<std::array<uint32_t, 2>, kCoarseSide>, kCoarseSide> coarse_;
  std::array<std::array<uint32_t, kCoarseSide>, kCoarseSide> lateral_;
};

}  // namespace

void polygonizeSeam(Face face, const ChunkSamples& fine, const CoarseFace& coarse, const ChunkGrid& grid,
                    Neighbourhood coarser, MeshPart& part) {
  part.vertices.clear();
  part.keys.clear();
  part.indices.clear();
  part.hash = {};
  const FinePlane plane = planeOfFace(fine, face);
  SeamBuilder builder(face, grid, part);
  builder.addFineVertices(plane, fine);
  builder.addCoarseVertices(coarse);
  builder.addLateralVertices(plane, coarse, seamFans(face, coarser));
  if (part.vertices.empty()) return;

  for (size_t b = 0; b < kCoarseCells; ++b) {
    const uint64_t* rows = plane.signs.data() + 2 * b;
    for (size_t a = 0; a < kCoarseCells; ++a) {
      const uint64_t fine_bits = (rows[0] >> 2 * a & 7) | (rows[1] >> 2 * a & 7) << 3 | (rows[2] >> 2 * a & 7) << 6;
      const uint32_t coarse_bits = (coarse.signs[b] >> a & 3) | (coarse.signs[b + 1] >> a & 3) << 2;
      builder.addCell(a, b, static_cast<uint32_t>(fine_bits) | coarse_bits << 9);
    }
  }
}

}  // namespace sgm
