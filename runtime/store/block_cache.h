#pragma once
// Caches blocks of files that are far away.

#include <condition_variable>
#include <cstddef>
#include <functional>
#include <list>
#include <map>
#include <memory>
#include <memory_resource>
#include <mutex>
#include <optional>
#include <span>
#include <vector>

#include "base/result.h"

namespace sgm::store {

/// Keeps the most recently read blocks. A thread that needs a block waits if another thread is fetching it.
/// Thread-safe.
class BlockCache {
 public:
  static constexpr size_t kBlock = size_t{1} << 17;  ///< bytes; the last block of a file is shorter
  static constexpr size_t kMostBlocks = 256;
  static constexpr size_t kMostAtOnce = 4;  ///< blocks of one fetch: few, so that much of a slow download stays if it
                                            ///< is cut off

  /// Fetches bytes of a file, from the start of a block to the end of one.
  using Fetch = std::function<Result<std::pmr::vector<std::byte>>(uint64_t offset, size_t bytes)>;

  /// memory: thread-safe; must outlive the cache.
  explicit BlockCache(std::pmr::memory_resource* memory) : memory_(memory), blocks_(memory), used_(memory) {}

  /// Reads from a file of this size that the caller has numbered; offset and bytes lie in it. Adjacent blocks are
  /// fetched together. Errors: those of fetch; they are not cached. Throws std::bad_alloc.
  Result<std::pmr::vector<std::byte>> read(uint64_t file, uint64_t file_bytes, uint64_t offset, size_t bytes,
                                           const Fetch& fetch, std::pmr::memory_resource* memory);

 private:
  struct Block {
    std::pmr::vector<std::byte> bytes;
    std::optional<Error> error;
    bool is_done = false;
  };
  using Key = std::pair<uint64_t, uint64_t>;  ///< file and block
  struct Entry {
    std::shared_ptr<Block> block;
    std::pmr::list<Key>::iterator used;
  };
  /// The adjacent blocks of one read.
  struct Wanted {
    uint64_t file, first;
    std::vector<std::shared_ptr<Block>> blocks;
    std::vector<bool> is_mine;  ///< this thread must still fetch the block
  };

  /// Returns the block, and whether the caller must fetch it. The caller holds the lock.
  std::pair<std::shared_ptr<Block>, bool> find(const Key& key);
  void claim(Wanted& wanted, size_t count);
  void fetchMine(Wanted& wanted, uint64_t file_bytes, const Fetch& fetch);
  void finish(Wanted& wanted, size_t number, std::span<const std::byte> bytes);
  void fail(Wanted& wanted, size_t number, Error error) noexcept;

  std::pmr::memory_resource* const memory_;
  std::mutex mutex_;
  std::condition_variable finished_;
  std::pmr::map<Key, Entry> blocks_;
  std::pmr::list<Key> used_;  ///< most recently used first
};

}  // namespace sgm::store
