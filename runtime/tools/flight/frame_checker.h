#pragma once
// Checks whether the surface drawn in a frame is closed. The checker is updated chunk by chunk, so that it can check
// every frame of a flight. It identifies vertices by exact keys, computed only from the meshes of the public interface,
// and never by hashes; to find faulty triangles it also uses positions (mesh/triangle_faults.h).

#include <sgm/sgm.h>

#include <cstdint>
#include <memory_resource>
#include <unordered_map>
#include <utility>
#include <vector>

#include "base/result.h"
#include "tools/flight/checked_chunk.h"
#include "tools/flight/frame_report.h"
#include "tools/flight/whole_check.h"

namespace sgm::cli {

/// The drawn chunks of one world. Copies the necessary parts of their meshes, including seams that are not drawn (about
/// 25 bytes per edge), so the meshes may be released. Edges inside a chunk's body are counted only once, since no other
/// chunk can share them; only vertices on the chunk's faces are looked up among all chunks. Not thread-safe.
class FrameChecker {
 public:
  FrameChecker() = default;
  FrameChecker(const FrameChecker&) = delete;
  FrameChecker& operator=(const FrameChecker&) = delete;

  /// Adds a drawn chunk, or replaces its previous mesh. Error: invalid_argument if the mesh is malformed; the checker
  /// is then unchanged.
  Result<void> draw(const sgm_mesh_view& mesh, const DrawnParts& parts);
  /// Changes which seams of a drawn chunk are drawn; its mesh stays the same. Error: invalid_argument if the chunk is
  /// not drawn.
  Result<void> redraw(const sgm_chunk_key& key, const DrawnParts& parts);
  /// Removes a drawn chunk. Returns false if the chunk is not drawn.
  bool erase(const sgm_chunk_key& key);

  /// The report on the currently drawn chunks. Takes constant time, since each change updates the report.
  const FrameReport& check() const { return report_; }
  /// Checks all drawn chunks from scratch (whole_check.h), independently of check().
  WholeReport checkWhole() const { return checkAll(chunks_); }

 private:
  static constexpr uint32_t kInside = 1u << 31;  ///< flag in a vertex id: the id is unique only within its body
  using Edge = std::pair<uint32_t, uint32_t>;    ///< two vertex ids, the lower id first
  struct Hash : VertexKeyHash {
    using VertexKeyHash::operator();
    size_t operator()(const Edge& edge) const;
    size_t operator()(const ChunkKey& key) const;
  };
  struct EdgeUse {
    uint32_t forward = 0, backward = 0;
  };
  struct VertexUse {
    uint32_t id = 0, uses = 0;
  };
  struct Place {
    bool drawn = false;
    uint32_t below = 0;  ///< number of drawn finer chunks inside the cube of this chunk
  };

  void show(CheckedChunk& chunk, size_t number);
  void hide(CheckedChunk& chunk, size_t number);
  void useEdge(uint32_t from, uint32_t to, bool more);
  void place(const ChunkKey& key, bool more);

  std::pmr::unsynchronized_pool_resource pool_;
  std::pmr::unordered_map<VertexKey, VertexUse, Hash> vertices_{&pool_};  ///< vertices on chunk faces
  std::pmr::unordered_map<Edge, EdgeUse, Hash> edges_{&pool_};            ///< edges between two vertices on chunk faces
  /// Drawn chunks, and all chunks that contain a drawn chunk.
  std::pmr::unordered_map<ChunkKey, Place, Hash> places_{&pool_};
  CheckedChunks chunks_;
  std::vector<uint32_t> free_ids_;
  uint32_t next_id_ = 0;
  std::vector<uint32_t> first_;  ///< scratch memory, used within one call
  /// Scratch memory: uses of edges inside a body. Each value packs both vertex numbers of an edge, the lower first; its
  /// last bit is set if a triangle uses the edge in the reverse direction.
  std::vector<uint64_t> inside_;
  PairScratch pairs_{std::pmr::new_delete_resource()};
  FrameReport report_;
};

}  // namespace sgm::cli
