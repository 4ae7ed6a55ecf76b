#pragma once
// The units of baking: a region at some levels, divided into tiles of 8 x 8 x 8 chunks of a level.
//
// A tile is the unit of a worker, of a file and of a reader's first request. Its content depends only on the world, the
// region and the tile's place: so no byte of a store depends on which worker made it, or when.

#include <compare>
#include <vector>

#include "base/bytes.h"
#include "base/result.h"
#include "world/chunk_key.h"

namespace sgm::store {

inline constexpr int kTileEdge = 8;  ///< chunks
inline constexpr size_t kTileChunks = size_t{kTileEdge} * kTileEdge * kTileEdge;

/// The lowest chunk of tile (x, y, z) is (8x, 8y, 8z) of its level.
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

/// The faces of a chunk that may border a coarser one, bit (1 << Face): those on its parent's border. A sibling lies
/// across each other face. Only these seams are ever drawn or baked.
inline uint8_t seamsOf(const ChunkKey& chunk) {
  uint8_t faces = 0;
  for (int axis = 0; axis < 3; ++axis) faces = static_cast<uint8_t>(faces | 1 << (2 * axis + (chunk.at[axis] & 1)));
  return faces;
}
/// Whether a part of the chunk is baked. 0: its body, 1 + Face: a seam.
inline bool isBakedPart(const ChunkKey& chunk, int part) {
  return part == 0 || (seamsOf(chunk) >> (part - 1) & 1) != 0;
}

/// All chunks of these levels that meet the box lo <= p < hi.
struct BakedRegion {
  IntBox box;
  int first_level = 0, last_level = 0;
  int32_t finest_cell = 0;  ///< units
};

/// invalid_argument: invalid levels, an empty box, or an invalid cell. range: chunks leave the world. limit: more than
/// 2^22 tiles.
Result<void> check(const BakedRegion& region);
/// The region's tiles in order. Precondition of all three functions: check accepts the region.
std::vector<TileKey> tilesOf(const BakedRegion& region);
uint64_t countTiles(const BakedRegion& region);
/// Whether the chunk is one of the region's.
bool holds(const BakedRegion& region, const ChunkKey& chunk);
/// The tile's chunks that are in the region, as ascending numbers.
std::vector<size_t> chunksIn(const BakedRegion& region, const TileKey& tile);

void putRegion(const BakedRegion& region, ByteWriter& out);
BakedRegion getRegion(ByteReader& in);

}  // namespace sgm::store
