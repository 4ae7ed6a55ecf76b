#include "stream/plan/chunk_store.h"

#include <algorithm>
#include <vector>

namespace sgm {

ChunkStore::Freed ChunkStore::freeUnused(uint64_t since, size_t bytes, size_t most) {
  std::vector<std::pair<uint64_t, ChunkKey>> unused;
  for (const auto& [key, record] : records_) {
    if (record.wanted < since && !record.in_work) unused.push_back({record.wanted, key});
  }
  std::sort(unused.begin(), unused.end());
  Freed freed;
  for (const auto& [wanted, key] : unused) {
    if (freed.bytes >= bytes && records_.size() <= most) break;
    const auto at = records_.find(key);
    freed.bytes += at->second.bytes();
    if (at->second.body && !at->second.ever_drawn) ++freed.never_drawn;
    records_.erase(at);
  }
  return freed;
}

}  // namespace sgm
