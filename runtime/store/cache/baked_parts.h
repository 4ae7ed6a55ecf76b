#pragma once
// Parts of chunks that were made ahead of time, wherever they are kept (store/).

#include <optional>

#include "store/cache/disk_cache.h"
#include "world/chunk_key.h"

namespace sgm {

/// Of this process, since the source was opened.
struct BakedStats {
  uint64_t hits = 0, misses = 0;  ///< one or the other for every get
  uint64_t damaged = 0;           ///< misses where something was there that could not be trusted
  uint64_t errors = 0;            ///< times that a file could not be read, or was not what it should be
  uint64_t bytes = 0;             ///< read for hits, as they are stored
};

struct BakedPart {
  std::pmr::vector<std::byte> bytes;
  bool is_far = false;  ///< took its time to come: who has a disk cache keeps it there
};

/// Where to look: on this machine alone, which takes as long as its disk does, or on servers, too.
enum class Reach : uint8_t { near, far };

/// Read only. Thread-safe.
class BakedParts {
 public:
  virtual ~BakedParts() = default;

  /// Which world these bytes stand for (bakedWorldInputs of chunk_part.h).
  virtual DiskKey worldOf(std::span<const std::byte> inputs) const = 0;

  /// As encodeChunkPart made it of that world without edits, in `memory`: a body of level 0 with its anchors and voids,
  /// a seam as one to the next level; compared with a hash of all its bytes. None where it is not there, or cannot be
  /// read, or trusted. Throws std::bad_alloc.
  virtual std::optional<BakedPart> get(const DiskKey& world, const ChunkKey& chunk, int part, Reach reach,
                                       std::pmr::memory_resource* memory) = 0;

  /// What get gave, looking so far, is none: counts a damaged miss instead of the hit, and is not given again.
  virtual void reject(const DiskKey& world, const ChunkKey& chunk, int part, Reach reach) = 0;

  /// Whether some may be far: whoever looks that far has time, and looks into a disk cache first. Always the same.
  virtual bool isFar() const = 0;

  /// Nobody has to wait any more: all that follows may be misses.
  virtual void stop() noexcept = 0;

  virtual BakedStats stats() const = 0;
};

}  // namespace sgm
