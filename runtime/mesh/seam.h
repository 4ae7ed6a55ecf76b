#pragma once
// The seam between a chunk and a neighbour one level coarser: a sheet of seam cells of zero thickness in the common
// face of the two chunks. The seam belongs to the finer chunk.

#include "mesh/chunk.h"
#include "mesh/fans.h"

namespace sgm {

inline constexpr int kCoarseCells = kChunkCells / 2;  ///< number of coarse squares along each side of the face
inline constexpr int kCoarseSamples = kCoarseCells + 1;

/// Samples of the field of the coarser level at the coarse grid points of one face. In q, a varies fastest, then b. Bit
/// a of signs[b] is set if sample (a, b) is solid. As in ChunkSamples, q is only read at the ends of crossed edges:
/// coarse edges in the face whose ends differ in sign.
struct CoarseFace {
  std::array<int32_t, kCoarseSamples * kCoarseSamples> q{};
  std::array<uint32_t, kCoarseSamples> signs{};
};

/// The position of coarse sample (a, b) of a face, in units: a along u = (axis + 1) % 3, b along v = (axis + 2) % 3.
inline Int3 coarseFacePoint(const ChunkGrid& grid, Face face, int a, int b) {
  const int axis = faceAxis(face);
  Int3 p = grid.origin;
  p[axis] += faceIsHigh(face) ? kChunkCells * grid.cell : 0;
  p[(axis + 1) % 3] += 2 * a * grid.cell;
  p[(axis + 2) % 3] += 2 * b * grid.cell;
  return p;
}

/// Replaces part by the seam over one face. Positions are in 1/256 of the fine cell from the fine chunk's origin, as in
/// a body. Vertices on fine edges are those of the fine chunk's body, and vertices on coarse edges those of the coarse
/// chunk's body, bit-identical in key and world position. Lateral vertices lie at the corner of the coarse grid that
/// their edge joins. `coarser` affects only the fans in the keys of lateral vertices at the face's border: vertices,
/// indices and hash are a pure function of chunk and face. Canonical order of vertices: first those on fine edges by
/// owning sample (b, then a), u-edge before v-edge; then those on coarse edges in the same way by coarse sample; then
/// lateral ones by coarse sample. Canonical order of triangles: by seam cell (b, a), then by loop (tables.h), then as
/// triangulateFlatLoop outputs them. Fills x, y, z, kind and keys only, as polygonizeBody does; the caller evaluates
/// the attributes of a vertex in the field of the level in its key.
void polygonizeSeam(Face face, const ChunkSamples& fine, const CoarseFace& coarse, const ChunkGrid& grid,
                    Neighbourhood coarser, MeshPart& part);

}  // namespace sgm
