#pragma once
// What a chunk's drawn parts come to for a physics engine, and which chunks have it.

#include <map>
#include <memory>
#include <memory_resource>
#include <span>
#include <vector>

#include "stream/plan/drawn_frame.h"
#include "stream/plan/viewer_index.h"

namespace sgm {

/// Triangles of a body and the seams that are drawn with it, each vertex once. Immutable.
struct Collider {
  ChunkKey key;
  ChunkGrid grid;
  std::pmr::vector<float> positions;     ///< three a vertex, metres from the grid's origin
  std::pmr::vector<uint32_t> indices;    ///< three a triangle; none without area
  std::pmr::vector<uint16_t> materials;  ///< one a triangle: that of its first vertex
  uint64_t hash = 0;                     ///< of these three: equal colliders of a chunk have equal ones

  explicit Collider(std::pmr::memory_resource* memory) : positions(memory), indices(memory), materials(memory) {}
  size_t bytes() const {
    return sizeof *this + positions.capacity() * sizeof(float) + indices.capacity() * sizeof(uint32_t) +
           materials.capacity() * sizeof(uint16_t);
  }
};

/// seams: bit (1 << Face), of those that the surface has. Throws std::bad_alloc.
Collider colliderOf(const ChunkSurface& surface, uint8_t seams, std::pmr::memory_resource* memory);

struct ColliderChange {
  ChunkKey key;
  std::shared_ptr<const Collider> collider;  ///< null: the chunk has none any more
};

/// Which drawn chunks have a collider: those within a distance of a viewer, whatever their level, as they are drawn.
/// One thread at a time.
class Colliders {
 public:
  /// distance: units; 0: no chunk has one.
  explicit Colliders(double distance) : distance_(distance) {}

  /// The next changes, at most `most` new colliders among them, the nearest first; true where none are left after them.
  /// A chunk whose collider would be the same keeps it without a change. Chunks keep theirs until they are a quarter of
  /// the distance farther away; those that are drawn no more, until all that is drawn in their place has one. Throws
  /// std::bad_alloc, and nothing has happened.
  bool update(const DrawnFrame& frame, const ViewerIndex& viewers, size_t most, std::pmr::memory_resource* memory,
              std::vector<ColliderChange>& changes);

  size_t bytes() const { return bytes_; }  ///< of those that chunks have

 private:
  struct Given {
    uint64_t parts = 0;  ///< a hash of the hashes of what was drawn
    uint64_t hash = 0;   ///< the collider's
    size_t bytes = 0;
  };

  double distance_;
  std::map<ChunkKey, Given> given_;
  size_t bytes_ = 0;
};

}  // namespace sgm
