#pragma once
// The files of the disk cache: their names, and how they are read, written and removed.

#include "store/cache/disk_cache.h"

namespace sgm {

/// An entry's file in a listing.
struct DiskFile {
  int64_t used = 0;  ///< nanoseconds of the file system's clock
  DiskKey key;
  uint64_t bytes = 0;
  friend auto operator<=>(const DiskFile&, const DiskFile&) = default;
};

/// Entries in FOLDER/3f/3f...: 32 hexadecimal digits of the key. An entry that is being written ends in ".part"; if the
/// process is killed, another one that finds the file a minute later removes it. Stateless; thread-safe, also between
/// processes. Functions return 0 or errno.
class DiskFolder {
 public:
  static constexpr size_t kShards = 256;
  static constexpr int kUntrusted = -1;  ///< not an errno: the file cannot have been made by write()

  static size_t shardOf(const DiskKey& key) { return static_cast<size_t>(key.high >> 56); }

  explicit DiskFolder(std::string folder) : folder_(std::move(folder)) {}

  const std::string& name() const { return folder_; }

  /// ENOENT: no such entry. kUntrusted: not a regular file, or too large for an entry. Throws std::bad_alloc.
  int read(const DiskKey& key, std::pmr::vector<std::byte>& file) const;
  /// EEXIST: the entry exists, or another process is writing it.
  int write(const DiskKey& key, std::span<const std::byte> file) const;
  int remove(const DiskKey& key) const;
  /// Marks the entry as the most recently used.
  int touch(const DiskKey& key) const;

  /// Appends the entries of a shard, adds the bytes of entries being written to `unfinished`, and removes abandoned
  /// ones. Throws std::bad_alloc.
  int list(size_t shard, std::pmr::vector<DiskFile>& files, uint64_t& unfinished) const;

 private:
  std::string shardName(size_t shard) const;
  std::string fileName(const DiskKey& key) const;

  std::string folder_;
};

}  // namespace sgm
