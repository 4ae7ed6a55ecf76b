#pragma once
// Which surfaces of a world its engine has.

#include <memory>
#include <unordered_map>

#include "stream/plan/planner.h"

namespace sgm {

/// The surfaces that were passed to the engine and not removed since, by chunk. Not thread-safe.
class HandedSurfaces {
 public:
  void add(const DrawnChunk& chunk) { surfaces_[chunk.key] = chunk.surface; }
  /// False if the engine has no surface of the chunk.
  bool remove(const ChunkKey& key) { return surfaces_.erase(key) > 0; }

  /// True if the engine has the chunk's current surface.
  bool has(const DrawnChunk& chunk) const {
    const auto handed = surfaces_.find(chunk.key);
    return handed != surfaces_.end() && handed->second == chunk.surface;
  }

  /// Returns the total size of the step's surfaces that were not passed to the engine yet.
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
