#pragma once
// Measures of a streamed chunk: its defects, and its contribution to the total area and volume. They are cheap enough
// to be taken of every chunk. Sums are integers, the same for every backend and number of threads.
//
// The field's values at the vertices are not checked, because samples stay on the backend. On request, the backend
// returns the samples' signs, and each vertex is compared with the signs at the ends of its grid edge.

#include <array>
#include <cstdint>

#include "mesh/chunk.h"
#include "mesh/part_sums.h"

namespace sgm::measure {

/// The kinds of defects of a part. In a body, all kinds are counted. A seam lies flat in its face, and is closed only
/// together with the bodies beside it. So in a seam, only three kinds are counted: `index`, `outside`, and `degenerate`
/// for corners that must not share a position. mesh/triangle_faults.h defines degenerate, flat, folded and cut.
enum class Defect : uint8_t {
  index,  ///< triangles with an index beyond the vertices; excluded from all other counts
  /// vertices beyond the chunk (feature vertices: more than two cells beyond); their triangles are excluded
  outside,
  /// vertices that lie on no grid edge, share a grid edge with an earlier vertex, or are not in the order of the grid
  /// edges
  misplaced,
  /// vertices on a grid edge whose end samples have equal signs, and grid edges with a change of sign but without a
  /// vertex
  unlike_samples,
  degenerate,        ///< triangles with two equal corners, by index (then excluded from other counts) or by position
  flat,              ///< triangles whose corners are three distinct points on a line
  duplicate,         ///< triangles with the same corners as an earlier triangle
  open_edge,         ///< edges of only one triangle that do not lie in a face of the chunk
  turned_edge,       ///< misoriented edges: two triangles use them in the same direction
  nonmanifold_edge,  ///< edges of more than two triangles
  pinched_vertex,    ///< non-manifold vertices: their triangles form more than one fan
  folded,            ///< pairs of triangles with a common edge that also overlap beside it
  self_intersection  ///< pairs of triangles without a common edge that meet at a point other than a common corner
                     ///< (mesh/body_pairs.h)
};
inline constexpr size_t kDefects = 13;

/// Returns the name of a kind of defect for users, such as "non-manifold vertices".
const char* defectName(Defect defect);

using Defects = std::array<uint32_t, kDefects>;

/// The measures of a body or a seam: the sums of PartSums and the defects. Excluded triangles are counted in
/// `triangles`, but in no sum. Lengths are in 1/256 of the chunk's cell.
struct PartMeasures : PartSums {
  uint32_t vertices = 0;
  Defects defects{};
  uint32_t slivers = 0;  ///< triangles of quality below 0.05, including flat ones
  /// triangles of non-zero area whose front faces away from the sum of their corners' normals
  uint32_t against_gradient = 0;

  friend bool operator==(const PartMeasures&, const PartMeasures&) = default;
  uint32_t defect(Defect kind) const { return defects[static_cast<size_t>(kind)]; }
};

/// The topology of a body. The copies that splitCreases() made of a vertex (mesh/split_creases.h) count as one vertex.
struct BodyTopology {
  uint32_t vertices = 0, edges = 0, triangles = 0;  ///< counts without excluded and degenerate triangles
  std::array<uint32_t, 6> border_edges{};           ///< edges of only one triangle in a face of the chunk, by Face
  uint32_t compared = 0;                            ///< number of vertices that were compared with the signs of samples
  friend bool operator==(const BodyTopology&, const BodyTopology&) = default;
  int64_t euler() const { return int64_t{vertices} - edges + triangles; }
};

struct ChunkMeasures {
  std::array<PartMeasures, 7> parts{};  ///< measures of the body, then of the seams by Face; all 0 if absent
  BodyTopology topology;
  friend bool operator==(const ChunkMeasures&, const ChunkMeasures&) = default;
};

/// Sums of the measures of chunks, of one or several levels.
struct SurfaceSums {
  uint64_t bodies = 0, seams = 0;  ///< number of bodies and of seams that have triangles
  uint64_t triangles = 0, bytes = 0;
  uint64_t slivers = 0, against_gradient = 0, border_edges = 0, compared = 0;
  std::array<uint64_t, kDefects> defects{};
  double area = 0;                      ///< square metres
  std::array<double, 3> area_vector{};  ///< square metres; 0 for a closed surface
  /// Cubic metres: a third of the flux of the position vector about the world's origin. If the bodies and seams
  /// together are closed, it is the volume of the solid inside.
  double flux = 0;

  /// Adds the chunk's body if `body` is true, and the seams whose bit (1 << Face) is set. The order of calls affects
  /// the last bits of area, area_vector and flux.
  void add(const ChunkMeasures& chunk, const ChunkGrid& grid, bool body, uint8_t seam_faces);
  void add(const SurfaceSums& other);
  bool sound() const;  ///< true if there is no defect
  friend bool operator==(const SurfaceSums&, const SurfaceSums&) = default;
};

}  // namespace sgm::measure
