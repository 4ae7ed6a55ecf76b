#pragma once
// Files that are far away, in blocks that are near.

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

/// Keeps the blocks that were read last. Who needs one that another is fetching waits for it. Any thread.
class BlockCache {
 public:
  static constexpr size_t kBlock = size_t{1} << 17;  ///< bytes; a file's last is shorter
  static constexpr size_t kMostBlocks = 256;
  static constexpr size_t kMostAtOnce = 4;  ///< blocks of one fetch: what came of a file over a slow line stays

  /// Bytes of a file, from the start of a block to the end of one.
  using Fetch = std::function<Result<std::pmr::vector<std::byte>>(uint64_t offset, size_t bytes)>;

  /// memory: thread-safe; must outlive the cache.
  explicit BlockCache(std::pmr::memory_resource* memory) : memory_(memory), blocks_(memory), used_(memory) {}

  /// From a file, by a number of its own, of so many bytes; offset and bytes lie in it. Blocks that lie side by side
  /// are fetched at once. Errors: fetch's, which are forgotten. Throws std::bad_alloc.
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
  /// Of what one reader wants: blocks side by side.
  struct Wanted {
    uint64_t file, first;
    std::vector<std::shared_ptr<Block>> blocks;
    std::vector<bool> is_mine;  ///< to fetch, and not done yet
  };

  /// The block, and whether the caller is to fetch it. Under the lock.
  std::pair<std::shared_ptr<Block>, bool> find(const Key& key);
  void claim(Wanted& wanted, size_t count);
  void fetchMine(Wanted& wanted, uint64_t file_bytes, const Fetch& fetch);
  void finish(Wanted& wanted, size_t number, std::span<const std::byte> bytes);
  void fail(Wanted& wanted, size_t number, Error error) noexcept;

  std::pmr::memory_resource* const memory_;
  std::mutex mutex_;
  std::condition_variable finished_;
  std::pmr::map<Key, Entry> blocks_;
  std::pmr::list<Key> used_;  ///< the latest first
};

}  // namespace sgm::store
