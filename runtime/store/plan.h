#pragma once
// Distributes tiles among workers so that all of them take about equally long.

#include <filesystem>
#include <span>

#include "store/bake.h"

namespace sgm::store {

/// Returns the estimated cost of each tile, in microseconds of one thread of this machine, in the order of tilesOf.
/// Estimates need derived content, since a tile that consists of rock takes a hundredth of the time of a tile full of
/// surface. Reads the estimates from the job's folder, or makes them and writes them there. Errors: those of
/// derivation; io. Throws std::bad_alloc.
Result<std::vector<uint64_t>> planOf(const Bakery& bakery, std::span<const TileKey> tiles,
                                     const Progress& progress = {});

/// Returns the tiles of worker `shard` of `shards` workers, as a range of indices: the first, and one past the last.
/// Each tile belongs to exactly one shard. The tiles of a shard are near each other, so that few cells are derived by
/// several workers. Precondition: shard < shards.
std::pair<size_t, size_t> tilesOfShard(std::span<const uint64_t> costs, size_t shard, size_t shards);

}  // namespace sgm::store
