#pragma once
// The files of the disk cache: their names, and functions that read, write, list and remove them.

#include "store/cache/disk_cache.h"

namespace sgm {

/// A file of the disk cache, as found by listing a folder.
struct DiskFile {
  int64_t used = 0;  ///< time of the last use, in nanoseconds of the file system's clock
  DiskKey key;
  uint64_t bytes = 0;
  friend auto operator<=>(const DiskFile&, const DiskFile&) = default;
};

/// Reads, writes and lists the files of entries. The file of an entry is FOLDER/3f/3f...: its key in 32 hexadecimal
/// digits. While an entry is being written, its file has the suffix ".part"; if the writing process is killed, another
/// process that finds this file after a minute removes it. Stateless; thread-safe, also between processes. Functions
/// return 0 on success, otherwise errno.
class DiskFolder {
 public:
  static constexpr size_t kShards = 256;
  static constexpr int kUntrusted = -1;  ///< an error that is not an errno: the file is not one that write() has made

  static size_t shardOf(const DiskKey& key) { return static_cast<size_t>(key.high >> 56); }

  explicit DiskFolder(std::string folder) : folder_(std::move(folder)) {}

  const std::string& name() const { return folder_; }

  /// Reads an entry's file. Returns ENOENT if there is no such entry; kUntrusted if the path is not a regular file, or
  /// the file is too large for an entry. Throws std::bad_alloc.
  int read(const DiskKey& key, std::pmr::vector<std::byte>& file) const;
  /// Writes an entry's file. Returns EEXIST if the entry exists already, or another process is writing it.
  int write(const DiskKey& key, std::span<const std::byte> file) const;
  int remove(const DiskKey& key) const;
  /// Marks an entry as the most recently used one, by setting its file's modification time.
  int touch(const DiskKey& key) const;

  /// Lists a shard (a subfolder): appends its entries to `files`, and adds the sizes of entries that are being written
  /// to `unfinished`. Removes temporary files that were abandoned. Throws std::bad_alloc.
  int list(size_t shard, std::pmr::vector<DiskFile>& files, uint64_t& unfinished) const;

 private:
  std::string shardName(size_t shard) const;
  std::string fileName(const DiskKey& key) const;

  std::string folder_;
};

}  // namespace sgm
