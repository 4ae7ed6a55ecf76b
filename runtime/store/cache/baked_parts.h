#pragma once
// The interface of sources of baked chunk parts, independent of where these are stored.

#include <functional>
#include <optional>

#include "store/cache/disk_cache.h"
#include "world/chunk_key.h"

namespace sgm {

/// Counts by this process, since the source was opened.
struct BakedStats {
  uint64_t hits = 0, misses = 0;  ///< each call of get() counts as one of the two
  uint64_t damaged = 0;           ///< misses because the stored data was invalid
  uint64_t errors = 0;            ///< number of files that could not be read or were invalid
  uint64_t bytes = 0;             ///< compressed bytes read for hits
};

struct BakedPart {
  std::pmr::vector<std::byte> bytes;
  bool is_far = false;  ///< true: the part came from a server, so that it is worth storing in a disk cache
};

/// The keys under which stores may have the parts of a world.
struct BakedWorld {
  DiskKey key;
  /// Gives the key of worlds baked by version 0.2, which may take milliseconds; called only for stores that have
  /// nothing under `key`. Null: none.
  std::function<DiskKey()> former_key{};
};

/// Where get() searches: only on this machine (near), which takes the time of a disk access, or also on servers (far).
enum class Reach : uint8_t { near, far };

/// A read-only source of baked parts. Thread-safe.
class BakedParts {
 public:
  virtual ~BakedParts() = default;

  /// Returns the key that identifies a world. inputs: its bakedWorldInputs (chunk_part.h).
  virtual DiskKey worldOf(std::span<const std::byte> inputs) const = 0;

  /// Returns a baked part: the output of encodeChunkPart for that world without edits, in `memory`. A body of level 0
  /// has its anchors and voids; a seam leads to the next coarser level. Verified by a hash of all bytes. nullopt if the
  /// part is missing, unreadable or invalid. Throws std::bad_alloc.
  virtual std::optional<BakedPart> get(const BakedWorld& world, const ChunkKey& chunk, int part, Reach reach,
                                       std::pmr::memory_resource* memory) = 0;

  /// Call this if the result of get() with this reach was invalid. Counts a damaged miss instead of the hit; get() will
  /// not return that part again.
  virtual void reject(const BakedWorld& world, const ChunkKey& chunk, int part, Reach reach) = 0;

  /// True if some parts may be on servers: then searches take time, so a disk cache should be searched first. Never
  /// changes.
  virtual bool isFar() const = 0;

  /// Ends all waits for servers: from now on, calls may miss parts that exist.
  virtual void stop() noexcept = 0;

  virtual BakedStats stats() const = 0;
};

}  // namespace sgm
