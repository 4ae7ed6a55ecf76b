#pragma once
// The chunks that a world has meshed or is about to mesh. Used only by the planner, one thread at a time.

#include <memory>
#include <optional>
#include <unordered_map>

#include "chunk/chunk_surface.h"
#include "mesh/void_components.h"

namespace sgm {

struct KnownChunk {
  std::shared_ptr<const ChunkSurface> surface;  ///< null if not meshed yet, or without triangles
  std::unique_ptr<const VoidComponents> voids;  ///< of a level-0 chunk with a body; else null
  bool body = false;                            ///< meshed, triangles or not
  uint8_t seams = 0;                            ///< made seams, with or without triangles
  bool in_work = false;                         ///< a request for it is handed out and has not come back
  bool failed = false;                          ///< the last request failed; not requested again until edits change the
                                                ///< chunk
  bool ever_drawn = false;
  uint64_t edited = 0;  ///< the last state (WorldState::number) that changed it
  uint64_t wanted = 0;  ///< the last plan that used it
  uint64_t queued = 0;  ///< the last plan that requested it
  size_t queue_at = 0;  ///< index in that plan's queue

  /// The chunk's memory, including its entry in the store.
  size_t bytes() const {
    constexpr size_t kPlace = sizeof(ChunkKey) + 3 * sizeof(void*);
    return kPlace + sizeof *this + (surface != nullptr ? surface->bytes() : 0) +
           (voids != nullptr ? sizeof *voids + voids->capacity() * sizeof(VoidComponent) : 0);
  }
};

class ChunkStore {
 public:
  /// Null if the chunk is unknown.
  const KnownChunk* find(const ChunkKey& key) const {
    const auto at = records_.find(key);
    return at == records_.end() ? nullptr : &at->second;
  }
  KnownChunk& at(const ChunkKey& key) {
    const auto [record, is_new] = records_.try_emplace(key);
    if (is_new) record->second.edited = edits_;
    return record->second;
  }
  /// New records count as edited in the state of this number: their earlier content is forgotten.
  void setEdits(uint64_t number) { edits_ = number; }
  size_t size() const { return records_.size(); }

  /// Removes records that no plan since `since` has used, longest unused first, until `bytes` are freed and at most
  /// `most` records are left, or no such record is left. Returns the removed amounts.
  struct Freed {
    size_t bytes = 0;
    uint64_t never_drawn = 0;  ///< chunks with a body that was never drawn
  };
  Freed freeUnused(uint64_t since, size_t bytes, size_t most);
  void clear() { records_.clear(); }

  template <class Visit>
  void forEach(const Visit& visit) {
    for (auto& [key, record] : records_) visit(key, record);
  }

 private:
  uint64_t edits_ = 0;
  std::unordered_map<ChunkKey, KnownChunk, ChunkKeyHash> records_;  ///< no result may depend on the order
};

}  // namespace sgm
