#pragma once
// Stores bytes in files from one run to the next. The key is a hash of everything that the content depends on. A lost
// or unwritable entry costs only time.
//
// One file an entry, in 256 folders by the key's first byte, is the simplest layout that several processes can share
// safely: the file system is the index. An entry is written under another name and renamed, so that it appears at once
// or never. Its checksum makes it trustworthy, so nothing waits for the disk (as FileWriter does). Entries are never
// replaced: equal keys mean equal bytes, and the second writer finds it done.
//
// A file's modification time is the time of its last use. The folders form a few sets that share the limit evenly, like
// the ways of a processor's cache. A set is listed at its first write, and again after writing each eighth of its
// share: this takes milliseconds, where listing all would take a second. It needs no work on opening, and sees the
// entries of other processes. Listing removes the longest unused entries, without a lock between processes: two that
// list the same set choose the same files.

#include <compare>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <memory_resource>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/result.h"

namespace sgm {

/// A 128-bit hash that identifies a content: collisions are not expected. Uniform in every bit.
struct DiskKey {
  uint64_t high = 0, low = 0;
  friend auto operator<=>(const DiskKey&, const DiskKey&) = default;
};

/// Of this process, since the cache was opened.
struct DiskCacheStats {
  uint64_t hits = 0, misses = 0;  ///< each get counts as one of them
  uint64_t damaged = 0;           ///< misses because the stored data was invalid
  uint64_t stored = 0;
  uint64_t dropped = 0;  ///< not stored: too large, or not enough room
  uint64_t evicted = 0;
  uint64_t errors = 0;  ///< of the file system or of memory
  uint64_t bytes = 0;   ///< of the entries in sets that were written to, as last listed, plus those stored since
};

inline constexpr size_t kMaxDiskContent = size_t{64} << 20;  ///< bytes of one entry's content

/// Thread-safe. Any number of processes may open the same folder, each with its own limit. Only files with names of
/// entries are ever changed.
class DiskCache {
 public:
  /// Receives the first counted error, on the thread where it occurred.
  using Log = std::function<void(const std::string&)>;

  /// Opens the folder, and creates it if it is missing. byte_limit: for all entries' files; a single process never
  /// exceeds it, each further process that writes concurrently by less than an eighth. An entry with a file larger than
  /// the limit is dropped; one larger than 16 MiB may be. memory must be thread-safe and outlive the cache. Errors:
  /// invalid_argument (a limit of 0, no folder), io (the folder cannot be created, or is something else), unsupported
  /// (built without SGM_DISK_CACHE).
  static Result<std::unique_ptr<DiskCache>> open(const std::filesystem::path& folder, uint64_t byte_limit, Log log,
                                                 std::pmr::memory_resource* memory = std::pmr::get_default_resource());
  virtual ~DiskCache() = default;

  /// The key of content that is a pure function of these bytes: their xxHash128.
  virtual DiskKey keyOf(std::span<const std::byte> inputs) const = 0;

  /// The content, in `memory`; nullopt on a miss. Removes an invalid file. Waits for no other thread.
  virtual std::optional<std::pmr::vector<std::byte>> get(const DiskKey& key, std::pmr::memory_resource* memory) = 0;

  /// Call if the result of get() is wrong for the key: removes it, and counts a damaged miss instead of the hit.
  virtual void reject(const DiskKey& key) = 0;

  /// Stores the content unless it exists. Waits for the disk: not for a rendering thread.
  virtual void put(const DiskKey& key, std::span<const std::byte> content) = 0;

  virtual DiskCacheStats stats() const = 0;
};

}  // namespace sgm
