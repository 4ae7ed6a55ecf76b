#pragma once
// Stores bytes in files between runs of a program. The key of an entry is a hash of everything that its content depends
// on. Losing an entry, or failing to write it, only costs time.
//
// Layout: one file per entry, in 256 folders by the first byte of the key. This is the simplest layout that several
// processes can share safely, because the file system is the index. An entry is written under a temporary name and then
// renamed, so that it appears completely or not at all. Its checksum detects incomplete data, so that writing need not
// wait until data is on disk (unlike FileWriter). Entries are never replaced: equal keys mean equal bytes, so a second
// writer of the same entry does nothing. The modification time of a file is the time of its last use.
//
// Eviction: the folders are grouped into sets that share the size limit evenly, like the sets of a CPU cache. The files
// of a set are listed at the first write to the set, and again after each eighth of its size limit has been written.
// Listing one set takes milliseconds, whereas listing all folders would take a second; so opening the cache takes no
// time, and a listing also sees the entries of other processes. If a set is full, its least recently used entries are
// removed. Processes need no lock for this: two processes that list the same set choose the same files.

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

/// A 128-bit hash that identifies content. Hash collisions are assumed not to occur. All bits are uniformly
/// distributed.
struct DiskKey {
  uint64_t high = 0, low = 0;
  friend auto operator<=>(const DiskKey&, const DiskKey&) = default;
};

/// Statistics of this process, since the cache was opened.
struct DiskCacheStats {
  uint64_t hits = 0, misses = 0;  ///< each call of get() counts as either a hit or a miss
  uint64_t damaged = 0;           ///< number of misses because the stored data was invalid
  uint64_t stored = 0;
  uint64_t dropped = 0;  ///< number of entries that were not stored, because they were too large or space was lacking
  uint64_t evicted = 0;
  uint64_t errors = 0;  ///< number of errors: of the file system, or out of memory
  /// total size of the entries in those sets of folders to which this process has written
  uint64_t bytes = 0;
};

inline constexpr size_t kMaxDiskContent = size_t{64} << 20;  ///< maximum size of an entry's uncompressed content, in
                                                             ///< bytes

/// A cache of byte strings in a folder. Thread-safe. Several processes may open the same folder, each with its own size
/// limit. The cache changes only files whose names have the form of an entry's name.
class DiskCache {
 public:
  /// Receives a message about the first error, on the thread where the error occurred.
  using Log = std::function<void(const std::string&)>;

  /// Opens the cache's folder; creates the folder if it is missing. byte_limit: maximum total size of the files of all
  /// entries. A single process never exceeds it; each further process that writes concurrently may exceed it by less
  /// than an eighth. An entry whose file is larger than the limit is not stored; an entry larger than 16 MiB may not be
  /// stored. memory must be thread-safe and outlive the cache. Errors: invalid_argument (the limit is 0, or the path is
  /// empty); io (the folder cannot be created, or is not a folder); unsupported (built without SGM_DISK_CACHE).
  static Result<std::unique_ptr<DiskCache>> open(const std::filesystem::path& folder, uint64_t byte_limit, Log log,
                                                 std::pmr::memory_resource* memory = std::pmr::get_default_resource());
  virtual ~DiskCache() = default;

  /// Returns the key for content that is a pure function of these inputs: the xxHash128 of the inputs.
  virtual DiskKey keyOf(std::span<const std::byte> inputs) const = 0;

  /// Returns the content of an entry, allocated from `memory`; nullopt if there is no valid entry. Removes an invalid
  /// entry's file. Does not wait for other threads.
  virtual std::optional<std::pmr::vector<std::byte>> get(const DiskKey& key, std::pmr::memory_resource* memory) = 0;

  /// Call this if the content that get() returned proves wrong for the key. Removes the entry, and counts the hit as a
  /// damaged miss instead.
  virtual void reject(const DiskKey& key) = 0;

  /// Stores the content, unless the entry already exists. Waits for the disk, so do not call it on a rendering thread.
  virtual void put(const DiskKey& key, std::span<const std::byte> content) = 0;

  virtual DiskCacheStats stats() const = 0;
};

}  // namespace sgm
