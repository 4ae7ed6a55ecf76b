#pragma once
// Keeps blocks of files in memory: a cache for files that are on a server.

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

/// An LRU cache of blocks. A thread that needs a block which another thread is already fetching waits for the end of
/// that fetch. Thread-safe.
class BlockCache {
 public:
  static constexpr size_t kBlock = size_t{1} << 17;  ///< size of a block in bytes; the last block of a file may be
                                                     ///< shorter
  static constexpr size_t kMaxBlocks = 256;
  /// maximum number of blocks per fetch: small, so that an interrupted download loses little data
  static constexpr size_t kMaxConcurrent = 4;

  /// Fetches a range of bytes of a file. The range starts and ends at block boundaries, or at the end of the file.
  using Fetch = std::function<Result<std::pmr::vector<std::byte>>(uint64_t offset, size_t bytes)>;

  /// memory: resource for the blocks; must be thread-safe and outlive the cache.
  explicit BlockCache(std::pmr::memory_resource* memory) : memory_(memory), blocks_(memory), used_(memory) {}

  /// Reads a range of bytes of a file, and fetches missing blocks; adjacent missing blocks are fetched together. file:
  /// a number that the caller has chosen to identify the file; file_bytes: size of the file. The range must lie in the
  /// file. Errors: those of `fetch`; they are not cached. Throws std::bad_alloc.
  Result<std::pmr::vector<std::byte>> read(uint64_t file, uint64_t file_bytes, uint64_t offset, size_t bytes,
                                           const Fetch& fetch, std::pmr::memory_resource* memory);

 private:
  struct Block {
    std::pmr::vector<std::byte> bytes;
    std::optional<Error> error;
    bool is_done = false;
  };
  using Key = std::pair<uint64_t, uint64_t>;  ///< number of the file, and index of the block in that file
  struct Entry {
    std::shared_ptr<Block> block;
    std::pmr::list<Key>::iterator used;
  };
  /// The adjacent blocks that one call of read() needs.
  struct Wanted {
    uint64_t file, first;
    std::vector<std::shared_ptr<Block>> blocks;
    std::vector<bool> is_mine;  ///< for each block: true if this thread must fetch it
  };

  /// Finds or adds a block. Returns the block, and true if it was added, so that the caller must fetch it.
  /// Precondition: the caller holds mutex_.
  std::pair<std::shared_ptr<Block>, bool> find(const Key& key);
  void claim(Wanted& wanted, size_t count);
  void fetchMine(Wanted& wanted, uint64_t file_bytes, const Fetch& fetch);
  void finish(Wanted& wanted, size_t number, std::span<const std::byte> bytes);
  void fail(Wanted& wanted, size_t number, Error error) noexcept;

  std::pmr::memory_resource* const memory_;
  std::mutex mutex_;
  std::condition_variable finished_;
  std::pmr::map<Key, Entry> blocks_;
  std::pmr::list<Key> used_;  ///< keys of all cached blocks, most recently used first
};

}  // namespace sgm::store
