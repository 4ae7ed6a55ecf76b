#pragma once
// Checks whether the surface drawn in a frame is closed. It processes changes chunk by chunk, so it can check every
// frame of a flight. It compares exact vertex keys, formed only from the public interface's meshes, never hashes; for
// faults of triangles it also uses positions (mesh/triangle_faults.h).

#include <sgm/sgm.h>

#include <array>
#include <cstdint>
#include <map>
#include <memory_resource>
#include <optional>
#include <span>
#include <unordered_map>
#include <utility>
#include <vector>

#include "base/result.h"
#include "mesh/body_pairs.h"
#include "mesh/check.h"
#include "mesh/fans.h"
#include "world/chunk_key.h"

namespace sgm::cli {

/// The drawn seams of a chunk, and its coarser neighbours.
struct DrawnParts {
  uint32_t seams = 0;         ///< faces whose seams are drawn, bit (1u << sgm_face)
  Neighbourhood coarser = 0;  ///< blocks around it that belong to coarser chunks, as in sgm_chunk_request; those across
                              ///< the faces in `seams` always count as coarser
  friend bool operator==(const DrawnParts&, const DrawnParts&) = default;
};

/// The words of an sgm_vertex that identify the vertex.
struct VertexPlace {
  int16_t x = 0, y = 0, z = 0;
  uint16_t kind = 0;
};

/// The seam that a vertex belongs to.
struct SeamOf {
  Face face = Face::x_lo;
  SeamFans fans{};
};

/// The key of a vertex by the rules of sgm_vertex_kind; seam is null for a vertex of a body. nullopt if the vertex is
/// invalid: it lies on no edge, not in the seam's face, or has a kind that a body does not have.
std::optional<VertexKey> vertexKey(const ChunkGrid& grid, const VertexPlace& vertex, const SeamOf* seam);

struct FrameReport {
  uint64_t chunks = 0, triangles = 0;
  uint64_t edges = 0;                 ///< undirected
  uint64_t open_edges = 0;            ///< used more often in one direction than in the other
  uint64_t nonmanifold_edges = 0;     ///< used at least twice in one direction, as every edge of three triangles
  uint64_t degenerate_triangles = 0;  ///< triangles with a repeated vertex, whose edges do not count
  uint64_t flat_triangles = 0;        ///< of bodies, as are the next two, which count pairs within one part
  uint64_t folded_triangles = 0;      ///< pairs
  uint64_t self_intersections = 0;    ///< pairs
  uint64_t overlaps = 0;              ///< pairs of drawn chunks, one of which contains the other

  bool closed() const { return open_edges + nonmanifold_edges + degenerate_triangles + overlaps == 0; }
  bool valid() const { return closed() && flat_triangles + folded_triangles + self_intersections == 0; }
  friend bool operator==(const FrameReport&, const FrameReport&) = default;
};

struct WholeReport {
  FrameReport frame;  ///< counted anew: a difference to check() means a bug in the checker
  MeshReport mesh;    ///< including the links of all vertices
  /// Pairs of triangles of different parts: folds or cuts between bodies of one level, other parts that pierce each
  /// other.
  uint64_t between_parts = 0;

  bool closed() const { return frame.closed() && mesh.closed(); }
  bool valid() const { return closed() && frame.valid() && between_parts == 0; }
};

/// The drawn chunks of one world. Copies what it needs of their meshes, including seams that are not drawn, so the
/// meshes may be released: about 25 bytes an edge. Edges inside a chunk's body are counted once, since no other chunk
/// can share them; only vertices on the chunk's faces are looked up among all. One thread at a time.
class FrameChecker {
 public:
  FrameChecker() = default;
  FrameChecker(const FrameChecker&) = delete;
  FrameChecker& operator=(const FrameChecker&) = delete;

