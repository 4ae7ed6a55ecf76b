#include "stream/cell_cache.h"

namespace sgm {

namespace {

size_t bytesOf(const GrammarChunk& c) {
  return sizeof(DerivedCell) + c.shapes.size() * sizeof(Shape) + c.children.size() * sizeof(uint32_t) +
         c.exprs.size() * sizeof(Expr) + c.noises.size() * sizeof(NoiseSpec) + c.points.size() * sizeof(Int3) +
         c.blocks.size() * sizeof(VoxelBlock) + c.voxels.size() * sizeof(uint64_t) +
         c.groups.size() * (sizeof(Group) + 32) + c.anchors.size() * sizeof(Anchor);
}

}  // namespace

DerivedCell::DerivedCell(GrammarChunk&& c, std::pmr::memory_resource* memory)
    : chunk(std::move(c)), index(chunk, memory), bytes(bytesOf(chunk)) {}

Result<std::shared_ptr<const DerivedCell>> CellCache::get(const CellKey& key, const Derive& derive) {
  {
    std::unique_lock lock(mutex_);
    for (;;) {
      const auto found = entries_.find(key);
      if (found == entries_.end()) break;
      if (found->second.cell) {
        ++stats_.hits;
        by_use_.splice(by_use_.begin(), by_use_, found->second.used);
        return found->second.cell;
      }
      // Layers only ask downwards, so whoever derives this cell never waits for us.
      derived_.wait(lock);
    }
    ++stats_.misses;
    entries_.emplace(key, Entry{});
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
    by_use_.push_front(key);
    entries_[key] = {cell, by_use_.begin()};
    stats_.bytes += cell->bytes;
    ++stats_.cells;
    evict();
    derived_.notify_all();
    return std::shared_ptr<const DerivedCell>(cell);
  } catch (...) {
    forget();
    throw;
  }
}

void CellCache::adopt(const CellCache& other, const std::function<bool(const DerivedCell&)>& take) {
  std::vector<std::pair<CellKey, std::shared_ptr<const DerivedCell>>> taken;
  {
    const std::lock_guard lock(other.mutex_);
    for (const CellKey& key : other.by_use_) {
      const std::shared_ptr<const DerivedCell>& cell = other.entries_.at(key).cell;
      if (take(*cell)) taken.emplace_back(key, cell);
    }
  }
  const std::lock_guard lock(mutex_);
  for (const auto& [key, cell] : taken) {
    if (stats_.bytes + cell->bytes > byte_limit_) break;
    if (entries_.count(key) != 0) continue;
    // An entry without a cell would be waited for: whole, or not at all.
    by_use_.push_back(key);
    try {
      entries_.emplace(key, Entry{cell, std::prev(by_use_.end())});
    } catch (...) {
      by_use_.pop_back();
      throw;
    }
    stats_.bytes += cell->bytes;
    ++stats_.cells;
  }
}

void CellCache::evict() {
  // The cell just made stays, however large: its asker holds it anyway.
  while (stats_.bytes > byte_limit_ && by_use_.size() > 1) {
    const auto oldest = entries_.find(by_use_.back());
    stats_.bytes -= oldest->second.cell->bytes;
    --stats_.cells;
    ++stats_.evicted;
    entries_.erase(oldest);
    by_use_.pop_back();
  }
}

CellCacheStats CellCache::stats() const {
  std::lock_guard lock(mutex_);
  return stats_;
}

}  // namespace sgm
