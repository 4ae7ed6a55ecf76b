#pragma once
// Makes colliders for a physics engine from the drawn parts of chunks, and selects the chunks that need one.

#include <map>
#include <memory>
#include <memory_resource>
#include <span>
#include <vector>

#include "stream/plan/drawn_frame.h"
#include "stream/plan/viewer_index.h"

namespace sgm {

/// A triangle mesh for collisions: a chunk's body and its drawn seams, with shared vertices. Immutable.
struct Collider {
  ChunkKey key;
  ChunkGrid grid;
  std::pmr::vector<float> positions;     ///< three per vertex, in metres, relative to the origin of the chunk
  std::pmr::vector<uint32_t> indices;    ///< three per triangle; triangles without area are omitted
  std::pmr::vector<uint16_t> materials;  ///< one per triangle: the material of its first vertex
  uint64_t hash = 0;                     ///< hash of the three arrays: equal colliders of a chunk have equal hashes

  explicit Collider(std::pmr::memory_resource* memory) : positions(memory), indices(memory), materials(memory) {}
  size_t bytes() const {
    return sizeof *this + positions.capacity() * sizeof(float) + indices.capacity() * sizeof(uint32_t) +
           materials.capacity() * sizeof(uint16_t);
  }
};

/// Makes a collider from the body and seams of a chunk. seams: bit (1 << Face); the surface must have these seams.
/// Throws std::bad_alloc.
Collider colliderOf(const ChunkSurface& surface, uint8_t seams, std::pmr::memory_resource* memory);

struct ColliderChange {
  ChunkKey key;
  std::shared_ptr<const Collider> collider;  ///< the new collider; null: the chunk no longer has one
};

/// Keeps colliders for the drawn chunks within a distance of a viewer, at whatever level they are drawn. Not
/// thread-safe.
class Colliders {
 public:
  /// distance: maximum distance from a viewer in units; 0: no chunk has a collider.
  explicit Colliders(double distance) : distance_(distance) {}

  /// Appends the next changes of colliders to `changes`, with at most `most` new colliders, nearest first. Returns true
  /// if there are no further changes. A new collider that equals the old one is not a change. A chunk keeps its
  /// collider up to 1.25 times the collider distance from a viewer; a chunk that is no longer drawn keeps its collider
  /// until all chunks that replace it have colliders. If this function throws std::bad_alloc, nothing is changed.
  bool update(const DrawnFrame& frame, const ViewerIndex& viewers, size_t most, std::pmr::memory_resource* memory,
              std::vector<ColliderChange>& changes);

  size_t bytes() const { return bytes_; }  ///< total size of the current colliders in bytes

 private:
  struct Given {
    uint64_t parts = 0;  ///< hash of the chunk's drawn parts
    uint64_t hash = 0;   ///< hash of the resulting collider
    size_t bytes = 0;
  };

  double distance_;
  std::map<ChunkKey, Given> given_;
  size_t bytes_ = 0;
};

}  // namespace sgm
