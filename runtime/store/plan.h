#pragma once
// Which worker makes which tiles, so that all take about as long.

#include <filesystem>
#include <span>

#include "store/bake.h"

namespace sgm::store {

/// What each tile is estimated to cost, in the order of tilesOf, in microseconds of one thread here: from what is
/// derived there, since a tile of nothing but rock takes a hundredth of one full of surface. Read from the job's folder
/// where it was made before, else made and written there. Errors: those of derivation; io. Throws std::bad_alloc.
Result<std::vector<uint64_t>> planOf(const Bakery& bakery, std::span<const TileKey> tiles,
                                     const Progress& progress = {});

/// The tiles of worker `shard` of `shards`, as a range of numbers: first, and one behind the last. Together the shards
/// have each tile once; each has neighbours, so that little is derived twice. Precondition: shard < shards.
std::pair<size_t, size_t> tilesOfShard(std::span<const uint64_t> costs, size_t shard, size_t shards);

}  // namespace sgm::store
