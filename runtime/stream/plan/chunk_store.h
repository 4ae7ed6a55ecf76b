#pragma once
// The chunks that a world has meshed, or is about to. One thread at a time: the planner's.

#include <memory>
#include <optional>
#include <unordered_map>

#include "chunk/chunk_surface.h"
#include "mesh/void_components.h"

namespace sgm {

struct KnownChunk {
  std::shared_ptr<const ChunkSurface> surface;  ///< null where nothing is there yet, or it has no triangles
  std::unique_ptr<const VoidComponents> voids;  ///< of a level-0 chunk whose body is there; else null
  bool body = false;                            ///< meshed, triangles or not
  uint8_t seams = 0;                            ///< that are made, triangles or not
  bool in_work = false;                         ///< a request for it has been handed out and not come back
  bool failed = false;                          ///< its last request; it is not asked for again, until edits change it
  bool ever_drawn = false;
  uint64_t edited = 0;  ///< the last state (WorldState::number) that changed it
  uint64_t wanted = 0;  ///< the last plan that had a use for it
  uint64_t queued = 0;  ///< the last plan that asked for it
  size_t queue_at = 0;  ///< where in that plan's list

  /// Of all that is known of the chunk, its place in the store included.
  size_t bytes() const {
    constexpr size_t kPlace = sizeof(ChunkKey) + 3 * sizeof(void*);
    return kPlace + sizeof *this + (surface != nullptr ? surface->bytes() : 0) +
           (voids != nullptr ? sizeof *voids + voids->capacity() * sizeof(VoidComponent) : 0);
  }
};

class ChunkStore {
 public:
  /// Null where there is none.
  const KnownChunk* find(const ChunkKey& key) const {
    const auto at = records_.find(key);
    return at == records_.end() ? nullptr : &at->second;
  }
  KnownChunk& at(const ChunkKey& key) {
    const auto [record, is_new] = records_.try_emplace(key);
    if (is_new) record->second.edited = edits_;
    return record->second;
  }
  /// Chunks that become known from now on count as edited in the state of this number: what was known of them before
  /// is forgotten.
  void setEdits(uint64_t number) { edits_ = number; }
  size_t size() const { return records_.size(); }

  /// Forgets records that no plan since `since` had a use for, those unused longest first, until `bytes` are freed and
  /// no more than `most` are left, or all of them are forgotten. Returns what it took away.
  struct Freed {
    size_t bytes = 0;
    uint64_t never_drawn = 0;  ///< chunks with a body that were meshed in vain
  };
  Freed freeUnused(uint64_t since, size_t bytes, size_t most);
  void clear() { records_.clear(); }

  template <class Visit>
  void forEach(const Visit& visit) {
    for (auto& [key, record] : records_) visit(key, record);
  }

 private:
  uint64_t edits_ = 0;
  std::unordered_map<ChunkKey, KnownChunk, ChunkKeyHash> records_;  ///< order is never seen outside
};

}  // namespace sgm
