#include "store/cache/disk_cache.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cerrno>
#include <mutex>
#include <system_error>

#include "base/plain_text.h"
#include "store/cache/disk_entry.h"
#include "store/cache/disk_folder.h"

namespace sgm {
namespace {

// The minimum size limit of a set (a group of the cache's subfolders), in bytes. This is enough for thousands of
// chunks, so that random keys fill all sets evenly. Listing the files of such a set takes 10 ms.
constexpr uint64_t kLeastShare = uint64_t{16} << 20;
constexpr uint64_t kSlack = 8;  // an eviction frees at least 1 / kSlack of a set's size limit

class FileCache final : public DiskCache {
 public:
  FileCache(std::string folder, uint64_t byte_limit, Log log, std::pmr::memory_resource* memory)
      : folder_(std::move(folder)),
        log_(std::move(log)),
        memory_(memory),
        sets_(std::bit_floor(std::clamp<uint64_t>(byte_limit / kLeastShare, 1, DiskFolder::kShards))),
        share_(byte_limit / sets_) {}

  DiskKey keyOf(std::span<const std::byte> inputs) const override { return hashDiskKey(inputs); }

  std::optional<std::pmr::vector<std::byte>> get(const DiskKey& key, std::pmr::memory_resource* memory) override try {
    std::pmr::vector<std::byte> file(memory_);
    const int error = folder_.read(key, file);
    if (error == 0) {
      if (auto content = unpackDiskEntry(key, file, memory)) {
        folder_.touch(key);  // updates the time of last use; may fail in a read-only folder, which is harmless
        count(&DiskCacheStats::hits);
        return content;
      }
    }
    count(&DiskCacheStats::misses);
    if (error == 0 || error == DiskFolder::kUntrusted) {
      count(&DiskCacheStats::damaged);
      failed("remove", unlessGone(folder_.remove(key)));
    } else {
      failed("read", unlessGone(error));
    }
    return std::nullopt;
  } catch (const std::bad_alloc&) {
    count(&DiskCacheStats::misses);
    failed("read", ENOMEM);
    return std::nullopt;
  }

  void reject(const DiskKey& key) override {
    failed("remove", unlessGone(folder_.remove(key)));
    const std::lock_guard lock(mutex_);
    --stats_.hits;
    ++stats_.misses;
    ++stats_.damaged;
  }

  void put(const DiskKey& key, std::span<const std::byte> content) override try {
    if (content.size() > kMaxDiskContent) return count(&DiskCacheStats::dropped);
    const auto file = packDiskEntry(key, content, memory_);
    if (!file) throw std::bad_alloc();
    Room room(*this, setOf(key), file->size());
    if (!room) return count(&DiskCacheStats::dropped);
    const int error = folder_.write(key, *file);
    if (error == 0) {
      room.fill();
    } else if (error != EEXIST) {
      failed("write", error);
    }
  } catch (const std::bad_alloc&) {
    failed("write", ENOMEM);
  }

  DiskCacheStats stats() const override {
    const std::lock_guard lock(mutex_);
    return stats_;
  }

 private:
  /// A group of shards (subfolders), which has its own part of the cache's size limit.
  struct Set {
    std::mutex mutex;
    /// total size of the set's entries: those of the last listing, plus those that this process wrote since
    uint64_t bytes = 0;
    uint64_t writing = 0;  ///< total size of the entries that are being written
    uint64_t allowed = 0;  ///< number of bytes that may be written before the folders are listed again
  };

  size_t setSize() const { return DiskFolder::kShards / sets_; }
  Set& setOf(const DiskKey& key) { return all_sets_[DiskFolder::shardOf(key) / setSize()]; }

  /// Reserves space in a set while an entry is written; the destructor releases it, unless fill() was called. Converts
  /// to false if the set has no space for the entry.
  class Room {
   public:
    Room(FileCache& cache, Set& set, uint64_t bytes) : cache_(cache), set_(set), bytes_(bytes) {
      if (bytes > cache.share_) return;
      const std::lock_guard lock(set.mutex);
      if (bytes > set.allowed) cache.makeRoom(set, bytes);
      if (bytes > set.allowed) return;
      set.allowed -= bytes;
      set.writing += bytes;
      held_ = true;
    }
    Room(const Room&) = delete;
    ~Room() {
      if (!held_) return;
      const std::lock_guard lock(set_.mutex);
      set_.writing -= bytes_;
      if (!filled_) set_.allowed += bytes_;
    }
    explicit operator bool() const { return held_; }

