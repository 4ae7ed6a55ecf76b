#pragma once
// Which chunks around a viewer can be come to through the void, and how far that way is: what is near but behind rock
// can wait.

#include <array>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "backend/backend.h"
#include "mesh/void_components.h"
#include "world/chunk_key.h"

namespace sgm {

struct ReachedChunk {
  ChunkKey key;
  uint32_t steps = 0;  ///< faces between chunks on the shortest way through the void from the nearest viewer
  friend auto operator<=>(const ReachedChunk&, const ReachedChunk&) = default;
};

/// The voids of a level-0 chunk; null where it is not known yet. Asked about a chunk once a viewer at most.
using VoidLookup = std::function<const VoidComponents*(const ChunkKey&)>;

/// The level-0 chunks within `radius` units of a viewer that can be reached from it through the void of the chunks
/// within that radius, in the order of their keys. Whatever a viewer can see within the radius is among them: a
/// straight line to it leaves neither the void nor the ball.
///
/// A chunk that is not known yet is reached from its neighbours but leads nowhere, until it is known. A known one is
/// reached too where a void that was reached only touches it: the surface between is drawn from both sides. A viewer
/// with nothing but rock around (mesh/void_components.h: voidsAround) sees through all rock, so that none is ever
/// blind.
///
/// viewers: positions in units, finite. finest_cell: edge of a level-0 cell in units. Chunks that leave the world are
/// left out. A pure function. Work grows with the cube of radius / (32 * finest_cell), for each viewer.
std::vector<ReachedChunk> reachedChunks(std::span<const std::array<double, 3>> viewers, double radius,
                                        int32_t finest_cell, const VoidLookup& voids);

/// The steps to a chunk in what reachedChunks() gave; none where it is not reached.
std::optional<uint32_t> stepsTo(std::span<const ReachedChunk> reached, const ChunkKey& key);

}  // namespace sgm
