#pragma once
// The chunks that a world has meshed or plans to mesh. Used only by the planner; not thread-safe.

#include <memory>
#include <optional>
#include <unordered_map>

#include "chunk/chunk_surface.h"
#include "mesh/void_components.h"

namespace sgm {

struct KnownChunk {
  std::shared_ptr<const ChunkSurface> surface;  ///< surface of the chunk; null if it is not meshed yet, or has no
                                                ///< triangles
  std::unique_ptr<const VoidComponents> voids;  ///< void components of a level-0 chunk whose body is meshed; otherwise
                                                ///< null
  bool body = false;                            ///< true if the body is meshed, with or without triangles
  uint8_t seams = 0;                            ///< mask of the meshed seams, with or without triangles
  bool in_work = false;                         ///< true while a request for the chunk is in progress
  /// true if the last request failed; then the chunk is not requested again until an edit changes it
  bool failed = false;
  bool ever_drawn = false;
  uint64_t edited = 0;  ///< number of the last world state (WorldState::number) in which the chunk changed
  uint64_t wanted = 0;  ///< number of the last plan that needed the chunk
  uint64_t queued = 0;  ///< number of the last plan that requested the chunk
  size_t queue_at = 0;  ///< index of the chunk's request in the queue of plan number `queued`

  /// Returns the memory of the chunk in bytes, including its entry in the store.
  size_t bytes() const {
    constexpr size_t kPlace = sizeof(ChunkKey) + 3 * sizeof(void*);
    return kPlace + sizeof *this + (surface != nullptr ? surface->bytes() : 0) +
           (voids != nullptr ? sizeof *voids + voids->capacity() * sizeof(VoidComponent) : 0);
  }
};

class ChunkStore {
 public:
  /// Returns the record of a chunk; null if the chunk is unknown.
  const KnownChunk* find(const ChunkKey& key) const {
    const auto at = records_.find(key);
    return at == records_.end() ? nullptr : &at->second;
  }
  KnownChunk& at(const ChunkKey& key) {
    const auto [record, is_new] = records_.try_emplace(key);
    if (is_new) record->second.edited = edits_;
    return record->second;
  }
  /// Sets the number of the world state that new records get as the chunk's last change (`edited`). A new record cannot
  /// know the chunk's real last change, since an earlier record of the chunk may have been removed.
  void setEdits(uint64_t number) { edits_ = number; }
  size_t size() const { return records_.size(); }

  /// freeUnused() removes records that no plan from number `since` on has needed, least recently needed first, unless a
  /// request for the chunk is in progress. It stops when `bytes` bytes are freed and at most `most` records are left,
  /// or when all such records are removed. It returns how much was removed.
  struct Freed {
    size_t bytes = 0;
    uint64_t never_drawn = 0;  ///< number of removed chunks whose body was meshed but never drawn
  };
  Freed freeUnused(uint64_t since, size_t bytes, size_t most);
  void clear() { records_.clear(); }

  template <class Visit>
  void forEach(const Visit& visit) {
    for (auto& [key, record] : records_) visit(key, record);
  }

 private:
  uint64_t edits_ = 0;
  std::unordered_map<ChunkKey, KnownChunk, ChunkKeyHash> records_;  ///< the records; unordered, so no result may depend
                                                                    ///< on their order
};

}  // namespace sgm
