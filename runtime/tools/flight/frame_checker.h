#pragma once
// Is what a frame draws a closed surface? Told chunk by chunk what changes, so that every frame of a flight can be
// checked. Whether it closes is judged by exact vertex keys, formed from the public interface's meshes alone, never by
// hash; what is wrong with its triangles by places too (mesh/triangle_faults.h).

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

/// What is drawn of a chunk besides its body, and among which neighbours.
struct DrawnParts {
  uint32_t seams = 0;         ///< faces whose seams are drawn, bit (1u << sgm_face)
  Neighbourhood coarser = 0;  ///< blocks around it that belong to coarser chunks, as in sgm_chunk_request; those across
                              ///< the faces in seams count as such in any case
  friend bool operator==(const DrawnParts&, const DrawnParts&) = default;
};

/// The words of an sgm_vertex that say which vertex it is.
struct VertexPlace {
  int16_t x = 0, y = 0, z = 0;
  uint16_t kind = 0;
};

/// The seam that a vertex belongs to.
struct SeamOf {
  Face face = Face::x_lo;
  SeamFans fans{};
};

/// The key of a vertex by the rules of sgm_vertex_kind; seam is null for a vertex of a body. Nothing where no key
/// follows: it lies on no edge, not in the seam's face, or is of a kind that a body does not have.
std::optional<VertexKey> vertexKey(const ChunkGrid& grid, const VertexPlace& vertex, const SeamOf* seam);

struct FrameReport {
  uint64_t chunks = 0, triangles = 0;
  uint64_t edges = 0;                 ///< undirected
  uint64_t open_edges = 0;            ///< used more often in one direction than in the other
  uint64_t nonmanifold_edges = 0;     ///< used twice or more in one direction, as all that three triangles use
  uint64_t degenerate_triangles = 0;  ///< the edges of those with a vertex twice do not count
  uint64_t flat_triangles = 0;        ///< of bodies, as the next two, which each have their pairs for themselves
  uint64_t folded_triangles = 0;      ///< pairs
  uint64_t self_intersections = 0;    ///< pairs
  uint64_t overlaps = 0;              ///< pairs of drawn chunks, one of which lies in the other

  bool closed() const { return open_edges + nonmanifold_edges + degenerate_triangles + overlaps == 0; }
  bool valid() const { return closed() && flat_triangles + folded_triangles + self_intersections == 0; }
  friend bool operator==(const FrameReport&, const FrameReport&) = default;
};

struct WholeReport {
  FrameReport frame;  ///< counted anew: differs from check() only by a fault of the checker's own
  MeshReport mesh;    ///< with the links of all vertices
  /// Pairs of triangles of different parts: of bodies of one level that fold or cut, of others that pierce each other.
  uint64_t between_parts = 0;

  bool closed() const { return frame.closed() && mesh.closed(); }
  bool valid() const { return closed() && frame.valid() && between_parts == 0; }
};

/// The drawn chunks of one world. Keeps what it needs of their meshes, seams that are not drawn included, so that they
/// may end: about 25 bytes an edge. What lies inside a chunk's body no other chunk can share; it is counted once, and
/// only the vertices on the chunk's faces are looked up among all. One thread at a time.
class FrameChecker {
 public:
  FrameChecker() = default;
  FrameChecker(const FrameChecker&) = delete;
  FrameChecker& operator=(const FrameChecker&) = delete;

  /// Draws a chunk, in place of what it drew before. invalid_argument: the mesh is not well formed; then nothing
  /// changes.
  Result<void> draw(const sgm_mesh_view& mesh, const DrawnParts& parts);
  /// Changes what is drawn of a chunk; its mesh stays. invalid_argument: the chunk is not drawn.
  Result<void> redraw(const sgm_chunk_key& key, const DrawnParts& parts);
  /// False where the chunk is not drawn.
  bool erase(const sgm_chunk_key& key);

  /// What is drawn now. Takes no time: changes keep it true.
  const FrameReport& check() const { return report_; }
  /// Checks all that is drawn from the beginning. Some 4 us a triangle.
  WholeReport checkWhole() const;

 private:
  static constexpr uint32_t kInside = 1u << 31;  ///< in an id: the number counts within its own body
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
  /// What is wrong with a part's triangles by themselves.
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
    uint32_t below = 0;  ///< drawn chunks inside
  };

  static Result<Chunk> copyOf(const sgm_mesh_view& mesh);
  static SeamOf seamOf(const DrawnParts& drawn, size_t number);
  /// Calls visit(part, its number) for every part that is drawn.
  template <class ChunkOrConst, class Visit>
  static void forEachDrawn(ChunkOrConst& chunk, const Visit& visit);
  /// For every vertex of a body the lowest number of those on the same edge: its own, unless the mesh has one twice.
  static void numberByEdge(const Part& part, std::vector<uint32_t>& first);
  /// ids: of the part's vertices, equal where they are one.
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
  std::pmr::unordered_map<ChunkKey, Place, Hash> places_{&pool_};         ///< of drawn chunks, and all that hold them
  std::map<ChunkKey, Chunk> chunks_;
  std::vector<uint32_t> free_ids_;
  uint32_t next_id_ = 0;
  std::vector<uint32_t> first_;   ///< scratch, as inside_
  std::vector<uint64_t> inside_;  ///< edges by numbers in the body, the lower one first; last bit: the other way round
  PairScratch pairs_{std::pmr::new_delete_resource()};
  FrameReport report_;
};

}  // namespace sgm::cli
