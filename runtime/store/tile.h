#pragma once
// Tiles, the units of baking: a region at several levels is divided into blocks of 8 x 8 x 8 chunks of one level.
//
// A worker bakes one tile at a time, and writes one file per tile; a reader loads a tile's record before its chunks. A
// tile's content depends only on the world, the region and the tile's position. So the bytes of a store do not depend
// on which worker baked a tile, or when.

#include <compare>
#include <vector>

#include "base/bytes.h"
#include "base/result.h"
#include "world/chunk_key.h"

namespace sgm::store {

inline constexpr int kTileEdge = 8;  ///< edge of a tile in chunks
inline constexpr size_t kTileChunks = size_t{kTileEdge} * kTileEdge * kTileEdge;

/// The level and position of a tile: the lowest chunk of tile (x, y, z) is chunk (8x, 8y, 8z) of its level.
struct TileKey {
  int level = 0;
  Int3 at;
  /// Sorts tiles by level, then by z, y and x.
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
/// Returns the index of the chunk in its tile, 0..511; x varies fastest.
inline size_t numberInTile(const ChunkKey& chunk) {
  return static_cast<size_t>((chunk.at.x & 7) + kTileEdge * ((chunk.at.y & 7) + kTileEdge * (chunk.at.z & 7)));
}
inline ChunkKey chunkOf(const TileKey& tile, size_t number) {
  const auto n = static_cast<int>(number);
  return {tile.level, {8 * tile.at.x + n % 8, 8 * tile.at.y + n / 8 % 8, 8 * tile.at.z + n / 64}};
}

/// Returns the faces at which a chunk may border a coarser chunk, as bits (1 << Face). These are the three faces that
/// lie in the border of the chunk's parent. Behind the other three faces lie siblings, which have the same level. No
/// other seams can ever be drawn, so only the seams at these faces are baked.
inline uint8_t seamsOf(const ChunkKey& chunk) {
  uint8_t faces = 0;
  for (int axis = 0; axis < 3; ++axis) faces = static_cast<uint8_t>(faces | 1 << (2 * axis + (chunk.at[axis] & 1)));
  return faces;
}
/// True if this part of the chunk is baked. part: 0 for the body, 1 + Face for a seam.
inline bool isBakedPart(const ChunkKey& chunk, int part) {
  return part == 0 || (seamsOf(chunk) >> (part - 1) & 1) != 0;
}

/// A region to be baked: at each of these levels, all chunks that intersect the box lo <= p < hi.
struct BakedRegion {
  IntBox box;
  int first_level = 0, last_level = 0;
  int32_t finest_cell = 0;  ///< edge length of a cell of level 0, in units
};

/// Checks a region. Errors: invalid_argument if the levels or the cell size are invalid, or the box is empty; range if
/// chunks leave the world; limit if there are more than 2^22 tiles.
Result<void> check(const BakedRegion& region);
/// Returns the region's tiles, sorted. Precondition of this and the next three functions: check() accepts the region.
std::vector<TileKey> tilesOf(const BakedRegion& region);
uint64_t countTiles(const BakedRegion& region);
/// True if the chunk belongs to the region.
bool holds(const BakedRegion& region, const ChunkKey& chunk);
/// Returns the indices within the tile, ascending, of its chunks that belong to the region.
std::vector<size_t> chunksIn(const BakedRegion& region, const TileKey& tile);

void putRegion(const BakedRegion& region, ByteWriter& out);
BakedRegion getRegion(ByteReader& in);

}  // namespace sgm::store
