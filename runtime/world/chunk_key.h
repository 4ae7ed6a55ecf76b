#pragma once
// Identifies a chunk by its level and its position among the chunks of that level.

#include "base/fixed.h"
#include "base/hash.h"

namespace sgm {

inline constexpr int kMaxLevel = 16;

/// The lowest corner of chunk (x, y, z) lies at (x, y, z) * 32 cells of its level.
struct ChunkKey {
  int level = 0;
  Int3 at;
  friend auto operator<=>(const ChunkKey&, const ChunkKey&) = default;
};

/// A hash function for unordered containers. No result may depend on the order of such a container.
struct ChunkKeyHash {
  size_t operator()(const ChunkKey& key) const {
    const auto bits = [](int v) { return uint64_t{static_cast<uint32_t>(v)}; };
    const uint64_t low = bits(key.at.x) | bits(key.at.y) << 32, high = bits(key.at.z) | bits(key.level) << 32;
    return static_cast<size_t>(mix64(low * 0x9E3779B97F4A7C15u + high));
  }
};

/// Returns the chunk of the next coarser level that contains this chunk.
inline ChunkKey parentOf(const ChunkKey& key) { return {key.level + 1, {key.at.x >> 1, key.at.y >> 1, key.at.z >> 1}}; }

/// Returns one of the eight chunks one level finer within this chunk: bits 0, 1, 2 of `index` select the upper half in
/// x, y, z.
inline ChunkKey childOf(const ChunkKey& key, int index) {
  return {key.level - 1,
          {2 * key.at.x + (index & 1), 2 * key.at.y + (index >> 1 & 1), 2 * key.at.z + (index >> 2 & 1)}};
}

/// Returns the chunk of the same level that lies (dx, dy, dz) chunks away.
inline ChunkKey neighbourOf(const ChunkKey& key, int dx, int dy, int dz) {
  return {key.level, {key.at.x + dx, key.at.y + dy, key.at.z + dz}};
}

/// True if `inner` lies in `outer` or equals it.
inline bool holds(const ChunkKey& outer, const ChunkKey& inner) {
  const int down = outer.level - inner.level;
  return down >= 0 && Int3{inner.at.x >> down, inner.at.y >> down, inner.at.z >> down} == outer.at;
}

}  // namespace sgm
