#pragma once
// Finds the chunks around a viewer that can be reached through the void, and the lengths of the paths: near chunks
// behind rock can wait.

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
  uint32_t steps = 0;  ///< faces between chunks on the shortest path through the void from the nearest viewer
  friend auto operator<=>(const ReachedChunk&, const ReachedChunk&) = default;
};

/// Returns the voids of a level-0 chunk; null if they are unknown. Called at most once a chunk and viewer.
using VoidLookup = std::function<const VoidComponents*(const ChunkKey&)>;

/// The level-0 chunks within `radius` units of a viewer that can be reached from it through the void of the chunks
/// within that radius, by key. They include everything visible from the viewer within the radius, since a straight line
/// of sight leaves neither the void nor the ball.
///
/// An unknown chunk is reached from its neighbours but leads nowhere until it is known. A known chunk is also reached
/// if a reached void only touches it: the surface between is drawn from both sides. A viewer with only rock around it
/// (mesh/void_components.h: voidsAround) sees through all rock, so that no viewer is blind.
///
/// viewers: positions in units, finite. finest_cell: edge of a level-0 cell in units. Chunks that leave the world are
/// omitted. A pure function. Work grows with the cube of radius / (32 * finest_cell) for each viewer.
std::vector<ReachedChunk> reachedChunks(std::span<const std::array<double, 3>> viewers, double radius,
                                        int32_t finest_cell, const VoidLookup& voids);

/// The steps to a chunk in a result of reachedChunks(); nullopt if it is not reached.
std::optional<uint32_t> stepsTo(std::span<const ReachedChunk> reached, const ChunkKey& key);

}  // namespace sgm
