#pragma once
// Stores bytes in files from one run to the next. The key is a hash of everything that the content depends on. Losing
// an entry, or failing to write it, only costs time.
//
// The layout is one file per entry, in 256 folders by the key's first byte: the simplest layout that several processes
// can share safely, because the file system is the index. An entry is written under a temporary name and renamed, so
// that it appears completely or not at all. Its checksum detects incomplete data, so that writers need not wait until
// data is on disk (as FileWriter does). Entries are never replaced: equal keys mean equal bytes, so a second writer of
// the same entry does nothing.
//
// A file's modification time is the time of its last use. The folders are grouped into a few sets that share the limit
// evenly, like the sets of a processor's cache. A set is listed at its first write, and again after each eighth of its
// share has been written. That takes milliseconds, whereas listing all folders would take a second. So opening the
// cache takes no time, and entries of other processes are seen. A listing removes the least recently used entries,
// without a lock between processes: two processes that list the same set choose the same files.

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

/// A 128-bit hash that identifies content. Collisions are not expected. All bits are uniformly distributed.
struct DiskKey {
  uint64_t high = 0, low = 0;
  friend auto operator<=>(const DiskKey&, const DiskKey&) = default;
};

/// Counts by this process, since the cache was opened.
struct DiskCacheStats {
  uint64_t hits = 0, misses = 0;  ///< each call of get() counts as one of the two
  uint64_t damaged = 0;           ///< misses because the stored data was invalid
  uint64_t stored = 0;
  uint64_t dropped = 0;  ///< contents that were not stored: they were too large, or there was not enough space
  uint64_t evicted = 0;
  uint64_t errors = 0;  ///< errors of the file system, or lack of memory
  /// size of the entries in sets that were written to: at the last listing, plus entries stored since
  uint64_t bytes = 0;
};

inline constexpr size_t kMaxDiskContent = size_t{64} << 20;  ///< maximum size of an entry's content in bytes

/// Thread-safe. Several processes may open the same folder, each with its own limit. The cache changes only files whose
/// names are those of entries.
class DiskCache {
 public:
  /// Receives the first error that is counted, on the thread where it occurred.
  using Log = std::function<void(const std::string&)>;

  /// Opens the folder; creates it if it is missing. byte_limit: for the files of all entries. A single process never
  /// exceeds it; each further process that writes concurrently may exceed it by less than an eighth. An entry whose
  /// file is larger than the limit is dropped; an entry larger than 16 MiB may be dropped. memory must be thread-safe
  /// and outlive the cache. Errors: invalid_argument (the limit is 0, or the path is empty); io (the folder cannot be
  /// created, or is not a folder); unsupported (built without SGM_DISK_CACHE).
  static Result<std::unique_ptr<DiskCache>> open(const std::filesystem::path& folder, uint64_t byte_limit, Log log,
                                                 std::pmr::memory_resource* memory = std::pmr::get_default_resource());
  virtual ~DiskCache() = default;

  /// Returns the key for content that is a pure function of these bytes: their xxHash128.
  virtual DiskKey keyOf(std::span<const std::byte> inputs) const = 0;

  /// Returns the content, in `memory`; nullopt on a miss. Removes an invalid file. Does not wait for other threads.
  virtual std::optional<std::pmr::vector<std::byte>> get(const DiskKey& key, std::pmr::memory_resource* memory) = 0;

  /// Call this if the result of get() was wrong for the key. Removes the entry, and counts a damaged miss instead of
  /// the hit.
  virtual void reject(const DiskKey& key) = 0;

  /// Stores the content unless the entry exists. Waits for the disk, so do not call it on a rendering thread.
  virtual void put(const DiskKey& key, std::span<const std::byte> content) = 0;

  virtual DiskCacheStats stats() const = 0;
};

}  // namespace sgm
