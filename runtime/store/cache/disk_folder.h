#pragma once
// The files of the disk cache: where an entry lies, and how it comes and goes.

#include "store/cache/disk_cache.h"

namespace sgm {

/// An entry's file as a listing sees it.
struct DiskFile {
  int64_t used = 0;  ///< nanoseconds of the file system's clock
  DiskKey key;
  uint64_t bytes = 0;
  friend auto operator<=>(const DiskFile&, const DiskFile&) = default;
};

/// Entries in FOLDER/3f/3f...: 32 hexadecimal digits of the key. One that is being written has the ending ".part"; a
/// killed process leaves it, and whoever meets it a minute later removes it. Stateless; any thread, any process.
/// Functions return 0 or errno.
class DiskFolder {
 public:
  static constexpr size_t kShards = 256;
  static constexpr int kUntrusted = -1;  ///< no errno: there is something that no write() has made

  static size_t shardOf(const DiskKey& key) { return static_cast<size_t>(key.high >> 56); }

  explicit DiskFolder(std::string folder) : folder_(std::move(folder)) {}

  const std::string& name() const { return folder_; }

  /// ENOENT: no such entry. kUntrusted: no regular file, or one too large for an entry. Throws std::bad_alloc.
  int read(const DiskKey& key, std::pmr::vector<std::byte>& file) const;
  /// EEXIST: it is there, or another is writing it.
  int write(const DiskKey& key, std::span<const std::byte> file) const;
  int remove(const DiskKey& key) const;
  /// Makes the entry the latest used.
  int touch(const DiskKey& key) const;

  /// Appends the entries of a shard, adds to `unfinished` the bytes of those that are being written, and removes those
  /// that will never be finished. Throws std::bad_alloc.
  int list(size_t shard, std::pmr::vector<DiskFile>& files, uint64_t& unfinished) const;

 private:
  std::string shardName(size_t shard) const;
  std::string fileName(const DiskKey& key) const;

  std::string folder_;
};

}  // namespace sgm
