#pragma once
// Measures of one chunk as it is streamed, cheap enough for every chunk: what is wrong with it, and what it adds to the
// area and the volume of all. Sums are integers, the same for every backend and number of threads.
//
// What is not measured: the field's value at the vertices. Samples do not leave the backend; their signs do, where they
// are asked for, and each vertex is then compared with the edge that it stands for.

#include <array>
#include <cstdint>
#include <memory_resource>
#include <span>

#include "measure/chunk_stars.h"
#include "mesh/packed_mesh.h"
#include "mesh/triangle_terms.h"

namespace sgm::measure {

/// Of a body, all of them; of a seam, which lies flat in its face and is closed by its neighbours, the first two and
/// `degenerate`.
enum class Defect : uint8_t {
  index,             ///< triangles with an index beyond the vertices: left out of all that follows
  outside,           ///< vertices beyond the chunk, feature vertices beyond a cell around it: so are their triangles
  misplaced,         ///< vertices on no edge of the grid, or not in the order of these edges, one each
  unlike_samples,    ///< vertices on an edge whose samples have one sign, crossed edges without a vertex
  degenerate,        ///< triangles with a corner twice: left out of what follows
  flat,              ///< triangles whose corners are three places on a line, where no feature vertex is among them
  duplicate,         ///< triangles with the corners of another
  open_edge,         ///< edges with one triangle that are not in the chunk's border
  turned_edge,       ///< edges that two triangles pass in one direction
  nonmanifold_edge,  ///< edges with more than two triangles
  pinched_vertex,    ///< vertices whose triangles are more than one fan
};
inline constexpr size_t kDefects = 11;

/// As users read it: "pinched vertices".
const char* defectName(Defect defect);

using Defects = std::array<uint32_t, kDefects>;

/// Of a body or a seam. Lengths are in 1/256 of the chunk's cell, from the chunk's origin.
struct PartMeasures {
  uint32_t vertices = 0, triangles = 0;  ///< as given
  Defects defects{};
  uint32_t slivers = 0;            ///< triangles of quality below 0.05, flat ones included
  uint32_t against_gradient = 0;   ///< triangles with an area that do not face along their corners' normals
  uint64_t area = 0;               ///< sum of twice the areas, each rounded to 1/4096 (fixedRoot)
  std::array<int64_t, 3> cross{};  ///< sum of the cross products: twice the area vector
  int64_t six_volumes = 0;         ///< six times the flux of x / 3 about the chunk's origin

  uint32_t defect(Defect kind) const { return defects[static_cast<size_t>(kind)]; }
};

/// How a body hangs together. Vertices that stand for one (mesh/split_creases.h) are one.
struct BodyTopology {
  uint32_t vertices = 0, edges = 0, triangles = 0;  ///< of triangles that are neither left out nor degenerate
  std::array<uint32_t, 6> border_edges{};           ///< with one triangle, by the Face that they lie in
  uint32_t compared = 0;                            ///< vertices that were compared with samples
  int64_t euler() const { return int64_t{vertices} - edges + triangles; }
};

struct ChunkMeasures {
  std::array<PartMeasures, 7> parts{};  ///< the body, then the seams by Face; zero where there is none
  BodyTopology topology;
};

/// A part's vertices, and its triangles, whose indices count from first_vertex.
struct PartView {
  std::span<const Vertex> vertices;
  std::span<const uint32_t> indices;
  uint32_t first_vertex = 0;
};
inline PartView viewOf(const MeshPart& part) { return {part.vertices, part.indices}; }
PartView viewOf(const PackedMesh& mesh, size_t part);

/// Memory that goes from chunk to chunk: as much as the largest needs, some 40 bytes a triangle. One thread at a time.
struct MeasureScratch {
  StarScratch stars;
  std::pmr::vector<uint8_t> planes;              ///< by vertex: bit (1 << Face), and what else the measurer notes
  std::pmr::vector<PackedDirection> directions;  ///< by vertex
  std::pmr::vector<uint32_t> indices;            ///< of triangles that are not left out
  std::pmr::vector<uint32_t> first, table;       ///< of feature vertices that stand for one

  explicit MeasureScratch(std::pmr::memory_resource* memory)
      : stars(memory), planes(memory), directions(memory), indices(memory), first(memory), table(memory) {}
};

/// Measures the body into parts[0] and topology. signs: those of its samples (ChunkSamples::signs), or empty. Fewer
/// than 2^20 triangles, so that no sum overflows, whatever they are. Some 20 ns a triangle. Throws std::bad_alloc.
void measureBody(const PartView& body, std::span<const uint64_t> signs, MeasureScratch& scratch,
                 ChunkMeasures& measures);

/// Likewise a seam, of which only the first two defects, degenerate triangles, area and flux are measured.
PartMeasures measureSeam(const PartView& seam);

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
};

}  // namespace sgm::measure
