#pragma once
// Bytes kept in files from one run to the next, by a key that is a hash of everything they depend on. What is lost, or
// cannot be written, costs time only.
//
// One file an entry, in 256 folders by the key's first byte, is the simplest that stays whole in the hands of several
// processes: the file system is the index. An entry is written beside and renamed, so that it appears at once or never,
// and its checksum is what makes it trusted, so that nothing waits for the disk (which FileWriter does). Nothing is
// replaced: equal keys mean equal bytes, and who comes second finds it done.
//
// A file's time of modification is the time of its last use. The folders fall into a few sets that share the limit
// evenly, as the ways of a processor's cache do. A set is listed when something is first put into it, and again after
// each eighth of its share: that takes milliseconds where listing all would take a second, needs no work on opening,
// and sees what others have stored. It removes the longest unused, without a lock between processes: two that list the
// same set choose the same files.

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

/// 128 bits that stand for the content: nobody ever finds two contents with one key. Uniform in every bit.
struct DiskKey {
  uint64_t high = 0, low = 0;
  friend auto operator<=>(const DiskKey&, const DiskKey&) = default;
};

/// Of this process, since the cache was opened.
struct DiskCacheStats {
  uint64_t hits = 0, misses = 0;  ///< one or the other for every get
  uint64_t damaged = 0;           ///< misses where something was there that could not be trusted
  uint64_t stored = 0;
  uint64_t dropped = 0;  ///< not stored: too large, or no room could be made
  uint64_t evicted = 0;
  uint64_t errors = 0;  ///< of the file system or of memory
  uint64_t bytes = 0;   ///< of the entries in the sets that something was put into, as last listed, and stored since
};

inline constexpr size_t kMaxDiskContent = size_t{64} << 20;  ///< bytes of one entry's content

/// Thread-safe; any number of processes may have the same folder open, each with a limit of its own. Only files that
/// are named as entries are ever touched.
class DiskCache {
 public:
  /// Told once, of the first error that is counted, on the thread that met it.
  using Log = std::function<void(const std::string&)>;

  /// Makes the folder where it is missing. byte_limit: of all entries' files; never exceeded by one process, and by
  /// less than an eighth for each other one that writes at the same time. An entry is dropped whose file is larger than
  /// that, and may be where it is larger than 16 MiB. memory, thread-safe, must outlive the cache.
  /// Errors: invalid_argument (a limit of 0, no folder), io (the folder cannot be made, or is none), unsupported (built
  /// without: SGM_DISK_CACHE).
  static Result<std::unique_ptr<DiskCache>> open(const std::filesystem::path& folder, uint64_t byte_limit, Log log,
                                                 std::pmr::memory_resource* memory = std::pmr::get_default_resource());
  virtual ~DiskCache() = default;

  /// The key of content that is a pure function of these bytes: their xxHash128.
  virtual DiskKey keyOf(std::span<const std::byte> inputs) const = 0;

  /// The content, in `memory`; none on a miss. A file that cannot be trusted is removed. Waits for no other thread.
  virtual std::optional<std::pmr::vector<std::byte>> get(const DiskKey& key, std::pmr::memory_resource* memory) = 0;

  /// What get gave is not what the key stands for: removes it, and counts a damaged miss instead of the hit.
  virtual void reject(const DiskKey& key) = 0;

  /// Stores the content unless it is there. Takes as long as the disk does: not for a thread that draws.
  virtual void put(const DiskKey& key, std::span<const std::byte> content) = 0;

  virtual DiskCacheStats stats() const = 0;
};

}  // namespace sgm
