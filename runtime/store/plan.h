#pragma once
// Distributes tiles over workers, so that all take about equally long.

#include <filesystem>
#include <span>

#include "store/bake.h"

namespace sgm::store {

/// Estimates each tile's cost in microseconds of one thread of this machine, in the order of tilesOf. It counts derived
/// content, since a tile of only rock takes a hundredth of the time of one full of surface. Reads the plan from the
/// job's folder, or makes it and writes it there. Errors: those of derivation; io. Throws std::bad_alloc.
Result<std::vector<uint64_t>> planOf(const Bakery& bakery, std::span<const TileKey> tiles,
                                     const Progress& progress = {});

/// The tiles of worker `shard` of `shards`, as a range of indices: the first, and one past the last. Each tile belongs
/// to exactly one shard; a shard's tiles are neighbours, so that little is derived twice. Precondition: shard < shards.
std::pair<size_t, size_t> tilesOfShard(std::span<const uint64_t> costs, size_t shard, size_t shards);

}  // namespace sgm::store
