#pragma once
// Checks whether the surface drawn in a frame is closed. The checker processes changes chunk by chunk, so it can check
// every frame of a flight. It compares exact vertex keys, formed only from the public interface's meshes, and never
// hashes; for faults of triangles it also uses positions (mesh/triangle_faults.h).

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
  uint32_t seams = 0;  ///< faces whose seams are drawn: bits (1u << sgm_face)
  /// Neighbouring blocks that belong to coarser chunks, as in sgm_chunk_request; blocks across the faces in `seams`
  /// always count as coarser.
  Neighbourhood coarser = 0;
  friend bool operator==(const DrawnParts&, const DrawnParts&) = default;
};

/// The members of an sgm_vertex that identify the vertex.
struct VertexPlace {
  int16_t x = 0, y = 0, z = 0;
  uint16_t kind = 0;
};

/// The seam to which a vertex belongs.
struct SeamOf {
  Face face = Face::x_lo;
  SeamFans fans{};
};

/// The key of a vertex by the rules of sgm_vertex_kind; seam is null for a vertex of a body. Returns nullopt if the
/// vertex is invalid: it does not lie on an edge of the grid, not in the seam's face, or its kind does not occur in
/// bodies.
std::optional<VertexKey> vertexKey(const ChunkGrid& grid, const VertexPlace& vertex, const SeamOf* seam);

struct FrameReport {
  uint64_t chunks = 0, triangles = 0;
  uint64_t edges = 0;       ///< number of undirected edges
  uint64_t open_edges = 0;  ///< edges that triangles use more often in one direction than in the other
  /// Edges that triangles use at least twice in one direction; this includes every edge of three triangles.
  uint64_t nonmanifold_edges = 0;
  uint64_t degenerate_triangles = 0;  ///< triangles with a repeated vertex, whose edges do not count
  /// Triangles of bodies without area; this and the next two members count within one part only.
  uint64_t flat_triangles = 0;
  uint64_t folded_triangles = 0;    ///< pairs of triangles of one body that share an edge and lie on each other
  uint64_t self_intersections = 0;  ///< pairs of triangles of one body that cut each other
  uint64_t overlaps = 0;            ///< pairs of drawn chunks, one of which contains the other

  bool closed() const { return open_edges + nonmanifold_edges + degenerate_triangles + overlaps == 0; }
  bool valid() const { return closed() && flat_triangles + folded_triangles + self_intersections == 0; }
  friend bool operator==(const FrameReport&, const FrameReport&) = default;
};

struct WholeReport {
  FrameReport frame;  ///< recounted from scratch: a difference from check() means a bug in the checker
  MeshReport mesh;    ///< report of the joined mesh, including the links of all vertices
  /// Pairs of triangles of different parts that fold over or cut each other: bodies of the same level, or other parts
  /// that pierce each other.
  uint64_t between_parts = 0;

  bool closed() const { return frame.closed() && mesh.closed(); }
  bool valid() const { return closed() && frame.valid() && between_parts == 0; }
};

/// The drawn chunks of one world. Copies the needed data of their meshes, including seams that are not drawn, so that
/// the meshes may be released: about 25 bytes an edge. Edges inside a chunk's body are counted once, since no other
/// chunk can share them; only vertices on the chunk's faces are looked up in a common table. Not thread-safe.
class FrameChecker {
 public:
  FrameChecker() = default;
  FrameChecker(const FrameChecker&) = delete;
  FrameChecker& operator=(const FrameChecker&) = delete;

  /// Adds a drawn chunk, or replaces its previous mesh. Error: invalid_argument if the mesh is malformed; the checker
  /// is then unchanged.
  Result<void> draw(const sgm_mesh_view& mesh, const DrawnParts& parts);
  /// Changes which seams of a chunk are drawn; its mesh stays. Error: invalid_argument if the chunk is not drawn.
  Result<void> redraw(const sgm_chunk_key& key, const DrawnParts& parts);
  /// Removes a drawn chunk. Returns false if the chunk is not drawn.
  bool erase(const sgm_chunk_key& key);

  /// The report on the current state. Takes constant time, since each change updates the report.
  const FrameReport& check() const { return report_; }
  /// Checks the whole surface from scratch. Takes about 4 us a triangle.
  WholeReport checkWhole() const;

 private:
  /// Bit of a vertex id: the vertex lies inside its body, and the id is unique only within the body.
  static constexpr uint32_t kInside = 1u << 31;
  using Edge = std::pair<uint32_t, uint32_t>;  ///< ids of both vertices, the lower one first
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
  /// Numbers of faults within the triangles of one part.
  struct TriangleCounts {
    uint64_t degenerate = 0, flat = 0;
    PairCounts pairs;
  };
  struct Part {
    std::vector<VertexPlace> vertices;
    std::vector<uint32_t> indices;  ///< into vertices
    std::vector<uint32_t> ids;      ///< for each vertex its id in this checker; empty while the part is not drawn
    Counts inside;             ///< counts of the edges that no other part can share; all 0 while the part is not drawn
    TriangleCounts triangles;  ///< faults of the triangles; all 0 while the part is not drawn
  };
  struct Chunk {
    ChunkGrid grid;
    DrawnParts drawn;
    std::array<Part, 1 + SGM_FACE_COUNT> parts;  ///< the body, then the seams in the order of sgm_face
  };
  struct Place {
    bool drawn = false;
    uint32_t below = 0;  ///< number of drawn chunks that this chunk's cube contains
  };

  static Result<Chunk> copyOf(const sgm_mesh_view& mesh);
  static SeamOf seamOf(const DrawnParts& drawn, size_t number);
  /// Calls visit(part, number) for every drawn part of a chunk; number is the part's index in Chunk::parts.
  template <class ChunkOrConst, class Visit>
  static void forEachDrawn(ChunkOrConst& chunk, const Visit& visit);
  /// For every vertex of a body, sets the lowest index of a vertex with the same key: the vertex's own index, unless
  /// the mesh has duplicates.
  static void numberByEdge(const Part& part, std::vector<uint32_t>& first);
  /// Counts a part's faults. ids: an id for each vertex, equal for identical vertices.
  static TriangleCounts countTriangles(const Part& part, size_t number, std::span<const uint32_t> ids,
                                       PairScratch& scratch);
  uint64_t countBetweenParts() const;
  void show(Chunk& chunk, size_t number);
  void hide(Chunk& chunk, size_t number);
  void useEdge(uint32_t from, uint32_t to, bool more);
  void place(const ChunkKey& key, bool more);

  std::pmr::unsynchronized_pool_resource pool_;
  std::pmr::unordered_map<VertexKey, VertexUse, Hash> vertices_{&pool_};  ///< the vertices on faces of chunks
  std::pmr::unordered_map<Edge, EdgeUse, Hash> edges_{&pool_};  ///< the edges between vertices on faces of chunks
  /// The drawn chunks, and all coarser chunks that contain a drawn one.
  std::pmr::unordered_map<ChunkKey, Place, Hash> places_{&pool_};
  std::map<ChunkKey, Chunk> chunks_;
  std::vector<uint32_t> free_ids_;
  uint32_t next_id_ = 0;
  std::vector<uint32_t> first_;  ///< scratch memory, used within one call
  /// Scratch memory: edges inside a body, as both vertex numbers, the lower one first; the last bit is set if the edge
  /// was reversed.
  std::vector<uint64_t> inside_;
  PairScratch pairs_{std::pmr::new_delete_resource()};
  FrameReport report_;
};

}  // namespace sgm::cli
