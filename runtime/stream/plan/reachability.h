#pragma once
// Finds the chunks around a viewer that can be reached through the void, and the number of steps to each. Chunks that
// are near but behind rock are less urgent.

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
  /// number of chunk faces that the shortest path through the void, from the nearest viewer, crosses
  uint32_t steps = 0;
  friend auto operator<=>(const ReachedChunk&, const ReachedChunk&) = default;
};

/// Returns the void components of a level-0 chunk; null if they are unknown. Called at most once per chunk and viewer.
using VoidLookup = std::function<const VoidComponents*(const ChunkKey&)>;

/// Returns the level-0 chunks within `radius` units of a viewer that can be reached from the viewer through the void of
/// chunks within that radius, sorted by key. They include everything that is visible from the viewer within the radius,
/// since a straight line of sight leaves neither the void nor the ball.
///
/// A chunk with unknown voids counts as reached from its neighbours, but the search does not continue through it. A
/// chunk with known voids also counts as reached if a reached void only touches it, because the surface between the two
/// is visible. If a viewer has only rock around it (voidsAround in mesh/void_components.h), rock counts as void for
/// this viewer, so that it still gets chunks. viewers: positions in units, finite. finest_cell: edge of a level-0 cell
/// in units. Chunks that extend beyond the world are omitted. A pure function. Its work grows with the cube of radius /
/// (32 * finest_cell) for each viewer.
std::vector<ReachedChunk> reachedChunks(std::span<const std::array<double, 3>> viewers, double radius,
                                        int32_t finest_cell, const VoidLookup& voids);

/// Looks up the number of steps to a chunk in a result of reachedChunks(); nullopt if the chunk is not reached.
std::optional<uint32_t> stepsTo(std::span<const ReachedChunk> reached, const ChunkKey& key);

}  // namespace sgm
