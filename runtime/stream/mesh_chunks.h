#pragma once
// Many chunks of a world: derived and compiled on the job system, meshed by the backend.

#include <functional>
#include <span>

#include "mesh/hash.h"
#include "stream/world_field.h"

namespace sgm {

inline constexpr int kMaxLevel = 16;

/// Chunk (x, y, z) of a level has its lowest corner at that times 32 cells of the level.
struct ChunkKey {
  int level = 0;
  Int3 at;
  friend auto operator<=>(const ChunkKey&, const ChunkKey&) = default;
};

struct ChunkRequest {
  ChunkKey key;
  uint8_t seams = 0;          ///< bit (1 << Face)
  Neighbourhood coarser = 0;  ///< of the blocks around; decides the fans in seam keys (mesh/fans.h)
};

/// A finished chunk and where it lies.
struct PlacedChunk {
  ChunkKey key;
  ChunkGrid grid;
  ChunkMesh mesh;
};

/// Appends the body and the seams that have triangles, as parts for welding, checking and hashing.
void appendParts(const PlacedChunk& chunk, std::vector<PlacedPart>& parts);

/// Says how far the work is; false stops it. One call at a time, from any thread.
using Progress = std::function<bool(uint64_t done, uint64_t total)>;

/// The grid of a chunk. invalid_argument: no such level, or the chunk does not lie wholly inside the world.
Result<ChunkGrid> chunkGrid(const WorldField& world, const ChunkKey& key);

/// One mesh a request, in order. Errors: those of derivation and compilation, out_of_memory, cancelled.
Result<std::vector<PlacedChunk>> meshChunks(const WorldField& world, Backend& backend, JobSystem& jobs,
                                            std::span<const ChunkRequest> requests, const Progress& progress = {});

/// All chunks of a level that meet the box lo <= p < hi, in order z, y, x.
/// invalid_argument: they leave the world. limit: more than max_chunks.
Result<std::vector<ChunkKey>> chunksOfRegion(const WorldField& world, const IntBox& region, int level,
                                             uint64_t max_chunks);

}  // namespace sgm