    /// Call this once the entry is written: the reserved bytes then count as used.
    void fill() {
      const std::lock_guard lock(set_.mutex);
      cache_.setBytes(set_, set_.bytes + bytes_);
      cache_.count(&DiskCacheStats::stored);
      filled_ = true;
    }

   private:
    FileCache& cache_;
    Set& set_;
    uint64_t bytes_;
    bool held_ = false, filled_ = false;
  };

  /// Lists the entries of a set. If the set would exceed its size limit with `bytes` more bytes, removes its least
  /// recently used entries. Then sets how many bytes may be written to the set before its entries are listed again.
  void makeRoom(Set& set, uint64_t bytes) {
    std::pmr::vector<DiskFile> files(memory_);
    uint64_t total = set.writing;
    const size_t first = static_cast<size_t>(&set - all_sets_.data()) * setSize();
    for (size_t shard = first; shard < first + setSize(); ++shard) failed("list", folder_.list(shard, files, total));
    uint64_t stored = 0;
    for (const DiskFile& file : files) stored += file.bytes;
    total += stored;
    if (total + bytes > share_) {
      std::sort(files.begin(), files.end());
      const uint64_t goal = std::min(share_ - bytes, share_ - share_ / kSlack);
      for (auto file = files.begin(); file != files.end() && total > goal; ++file) {
        const int error = folder_.remove(file->key);
        if (error == 0) count(&DiskCacheStats::evicted);
        if (failed("remove", unlessGone(error))) continue;
        total -= file->bytes;
        stored -= file->bytes;
      }
    }
    setBytes(set, stored);
    const uint64_t room = total < share_ ? share_ - total : 0;
    set.allowed = std::min(room, std::max(bytes, share_ / kSlack));
  }

  void setBytes(Set& set, uint64_t bytes) {
    const std::lock_guard lock(mutex_);
    stats_.bytes += bytes - set.bytes;
    set.bytes = bytes;
  }

  void count(uint64_t DiskCacheStats::*what) {
    const std::lock_guard lock(mutex_);
    ++(stats_.*what);
  }

  /// Treats "the file does not exist" as success (0): the entry was never stored, or another process has removed it.
  static int unlessGone(int error) { return error == ENOENT ? 0 : error; }

  /// Returns true if `error` is not 0. Counts the error, and logs it if it is the first one.
  bool failed(const char* what, int error) {
    if (error == 0) return false;
    bool first = false;
    {
      const std::lock_guard lock(mutex_);
      first = stats_.errors++ == 0;
    }
    if (first && log_) {
      log_("cannot " + std::string(what) + " in the disk cache '" + folder_.name() + "': " + systemMessage(error) +
           "; uncached chunks are computed again");
    }
    return true;
  }

  const DiskFolder folder_;
  const Log log_;
  std::pmr::memory_resource* const memory_;
  const uint64_t sets_, share_;
  std::array<Set, DiskFolder::kShards> all_sets_;  ///< sets; only the first sets_ elements are used
  mutable std::mutex mutex_;                       ///< guards stats_; may be locked while a set's mutex is locked, but
                                                   ///< not the other way round
  DiskCacheStats stats_;
};

}  // namespace

Result<std::unique_ptr<DiskCache>> DiskCache::open(const std::filesystem::path& folder, uint64_t byte_limit, Log log,
                                                   std::pmr::memory_resource* memory) {
  if (byte_limit == 0) {
    return Error{Code::invalid_argument, "a disk cache needs a limit above 0 bytes; for no cache, do not open one"};
  }
  if (folder.empty()) return Error{Code::invalid_argument, "a disk cache needs a folder"};
  std::error_code why;
  // The path is made absolute, because the process may later change its working directory.
  const std::filesystem::path place = std::filesystem::absolute(folder, why);
  if (!why) std::filesystem::create_directories(place, why);
  if (!why && !std::filesystem::is_directory(place, why) && !why)
    why = std::make_error_code(std::errc::not_a_directory);
  if (why) return Error{Code::io, "cannot open the disk cache '" + folder.string() + "': " + systemMessage(why)};
  return std::unique_ptr<DiskCache>(new FileCache(place.string(), byte_limit, std::move(log), memory));
}

}  // namespace sgm
