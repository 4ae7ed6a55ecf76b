#pragma once
// Measures of one chunk as it is streamed, cheap enough for every chunk: what is wrong with it, and what it adds to the
// area and the volume of all. Sums are integers, the same for every backend and number of threads.
//
// What is not measured: the field's value at the vertices. Samples do not leave the backend; their signs do, where they
// are asked for, and each vertex is then compared with the edge that it stands for.

#include <array>
#include <cstdint>

#include "mesh/chunk.h"
#include "mesh/part_sums.h"

namespace sgm::measure {

/// Of a body, all of them; of a seam, which lies flat in its face and is closed by its neighbours, the first two and
/// `degenerate`, of corners that may not lie in one place there. What degenerate, flat, folded and cut are:
/// mesh/triangle_faults.h.
enum class Defect : uint8_t {
  index,             ///< triangles with an index beyond the vertices: left out of all that follows
  outside,           ///< vertices beyond the chunk, feature vertices beyond a cell around it: so are their triangles
  misplaced,         ///< vertices on no edge of the grid, or not in the order of these edges, one each
  unlike_samples,    ///< vertices on an edge whose samples have one sign, crossed edges without a vertex
  degenerate,        ///< triangles with two corners in one, by number, which is left out of what follows, or by place
  flat,              ///< triangles whose corners are three places on a line
  duplicate,         ///< triangles with the corners of another
  open_edge,         ///< edges with one triangle that are not in the chunk's border
  turned_edge,       ///< edges that two triangles pass in one direction
  nonmanifold_edge,  ///< edges with more than two triangles
  pinched_vertex,    ///< vertices whose triangles are more than one fan
  folded,            ///< pairs of triangles that lie upon each other at an edge
  self_intersection  ///< pairs of triangles that cut or touch each other elsewhere (mesh/body_pairs.h)
};
inline constexpr size_t kDefects = 13;

/// As users read it: "pinched vertices".
const char* defectName(Defect defect);

using Defects = std::array<uint32_t, kDefects>;

/// Of a body or a seam: what PartSums has, of triangles that are not left out but for the count of all, and what is
/// wrong. Lengths are in 1/256 of the chunk's cell.
struct PartMeasures : PartSums {
  uint32_t vertices = 0;
  Defects defects{};
  uint32_t slivers = 0;           ///< triangles of quality below 0.05, flat ones included
  uint32_t against_gradient = 0;  ///< triangles with an area that do not face along their corners' normals

  friend bool operator==(const PartMeasures&, const PartMeasures&) = default;
  uint32_t defect(Defect kind) const { return defects[static_cast<size_t>(kind)]; }
};

/// How a body hangs together. Vertices that stand for one (mesh/split_creases.h) are one.
struct BodyTopology {
  uint32_t vertices = 0, edges = 0, triangles = 0;  ///< of triangles that are neither left out nor degenerate
  std::array<uint32_t, 6> border_edges{};           ///< with one triangle, by the Face that they lie in
  uint32_t compared = 0;                            ///< vertices that were compared with samples
  friend bool operator==(const BodyTopology&, const BodyTopology&) = default;
  int64_t euler() const { return int64_t{vertices} - edges + triangles; }
};

struct ChunkMeasures {
  std::array<PartMeasures, 7> parts{};  ///< the body, then the seams by Face; zero where there is none
  BodyTopology topology;
  friend bool operator==(const ChunkMeasures&, const ChunkMeasures&) = default;
};

/// Chunks of one or of several levels together.
struct SurfaceSums {
  uint64_t bodies = 0, seams = 0;  ///< with triangles
  uint64_t triangles = 0, bytes = 0;
  uint64_t slivers = 0, against_gradient = 0, border_edges = 0, compared = 0;
  std::array<uint64_t, kDefects> defects{};
  double area = 0;                      ///< square metres
  std::array<double, 3> area_vector{};  ///< likewise; 0 for a closed surface
  /// Cubic metres: a third of the flux of x about the world's origin. Of chunks whose bodies and seams together are
  /// closed it is the volume of the solid inside.
  double flux = 0;

  /// Adds the body where it is asked for, and seams by bit (1 << Face). Order decides the last bits of the last three.
  void add(const ChunkMeasures& chunk, const ChunkGrid& grid, bool body, uint8_t seam_faces);
  void add(const SurfaceSums& other);
  bool sound() const;  ///< without a defect
  friend bool operator==(const SurfaceSums&, const SurfaceSums&) = default;
};

}  // namespace sgm::measure
