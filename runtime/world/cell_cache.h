#pragma once
// A cache of derived cells with least-recently-used eviction and a byte limit. A derived cell is a pure function of its
// key, so an evicted cell costs only time.

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

/// A grammar chunk and the index over its groups. Immutable.
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
  int32_t cell_edge = 0;  ///< the cell's content for levels whose cells have this edge or a larger one, units; 0: all
  friend auto operator<=>(const CellKey&, const CellKey&) = default;
};

/// Finished cells that one piece of work has found. Finding a cell here again writes no memory that threads share (the
/// cache would change the owner count). Not thread-safe.
using CellsAtHand = std::map<CellKey, std::shared_ptr<const DerivedCell>>;

struct CellCacheStats {
  uint64_t hits = 0, misses = 0, evicted = 0;
  size_t bytes = 0, cells = 0;
};

/// Thread-safe. If several threads ask for a cell at once, one of them derives it and the others wait.
class CellCache {
 public:
  using Derive = std::function<Result<GrammarChunk>()>;

  CellCache(size_t byte_limit, std::pmr::memory_resource* memory) : byte_limit_(byte_limit), memory_(memory) {}

  /// derive runs without any lock held, and may ask for cells of lower layers. A failed cell is not kept.
  Result<std::shared_ptr<const DerivedCell>> get(const CellKey& key, const Derive& derive);

  /// Looks up finished cells: found[i] is the cell of keys[i], null if it is missing or unfinished.
  void find(std::span<const CellKey> keys, std::vector<std::shared_ptr<const DerivedCell>>& found);

  /// Takes over finished cells of another cache that are missing here, most recently used first, as far as there is
  /// room. take must not call back.
  void adopt(const CellCache& other, const std::function<bool(const DerivedCell&)>& take);

  CellCacheStats stats() const;

 private:
  struct Entry {
    std::shared_ptr<const DerivedCell> cell;  ///< null while it is being derived
    std::atomic<uint64_t> used{0};            ///< clock_ at the latest use
    std::list<CellKey>::iterator listed;
    uint64_t listed_as = 0;  ///< the value of `used` when the entry got its place in the list
  };
  /// The caller holds the lock, shared or exclusive.
  std::shared_ptr<const DerivedCell> use(Entry& entry);
  /// Evicts cells until this many more bytes fit the limit, or no cell is left.
  void makeRoom(size_t bytes);

  const size_t byte_limit_;
  std::pmr::memory_resource* memory_;
  // Many threads find cells concurrently, so a hit only notes the time. An entry that was used since it got its place
  // in the list moves to the front, instead of being evicted, when it comes last (second chance).
  mutable std::shared_mutex mutex_;
  std::condition_variable_any derived_;
  std::map<CellKey, Entry> entries_;
  std::list<CellKey> by_use_;  ///< finished cells only, roughly by use, latest first
  // The number of inserted cells. Eviction happens only at an insertion, so uses between two insertions need no order,
  // and repeated hits write nothing. Adopted cells have 0, which is before all uses.
  std::atomic<uint64_t> clock_{1};
  std::atomic<uint64_t> hits_{0};
  CellCacheStats stats_;  ///< without the hits
};

}  // namespace sgm
