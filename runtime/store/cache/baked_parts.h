#pragma once
// Parts of chunks that were baked ahead of time, wherever they are stored (store/).

#include <optional>

#include "store/cache/disk_cache.h"
#include "world/chunk_key.h"

namespace sgm {

/// Of this process, since the source was opened.
struct BakedStats {
  uint64_t hits = 0, misses = 0;  ///< each get counts as one of them
  uint64_t damaged = 0;           ///< misses because the stored data was invalid
  uint64_t errors = 0;            ///< files that could not be read, or were invalid
  uint64_t bytes = 0;             ///< read for hits, compressed
};

struct BakedPart {
  std::pmr::vector<std::byte> bytes;
  bool is_far = false;  ///< it came from a server: worth storing in a disk cache
};

/// Where to search: only on this machine, which takes as long as its disk does, or also on servers.
enum class Reach : uint8_t { near, far };

/// Read only. Thread-safe.
class BakedParts {
 public:
  virtual ~BakedParts() = default;

  /// Identifies the world by these bytes (bakedWorldInputs of chunk_part.h).
  virtual DiskKey worldOf(std::span<const std::byte> inputs) const = 0;

  /// Returns the output of encodeChunkPart for that world without edits, in `memory`: a body of level 0 with its
  /// anchors and voids, a seam to the next level. Verified by a hash of all bytes. nullopt if it is missing, unreadable
  /// or invalid. Throws std::bad_alloc.
  virtual std::optional<BakedPart> get(const DiskKey& world, const ChunkKey& chunk, int part, Reach reach,
                                       std::pmr::memory_resource* memory) = 0;

  /// Call if the result of get() with this reach is invalid: counts a damaged miss instead of the hit, and get() does
  /// not return it again.
  virtual void reject(const DiskKey& world, const ChunkKey& chunk, int part, Reach reach) = 0;

  /// Whether some parts may be on servers: such searches take time, and should try a disk cache first. Constant.
  virtual bool isFar() const = 0;

  /// Ends all waits: from now on calls may miss.
  virtual void stop() noexcept = 0;

  virtual BakedStats stats() const = 0;
};

}  // namespace sgm
