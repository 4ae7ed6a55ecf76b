#include "world/cell_cache.h"

#include <algorithm>

namespace sgm {

namespace {

/// If the cache uses more than 1 / kIdleShare of its limit, it also evicts cells that were not used during the last
/// kIdle insertions. So its memory does not grow up to the limit while a viewer crosses new ground.
constexpr size_t kIdleShare = 4;
constexpr uint64_t kIdle = 1024;

size_t bytesOf(const GrammarChunk& c) {
  // estimated bytes of the map entry, the reference count and the heap's overhead
  constexpr size_t kBookkeeping = 256;
  constexpr size_t kIndexed = 64;  // estimated bytes in the index for each group of shapes
  const auto of = [](const auto& values) { return values.capacity() * sizeof(values[0]); };
  return kBookkeeping + sizeof(DerivedCell) + of(c.shapes) + of(c.children) + of(c.exprs) + of(c.noises) +
         of(c.points) + of(c.blocks) + of(c.voxels) + of(c.groups) + c.groups.size() * kIndexed + of(c.anchors);
}

}  // namespace

DerivedCell::DerivedCell(GrammarChunk&& c, std::pmr::memory_resource* memory)
    : chunk(std::move(c)), index(chunk, memory), bytes(bytesOf(chunk)) {}

std::shared_ptr<const DerivedCell> CellCache::use(Entry& entry) {
  const uint64_t now = clock_.load(std::memory_order_relaxed);
  if (entry.used.load(std::memory_order_relaxed) != now) entry.used.store(now, std::memory_order_relaxed);
  return entry.cell;
}

void CellCache::find(std::span<const CellKey> keys, std::vector<std::shared_ptr<const DerivedCell>>& found) {
  found.assign(keys.size(), nullptr);
  uint64_t hits = 0;
  const std::shared_lock lock(mutex_);
  for (size_t i = 0; i < keys.size(); ++i) {
    const auto entry = entries_.find(keys[i]);
    if (entry == entries_.end() || !entry->second.cell) continue;
    found[i] = use(entry->second);
    ++hits;
  }
  hits_.fetch_add(hits, std::memory_order_relaxed);
}

Result<std::shared_ptr<const DerivedCell>> CellCache::get(const CellKey& key, const Derive& derive) {
  {
    const std::shared_lock lock(mutex_);
    const auto found = entries_.find(key);
    if (found != entries_.end() && found->second.cell) {
      hits_.fetch_add(1, std::memory_order_relaxed);
      return use(found->second);
    }
  }
  {
    std::unique_lock lock(mutex_);
    for (;;) {
      const auto found = entries_.find(key);
      if (found == entries_.end()) break;
      if (found->second.cell) {
        hits_.fetch_add(1, std::memory_order_relaxed);
        return use(found->second);
      }
      // Another thread is deriving this cell. Waiting for it cannot lead to a deadlock: a layer's derivation requests
      // only cells of lower layers, so the other thread never waits for a cell that the waiting thread is deriving.
      derived_.wait(lock);
    }
    ++stats_.misses;
    entries_.try_emplace(key);
  }

  auto forget = [&] {
    std::lock_guard lock(mutex_);
    entries_.erase(key);
    derived_.notify_all();
  };
  try {
    Result<GrammarChunk> chunk = derive();
    if (!chunk) {
      forget();
      return chunk.error();
    }
    auto cell = std::make_shared<const DerivedCell>(std::move(*chunk), memory_);
    std::lock_guard lock(mutex_);
    // Make room before the new cell is inserted. If all other cells got a second chance afterwards, the new cell itself
    // could be evicted. The cell is inserted however large it is, since the caller holds it in memory anyway.
    makeRoom(cell->bytes);
    by_use_.push_front(key);
    Entry& entry = entries_[key];
    entry.cell = cell;
    entry.listed = by_use_.begin();
    entry.used = entry.listed_as = ++clock_;
    stats_.bytes += cell->bytes;
    ++stats_.cells;
    derived_.notify_all();
    return std::shared_ptr<const DerivedCell>(cell);
  } catch (...) {
    forget();
    throw;
  }
}

void CellCache::adopt(const CellCache& other, const std::function<bool(const DerivedCell&)>& take) {
  struct Taken {
    uint64_t used;
    CellKey key;
    std::shared_ptr<const DerivedCell> cell;
  };
  std::vector<Taken> taken;
  {
    const std::lock_guard lock(other.mutex_);
    for (const CellKey& key : other.by_use_) {
      const Entry& entry = other.entries_.at(key);
      if (take(*entry.cell)) taken.push_back({entry.used, key, entry.cell});
    }
  }
  std::stable_sort(taken.begin(), taken.end(), [](const Taken& a, const Taken& b) { return a.used > b.used; });
  const std::lock_guard lock(mutex_);
  for (const auto& [used, key, cell] : taken) {
    if (stats_.bytes + cell->bytes > byte_limit_) break;
    if (entries_.count(key) != 0) continue;
    // Inserts the cell completely or not at all, because threads would wait forever for an entry without a cell. The
    // entry's time of use is 0, before the uses of all other entries.
    by_use_.push_back(key);
    try {
      Entry& entry = entries_.try_emplace(key).first->second;
      entry.cell = cell;
      entry.listed = std::prev(by_use_.end());
    } catch (...) {
      by_use_.pop_back();
      throw;
    }
    stats_.bytes += cell->bytes;
    ++stats_.cells;
  }
}

void CellCache::makeRoom(size_t bytes) {
  const uint64_t now = clock_;
  const auto isIdle = [now](uint64_t since) { return now - since > kIdle; };
  while (!by_use_.empty() && stats_.bytes + bytes > byte_limit_ / kIdleShare) {
    const auto last = entries_.find(by_use_.back());
    Entry& entry = last->second;
    const bool is_full = stats_.bytes + bytes > byte_limit_;
    if (!is_full && !isIdle(entry.listed_as)) return;
    if (entry.used != entry.listed_as && !isIdle(entry.used)) {
      // Second chance: the entry was used since it was put into the list or last moved to the front, so it moves to the
      // front.
      entry.listed_as = entry.used;
      by_use_.splice(by_use_.begin(), by_use_, entry.listed);
      continue;
    }
    stats_.bytes -= entry.cell->bytes;
    --stats_.cells;
    ++stats_.evicted;
    by_use_.pop_back();
    entries_.erase(last);
  }
}

CellCacheStats CellCache::stats() const {
  const std::shared_lock lock(mutex_);
  CellCacheStats stats = stats_;
  stats.hits = hits_;
  return stats;
}

}  // namespace sgm
