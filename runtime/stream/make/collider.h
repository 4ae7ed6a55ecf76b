#pragma once
// Colliders for a physics engine, made from the drawn parts of chunks; and the selection of chunks that have one.

#include <map>
#include <memory>
#include <memory_resource>
#include <span>
#include <vector>

#include "stream/plan/drawn_frame.h"
#include "stream/plan/viewer_index.h"

namespace sgm {

/// The triangles of a chunk's body and its drawn seams, with shared vertices. Immutable.
struct Collider {
  ChunkKey key;
  ChunkGrid grid;
  std::pmr::vector<float> positions;     ///< three per vertex, in metres from the grid's origin
  std::pmr::vector<uint32_t> indices;    ///< three per triangle; without degenerate triangles
  std::pmr::vector<uint16_t> materials;  ///< one per triangle: the material of its first vertex
  uint64_t hash = 0;                     ///< hash of the three arrays: equal colliders of a chunk have equal hashes

  explicit Collider(std::pmr::memory_resource* memory) : positions(memory), indices(memory), materials(memory) {}
  size_t bytes() const {
    return sizeof *this + positions.capacity() * sizeof(float) + indices.capacity() * sizeof(uint32_t) +
           materials.capacity() * sizeof(uint16_t);
  }
};

/// Makes a collider. seams: the seams to include, bit (1 << Face); the surface must have them. Throws std::bad_alloc.
Collider colliderOf(const ChunkSurface& surface, uint8_t seams, std::pmr::memory_resource* memory);

struct ColliderChange {
  ChunkKey key;
  std::shared_ptr<const Collider> collider;  ///< null: the chunk no longer has a collider
};

/// Selects the drawn chunks that have a collider: those within a distance of a viewer, of any level. Not thread-safe.
class Colliders {
 public:
  /// distance: from a viewer, in units; 0: no chunk has a collider.
  explicit Colliders(double distance) : distance_(distance) {}

  /// Appends the next changes of colliders, with at most `most` new ones, nearest first. Returns true if no further
  /// changes are left. If a new collider would equal the old one, there is no change. Chunks keep their collider until
  /// they are a quarter of the distance farther away; chunks that are no longer drawn keep it until all of their
  /// replacements have one. Throws std::bad_alloc without having changed anything.
  bool update(const DrawnFrame& frame, const ViewerIndex& viewers, size_t most, std::pmr::memory_resource* memory,
              std::vector<ColliderChange>& changes);

  size_t bytes() const { return bytes_; }  ///< total size of the current colliders

 private:
  struct Given {
    uint64_t parts = 0;  ///< combined hash of the chunk's drawn parts
    uint64_t hash = 0;   ///< hash of the collider
    size_t bytes = 0;
  };

  double distance_;
  std::map<ChunkKey, Given> given_;
  size_t bytes_ = 0;
};

}  // namespace sgm
