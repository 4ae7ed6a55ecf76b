#pragma once
// A cache of derived cells with a limit in bytes. It evicts the least recently used cells. A derived cell is a pure
// function of its key, so an evicted cell can be derived again, which only costs time.

#include <atomic>
#include <condition_variable>
#include <functional>
#include <list>
#include <map>
#include <memory>
#include <mutex>
#include <shared_mutex>
#include <span>
#include <vector>

#include "base/result.h"
#include "field/compile.h"

namespace sgm {

/// The shapes of a derived cell, and the index over their groups. Immutable.
struct DerivedCell {
  GrammarChunk chunk;
  GroupIndex index;
  size_t bytes = 0;

  DerivedCell(GrammarChunk&& c, std::pmr::memory_resource* memory);
  IndexedCell indexed() const { return {&chunk, &index}; }
};

struct CellKey {
  uint32_t layer = 0;
  Int3 cell;
  /// Edge in units of the smallest grid cells for which this grammar cell was derived; detail that only smaller grid
  /// cells would show is left out. 0: the cell has all detail.
  int32_t cell_edge = 0;
  friend auto operator<=>(const CellKey&, const CellKey&) = default;
};

/// Cells that one task has already found. Looking up a cell here, instead of in the cache, writes no memory that
/// threads share (copying a shared pointer of the cache changes its reference count). Not thread-safe.
using CachedCells = std::map<CellKey, std::shared_ptr<const DerivedCell>>;

struct CellCacheStats {
  uint64_t hits = 0, misses = 0, evicted = 0;
  size_t bytes = 0, cells = 0;
};

/// A thread-safe cache. If several threads request a missing cell concurrently, one of them derives it and the others
/// wait.
class CellCache {
 public:
  using Derive = std::function<Result<GrammarChunk>()>;

  CellCache(size_t byte_limit, std::pmr::memory_resource* memory) : byte_limit_(byte_limit), memory_(memory) {}

  /// Returns the cell of a key; calls derive if it is missing. derive runs without locks, and may request cells of
  /// lower layers. If derive fails, its error is returned and nothing is cached.
  Result<std::shared_ptr<const DerivedCell>> get(const CellKey& key, const Derive& derive);

  /// Looks up cells without deriving: found[i] becomes the cell of keys[i]; null if it is missing or unfinished.
  void find(std::span<const CellKey> keys, std::vector<std::shared_ptr<const DerivedCell>>& found);

  /// Copies finished cells of another cache that this cache lacks and that `take` accepts, most recently used first,
  /// while the limit allows. take must not call this cache.
  void adopt(const CellCache& other, const std::function<bool(const DerivedCell&)>& take);

  CellCacheStats stats() const;

 private:
  struct Entry {
    std::shared_ptr<const DerivedCell> cell;  ///< null while a thread is deriving the cell
    std::atomic<uint64_t> used{0};            ///< value of clock_ at the latest use of the entry
    std::list<CellKey>::iterator listed;
    uint64_t listed_as = 0;  ///< value of `used` when the entry was last put into by_use_ or moved to its front
  };
  /// Marks an entry as used, and returns its cell. Precondition: the caller holds the lock, shared or exclusive.
  std::shared_ptr<const DerivedCell> use(Entry& entry);
  /// Evicts cells until `bytes` more bytes fit into the limit, or no cell is left.
  void makeRoom(size_t bytes);

  const size_t byte_limit_;
  std::pmr::memory_resource* memory_;
  // Many threads find cells concurrently under a shared lock, so a hit only stores the time of use and does not reorder
  // by_use_. An entry at the end of by_use_ is evicted only if it was not used since it was put into the list or last
  // moved to the front; otherwise it moves to the front (second chance algorithm).
  mutable std::shared_mutex mutex_;
  std::condition_variable_any derived_;
  std::map<CellKey, Entry> entries_;
  std::list<CellKey> by_use_;  ///< finished cells only; roughly in order of latest use, the most recent first
  // The number of cells inserted so far, which serves as the time of use. Eviction happens only at insertions, so uses
  // between two insertions need no order among each other, and repeated hits write nothing. Cells that adopt() copied
  // have the time 0, before all uses.
  std::atomic<uint64_t> clock_{1};
  std::atomic<uint64_t> hits_{0};
  CellCacheStats stats_;  ///< all statistics except the number of hits, which hits_ counts
};

}  // namespace sgm
