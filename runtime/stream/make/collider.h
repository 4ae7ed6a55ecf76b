#pragma once
// Colliders for a physics engine, made of a chunk's drawn parts, and the choice of chunks that have one.

#include <map>
#include <memory>
#include <memory_resource>
#include <span>
#include <vector>

#include "stream/plan/drawn_frame.h"
#include "stream/plan/viewer_index.h"

namespace sgm {

/// Triangles of a body and its drawn seams, with shared vertices. Immutable.
struct Collider {
  ChunkKey key;
  ChunkGrid grid;
  std::pmr::vector<float> positions;     ///< three a vertex, metres from the grid's origin
  std::pmr::vector<uint32_t> indices;    ///< three a triangle; no degenerate triangles
  std::pmr::vector<uint16_t> materials;  ///< one a triangle: the material of its first vertex
  uint64_t hash = 0;                     ///< of these three: equal colliders of a chunk have equal hashes

  explicit Collider(std::pmr::memory_resource* memory) : positions(memory), indices(memory), materials(memory) {}
  size_t bytes() const {
    return sizeof *this + positions.capacity() * sizeof(float) + indices.capacity() * sizeof(uint32_t) +
           materials.capacity() * sizeof(uint16_t);
  }
};

/// seams: bit (1 << Face); the surface must have them. Throws std::bad_alloc.
Collider colliderOf(const ChunkSurface& surface, uint8_t seams, std::pmr::memory_resource* memory);

struct ColliderChange {
  ChunkKey key;
  std::shared_ptr<const Collider> collider;  ///< null: the chunk has no collider any more
};

/// Chooses the drawn chunks with a collider: those within a distance of a viewer, of any level. One thread at a time.
class Colliders {
 public:
  /// distance: units; 0: no chunk has one.
  explicit Colliders(double distance) : distance_(distance) {}

  /// Appends the next changes, with at most `most` new colliders, nearest first. Returns true if no further changes are
  /// left. A chunk whose collider would be equal keeps it without a change. Chunks keep their collider until they are a
  /// quarter of the distance farther away; chunks that are no longer drawn keep it until all their replacements have
  /// one. Throws std::bad_alloc, and nothing has changed.
  bool update(const DrawnFrame& frame, const ViewerIndex& viewers, size_t most, std::pmr::memory_resource* memory,
              std::vector<ColliderChange>& changes);

  size_t bytes() const { return bytes_; }  ///< of the chunks' current colliders

 private:
  struct Given {
    uint64_t parts = 0;  ///< combined hash of the drawn parts
    uint64_t hash = 0;   ///< the collider's
    size_t bytes = 0;
  };

  double distance_;
  std::map<ChunkKey, Given> given_;
  size_t bytes_ = 0;
};

}  // namespace sgm
