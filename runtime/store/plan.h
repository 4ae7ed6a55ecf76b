#pragma once
// Distributes tiles among workers so that all workers take about equally long.

#include <filesystem>
#include <span>

#include "store/bake.h"

namespace sgm::store {

/// Returns the estimated cost of each tile, in microseconds of one thread of this machine, in the order of `tiles`.
/// Estimating requires derivation of the world, since a tile of solid rock takes a hundredth of the time of a tile full
/// of surface. The estimates are cached in a file in the job's folder. Errors: those of derivation; io. Throws
/// std::bad_alloc.
Result<std::vector<uint64_t>> planOf(const Bakery& bakery, std::span<const TileKey> tiles,
                                     const Progress& progress = {});

/// Returns the tiles of worker `shard` of `shards` workers, as a range of indices: the first, and one past the last.
/// Each tile belongs to exactly one shard. A shard's tiles are close to each other, so that few cells of the world are
/// derived by several workers. Precondition: shard < shards.
std::pair<size_t, size_t> tilesOfShard(std::span<const uint64_t> costs, size_t shard, size_t shards);

}  // namespace sgm::store
