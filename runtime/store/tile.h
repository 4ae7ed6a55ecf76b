#pragma once
// What is baked, and in which pieces: a region at some levels, in tiles of 8 x 8 x 8 chunks of a level.
//
// A tile is what a worker makes, a file holds and a reader asks for first. What it comes to follows from the world, the
// region and the tile's place alone: so it matters to no byte of a store which worker made it, or when.

#include <compare>
#include <vector>

#include "base/bytes.h"
#include "base/result.h"
#include "world/chunk_key.h"

namespace sgm::store {

inline constexpr int kTileEdge = 8;  ///< chunks
inline constexpr size_t kTileChunks = size_t{kTileEdge} * kTileEdge * kTileEdge;

/// Tile (x, y, z) of a level has its lowest chunk at 8 times that.
struct TileKey {
  int level = 0;
  Int3 at;
  /// By level, z, y, x.
  friend constexpr std::strong_ordering operator<=>(const TileKey& a, const TileKey& b) {
    if (a.level != b.level) return a.level <=> b.level;
    if (a.at.z != b.at.z) return a.at.z <=> b.at.z;
    if (a.at.y != b.at.y) return a.at.y <=> b.at.y;
    return a.at.x <=> b.at.x;
  }
  friend constexpr bool operator==(const TileKey&, const TileKey&) = default;
};

inline TileKey tileOf(const ChunkKey& chunk) {
  return {chunk.level, {chunk.at.x >> 3, chunk.at.y >> 3, chunk.at.z >> 3}};
}
/// The chunk's number in its tile, x fastest.
inline size_t numberInTile(const ChunkKey& chunk) {
  return static_cast<size_t>((chunk.at.x & 7) + kTileEdge * ((chunk.at.y & 7) + kTileEdge * (chunk.at.z & 7)));
}
inline ChunkKey chunkOf(const TileKey& tile, size_t number) {
  const auto n = static_cast<int>(number);
  return {tile.level, {8 * tile.at.x + n % 8, 8 * tile.at.y + n / 8 % 8, 8 * tile.at.z + n / 64}};
}

/// Faces of a chunk across which a coarser one may lie, bit (1 << Face): those that are its parent's, too. Across the
/// others lies a sibling. No other seams are ever drawn, or baked.
inline uint8_t seamsOf(const ChunkKey& chunk) {
  uint8_t faces = 0;
  for (int axis = 0; axis < 3; ++axis) faces = static_cast<uint8_t>(faces | 1 << (2 * axis + (chunk.at[axis] & 1)));
  return faces;
}
/// Whether a part of it is baked: 0 its body, 1 + Face a seam.
inline bool isBakedPart(const ChunkKey& chunk, int part) {
  return part == 0 || (seamsOf(chunk) >> (part - 1) & 1) != 0;
}

/// All chunks of the levels that meet the box lo <= p < hi.
struct BakedRegion {
  IntBox box;
  int first_level = 0, last_level = 0;
  int32_t finest_cell = 0;  ///< units
};

/// invalid_argument: no such levels, an empty box, a cell that is none. range: chunks leave the world. limit: more than
/// 2^22 tiles.
Result<void> check(const BakedRegion& region);
/// In their order. Precondition of all three: check accepts the region.
std::vector<TileKey> tilesOf(const BakedRegion& region);
uint64_t countTiles(const BakedRegion& region);
/// Whether the chunk is one of the region's.
bool holds(const BakedRegion& region, const ChunkKey& chunk);
/// Numbers of the tile's chunks in the region, rising.
std::vector<size_t> chunksIn(const BakedRegion& region, const TileKey& tile);

void putRegion(const BakedRegion& region, ByteWriter& out);
BakedRegion getRegion(ByteReader& in);

}  // namespace sgm::store
