#pragma once
// The interface of sources of baked chunk parts, independent of where the parts are stored.

#include <functional>
#include <optional>

#include "store/cache/disk_cache.h"
#include "world/chunk_key.h"

namespace sgm {

/// Statistics of this process, since the source was opened.
struct BakedStats {
  uint64_t hits = 0, misses = 0;  ///< each call of get() counts as either a hit or a miss
  uint64_t damaged = 0;           ///< number of misses because the stored data was invalid
  uint64_t errors = 0;            ///< number of files that could not be read or were invalid
  uint64_t bytes = 0;             ///< compressed bytes read for hits
};

struct BakedPart {
  std::pmr::vector<std::byte> bytes;
  bool is_far = false;  ///< true: the part came from a server, so that it is worth storing in a disk cache
};

/// The keys under which stores may contain the parts of a world.
struct BakedWorld {
  DiskKey key;
  /// Returns the key that version 0.2 of the library gave to this world. A call may take milliseconds; it is made only
  /// for stores that have no data under `key`. Null if this world has no former key.
  std::function<DiskKey()> former_key{};
};

/// Which stores get() searches. near: folders on this machine, which takes the time of a disk access; far: also
/// servers.
enum class Reach : uint8_t { near, far };

/// A read-only source of baked parts. Thread-safe.
class BakedParts {
 public:
  virtual ~BakedParts() = default;

  /// Returns the key that identifies a world. inputs: the result of bakedWorldInputs (chunk_part.h) for the world.
  virtual DiskKey worldOf(std::span<const std::byte> inputs) const = 0;

  /// Returns a baked part, encoded by encodeChunkPart for the world without edits; its bytes are allocated from
  /// `memory`. A body of level 0 includes anchors and void components; a seam connects the chunk to the next coarser
  /// level. All bytes are verified by a hash. nullopt if the part is missing, unreadable or invalid. Throws
  /// std::bad_alloc.
  virtual std::optional<BakedPart> get(const BakedWorld& world, const ChunkKey& chunk, int part, Reach reach,
                                       std::pmr::memory_resource* memory) = 0;

  /// Call this if the part that get() returned for these arguments proves invalid. Counts the hit as a damaged miss
  /// instead; from now on get() does not return this part again.
  virtual void reject(const BakedWorld& world, const ChunkKey& chunk, int part, Reach reach) = 0;

  /// True if some parts may be on servers. Then get() may be slow, so a disk cache should be searched first. Never
  /// changes.
  virtual bool isFar() const = 0;

  /// Ends all waits for servers. Later calls of get() may miss parts that only a server has.
  virtual void stop() noexcept = 0;

  virtual BakedStats stats() const = 0;
};

}  // namespace sgm
