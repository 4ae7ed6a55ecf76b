#pragma once
// Keeps track of the surfaces that the engine has received.

#include <memory>
#include <unordered_map>

#include "stream/plan/planner.h"

namespace sgm {

/// For each chunk, the surface that was delivered to the engine and not removed since. Not thread-safe.
class HandedSurfaces {
 public:
  void add(const DrawnChunk& chunk) { surfaces_[chunk.key] = chunk.surface; }
  /// Removes the surface of a chunk. Returns false if the engine has none.
  bool remove(const ChunkKey& key) { return surfaces_.erase(key) > 0; }

  /// True if the engine already has the surface of this drawn chunk.
  bool has(const DrawnChunk& chunk) const {
    const auto handed = surfaces_.find(chunk.key);
    return handed != surfaces_.end() && handed->second == chunk.surface;
  }

  /// Returns the total size in bytes of the step's surfaces that the engine does not have yet.
  size_t bytesLeft(const FrameStep& step) const {
    size_t bytes = 0;
    for (const FrameChange& change : step.changes) {
      if (change.chunk.surface != nullptr && !has(change.chunk)) bytes += change.chunk.surface->mesh.bytes();
    }
    return bytes;
  }

 private:
  std::unordered_map<ChunkKey, std::shared_ptr<const ChunkSurface>, ChunkKeyHash> surfaces_;
};

}  // namespace sgm
