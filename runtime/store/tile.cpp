#include "store/tile.h"

#include <algorithm>
#include <array>
#include <limits>
#include <string>

#include "mesh/chunk.h"

namespace sgm::store {
namespace {

constexpr uint64_t kMaxTiles = uint64_t{1} << 22;

int64_t floorOf(int64_t a, int64_t b) { return a / b - (a % b < 0); }

/// The numbers of the first and the last chunk of a region, along one axis at one level.
struct Span {
  int64_t first, last;
  int64_t count(int64_t in) const { return floorOf(last, in) - floorOf(first, in) + 1; }
};
Span chunksOn(const BakedRegion& region, int level, int axis) {
  const int64_t edge = (int64_t{kChunkCells} * region.finest_cell) << level;
  return {floorOf(region.box.lo[axis], edge), floorOf(int64_t{region.box.hi[axis]} - 1, edge)};
}

}  // namespace

Result<void> check(const BakedRegion& region) {
  if (region.first_level < 0 || region.last_level > kMaxLevel || region.first_level > region.last_level)
    return Error{Code::invalid_argument,
                 "levels must be between 0 and " + std::to_string(kMaxLevel) + ", the finest first"};
  if (region.finest_cell < 1) return Error{Code::invalid_argument, "a cell must be at least one unit wide"};
  for (int level = region.first_level; level <= region.last_level; ++level) {
    const int64_t edge = (int64_t{kChunkCells} * region.finest_cell) << level;
    for (int axis = 0; axis < 3; ++axis) {
      if (region.box.lo[axis] >= region.box.hi[axis])
        return Error{Code::invalid_argument, "the region is empty: its first corner must lie below its second"};
      const Span span = chunksOn(region, level, axis);
      if (span.first * edge < std::numeric_limits<int32_t>::min() ||
          (span.last + 1) * edge > std::numeric_limits<int32_t>::max())
        return Error{Code::range, "the region's chunks of level " + std::to_string(level) +
                                      " leave the world, which ends about 2,097 km from the origin"};
    }
  }
  if (countTiles(region) > kMaxTiles)
    return Error{Code::limit, "the region has more than " + std::to_string(kMaxTiles) +
                                  " tiles of 8 x 8 x 8 chunks: bake it in parts, or with larger cells"};
  return {};
}

uint64_t countTiles(const BakedRegion& region) {
  uint64_t tiles = 0;
  for (int level = region.first_level; level <= region.last_level; ++level) {
    uint64_t of_level = 1;
    for (int axis = 0; axis < 3; ++axis)
      of_level =
          std::min(of_level * static_cast<uint64_t>(chunksOn(region, level, axis).count(kTileEdge)), kMaxTiles + 1);
    tiles += of_level;
  }
  return tiles;
}

std::vector<TileKey> tilesOf(const BakedRegion& region) {
  std::vector<TileKey> tiles;
  for (int level = region.first_level; level <= region.last_level; ++level) {
    std::array<int, 3> first{}, last{};
    for (int axis = 0; axis < 3; ++axis) {
      const Span span = chunksOn(region, level, axis);
      first[static_cast<size_t>(axis)] = static_cast<int>(floorOf(span.first, kTileEdge));
      last[static_cast<size_t>(axis)] = static_cast<int>(floorOf(span.last, kTileEdge));
    }
    for (int z = first[2]; z <= last[2]; ++z) {
      for (int y = first[1]; y <= last[1]; ++y) {
        for (int x = first[0]; x <= last[0]; ++x) tiles.push_back({level, {x, y, z}});
      }
    }
  }
  return tiles;
}

std::vector<size_t> chunksIn(const BakedRegion& region, const TileKey& tile) {
  std::array<Span, 3> spans{};
  for (int axis = 0; axis < 3; ++axis) spans[static_cast<size_t>(axis)] = chunksOn(region, tile.level, axis);
  std::vector<size_t> numbers;
  for (size_t number = 0; number < kTileChunks; ++number) {
    const ChunkKey chunk = chunkOf(tile, number);
    bool inside = true;
    for (int axis = 0; axis < 3; ++axis) {
      const Span& span = spans[static_cast<size_t>(axis)];
      inside = inside && chunk.at[axis] >= span.first && chunk.at[axis] <= span.last;
    }
    if (inside) numbers.push_back(number);
  }
  return numbers;
}

bool holds(const BakedRegion& region, const ChunkKey& chunk) {
  if (chunk.level < region.first_level || chunk.level > region.last_level) return false;
  for (int axis = 0; axis < 3; ++axis) {
    const Span span = chunksOn(region, chunk.level, axis);
    if (chunk.at[axis] < span.first || chunk.at[axis] > span.last) return false;
  }
  return true;
}

void putRegion(const BakedRegion& region, ByteWriter& out) {
  for (const Int3 corner : {region.box.lo, region.box.hi}) {
    for (int axis = 0; axis < 3; ++axis) out.put(corner[axis]);
  }
  out.put(int32_t{region.first_level});
  out.put(int32_t{region.last_level});
  out.put(region.finest_cell);
}

BakedRegion getRegion(ByteReader& in) {
  BakedRegion region;
  for (Int3* corner : {&region.box.lo, &region.box.hi}) {
    for (int axis = 0; axis < 3; ++axis) (*corner)[axis] = in.get<int32_t>();
  }
  region.first_level = in.get<int32_t>();
  region.last_level = in.get<int32_t>();
  region.finest_cell = in.get<int32_t>();
  return region;
}

}  // namespace sgm::store
