#pragma once
// Derived cells, kept by use up to a number of bytes. What a cell derives to is a pure function of its key, so losing
// one costs time only.

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
  int32_t cell_edge = 0;  ///< what levels with cells of this edge or a larger one have of it, units; 0: all
  friend auto operator<=>(const CellKey&, const CellKey&) = default;
};

/// Finished cells that one piece of work has found: it finds them again without a word that other threads write, as
/// the count of a cell's owners is. Not thread-safe.
using CellsAtHand = std::map<CellKey, std::shared_ptr<const DerivedCell>>;

struct CellCacheStats {
  uint64_t hits = 0, misses = 0, evicted = 0;
  size_t bytes = 0, cells = 0;
};

/// Thread-safe. A cell asked for by several threads at once is derived by one of them; the others wait for it.
class CellCache {
 public:
  using Derive = std::function<Result<GrammarChunk>()>;

  CellCache(size_t byte_limit, std::pmr::memory_resource* memory) : byte_limit_(byte_limit), memory_(memory) {}

  /// derive runs without any lock held, and may ask for cells of lower layers. A failed cell is not kept.
  Result<std::shared_ptr<const DerivedCell>> get(const CellKey& key, const Derive& derive);

  /// The finished cells among those of the keys, in their order, null for each other: found[i] is that of keys[i].
  void find(std::span<const CellKey> keys, std::vector<std::shared_ptr<const DerivedCell>>& found);

  /// Takes over finished cells of another cache that it does not have itself, the latest used first, as far as there is
  /// room. take must not call back.
  void adopt(const CellCache& other, const std::function<bool(const DerivedCell&)>& take);

  CellCacheStats stats() const;

 private:
  struct Entry {
    std::shared_ptr<const DerivedCell> cell;  ///< null while it is being derived
    std::atomic<uint64_t> used{0};            ///< what clock_ was when it was last asked for
    std::list<CellKey>::iterator listed;
    uint64_t listed_as = 0;  ///< what `used` was when it got its place in the list
  };
  /// Under the lock, shared or not.
  std::shared_ptr<const DerivedCell> use(Entry& entry);
  /// So that so many bytes more are within the limit, or no cell is left.
  void makeRoom(size_t bytes);

  const size_t byte_limit_;
  std::pmr::memory_resource* memory_;
  // Cells that are there are found by many threads at one time, and only note when. Who has been asked for since it got
  // its place in the list gets one at the beginning when its turn to go has come.
  mutable std::shared_mutex mutex_;
  std::condition_variable_any derived_;
  std::map<CellKey, Entry> entries_;
  std::list<CellKey> by_use_;  ///< by use, about the latest first; only finished cells
  // Counts the cells that have come: between two of them nothing can have to go, so that no order is needed, and who
  // finds a cell in use has nothing to write. 0 is before all uses: adopted cells have it.
  std::atomic<uint64_t> clock_{1};
  std::atomic<uint64_t> hits_{0};
  CellCacheStats stats_;  ///< but for the hits
};

}  // namespace sgm