  /// Draws a chunk, instead of its previous mesh. Error: invalid_argument if the mesh is malformed; then nothing
  /// changes.
  Result<void> draw(const sgm_mesh_view& mesh, const DrawnParts& parts);
  /// Changes the drawn seams of a chunk; its mesh stays. Error: invalid_argument if the chunk is not drawn.
  Result<void> redraw(const sgm_chunk_key& key, const DrawnParts& parts);
  /// False if the chunk is not drawn.
  bool erase(const sgm_chunk_key& key);

  /// The report on the current state. Takes constant time, since each change updates it.
  const FrameReport& check() const { return report_; }
  /// Checks everything from scratch. Takes about 4 us a triangle.
  WholeReport checkWhole() const;

 private:
  static constexpr uint32_t kInside = 1u << 31;  ///< in an id: the number is local to its body
  using Edge = std::pair<uint32_t, uint32_t>;    ///< ids, the lower one first
  struct Hash {
    size_t operator()(const VertexKey& key) const;
    size_t operator()(const Edge& edge) const;
    size_t operator()(const ChunkKey& key) const;
  };
  struct EdgeUse {
    uint32_t forward = 0, backward = 0;
  };
  struct VertexUse {
    uint32_t id = 0, uses = 0;
  };
  struct Counts {
    uint64_t edges = 0, open = 0, nonmanifold = 0;
  };
  /// Faults of a part's triangles by themselves.
  struct TriangleCounts {
    uint64_t degenerate = 0, flat = 0;
    PairCounts pairs;
  };
  struct Part {
    std::vector<VertexPlace> vertices;
    std::vector<uint32_t> indices;  ///< into vertices
    std::vector<uint32_t> ids;      ///< of the vertices, while drawn
    Counts inside;                  ///< of the edges that no other part can share, while drawn
    TriangleCounts triangles;       ///< while drawn
  };
  struct Chunk {
    ChunkGrid grid;
    DrawnParts drawn;
    std::array<Part, 1 + SGM_FACE_COUNT> parts;  ///< the body, then the seams
  };
  struct Place {
    bool drawn = false;
    uint32_t below = 0;  ///< drawn chunks that it contains
  };

  static Result<Chunk> copyOf(const sgm_mesh_view& mesh);
  static SeamOf seamOf(const DrawnParts& drawn, size_t number);
  /// Calls visit(part, its number) for every drawn part.
  template <class ChunkOrConst, class Visit>
  static void forEachDrawn(ChunkOrConst& chunk, const Visit& visit);
  /// For every vertex of a body, the lowest vertex number on the same edge: its own, unless the mesh has duplicates.
  static void numberByEdge(const Part& part, std::vector<uint32_t>& first);
  /// ids: of the part's vertices, equal for identical vertices.
  static TriangleCounts countTriangles(const Part& part, size_t number, std::span<const uint32_t> ids,
                                       PairScratch& scratch);
  uint64_t countBetweenParts() const;
  void show(Chunk& chunk, size_t number);
  void hide(Chunk& chunk, size_t number);
  void useEdge(uint32_t from, uint32_t to, bool more);
  void place(const ChunkKey& key, bool more);

  std::pmr::unsynchronized_pool_resource pool_;
  std::pmr::unordered_map<VertexKey, VertexUse, Hash> vertices_{&pool_};  ///< on faces
  std::pmr::unordered_map<Edge, EdgeUse, Hash> edges_{&pool_};            ///< between vertices on faces
  std::pmr::unordered_map<ChunkKey, Place, Hash> places_{&pool_};         ///< of drawn chunks, and of all chunks that
                                                                          ///< contain them
  std::map<ChunkKey, Chunk> chunks_;
  std::vector<uint32_t> free_ids_;
  uint32_t next_id_ = 0;
  std::vector<uint32_t> first_;   ///< scratch, as inside_
  std::vector<uint64_t> inside_;  ///< edges by numbers in the body, the lower one first; last bit: reversed
  PairScratch pairs_{std::pmr::new_delete_resource()};
  FrameReport report_;
};

}  // namespace sgm::cli
