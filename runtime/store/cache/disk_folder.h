#pragma once
// The files of the disk cache: their names, and functions that read, write, list and remove them.

#include "store/cache/disk_cache.h"

namespace sgm {

/// An entry's file in a listing.
struct DiskFile {
  int64_t used = 0;  ///< time of the last use, in nanoseconds of the file system's clock
  DiskKey key;
  uint64_t bytes = 0;
  friend auto operator<=>(const DiskFile&, const DiskFile&) = default;
};

/// Entries are files such as FOLDER/3f/3f...: the key in 32 hexadecimal digits. While an entry is being written, its
/// name ends in ".part"; if the writing process is killed, another process that finds the file after a minute removes
/// it. Stateless; thread-safe, also between processes. Functions return 0 on success, otherwise errno.
class DiskFolder {
 public:
  static constexpr size_t kShards = 256;
  static constexpr int kUntrusted = -1;  ///< not an errno: write() cannot have made the file

  static size_t shardOf(const DiskKey& key) { return static_cast<size_t>(key.high >> 56); }

  explicit DiskFolder(std::string folder) : folder_(std::move(folder)) {}

  const std::string& name() const { return folder_; }

  /// Reads an entry's file. ENOENT: there is no such entry. kUntrusted: it is not a regular file, or too large for an
  /// entry. Throws std::bad_alloc.
  int read(const DiskKey& key, std::pmr::vector<std::byte>& file) const;
  /// Writes an entry's file. EEXIST: the entry exists already, or another process is writing it.
  int write(const DiskKey& key, std::span<const std::byte> file) const;
  int remove(const DiskKey& key) const;
  /// Marks the entry as the most recently used one.
  int touch(const DiskKey& key) const;

  /// Appends the entries of a shard (a folder) to `files`, adds the bytes of entries that are being written to
  /// `unfinished`, and removes abandoned ones. Throws std::bad_alloc.
  int list(size_t shard, std::pmr::vector<DiskFile>& files, uint64_t& unfinished) const;

 private:
  std::string shardName(size_t shard) const;
  std::string fileName(const DiskKey& key) const;

  std::string folder_;
};

}  // namespace sgm
