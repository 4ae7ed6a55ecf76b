#pragma once
// Many chunks of a world: derived and compiled on the job system, meshed by the backend.

#include <functional>
#include <span>

#include "mesh/feature_reach.h"
#include "mesh/hash.h"
#include "mesh/void_components.h"
#include "world/chunk_key.h"
#include "world/fitting_cell.h"
#include "world/world_field.h"

namespace sgm {

struct ChunkRequest {
  ChunkKey key;
  uint8_t seams = 0;          ///< bit (1 << Face)
  Neighbourhood coarser = 0;  ///< of the surrounding blocks; decides the fans in seam keys (mesh/fans.h)
  bool signs = false;         ///< also give the signs of the samples (ChunkMesh::signs)
  bool keys = true;           ///< false: parts may lack the keys that welding and checks need
  bool anchors = false;       ///< also give the anchors in the chunk
  bool body = true;           ///< false: only the seams, of a chunk whose body exists already
  bool resident = false;      ///< also leave the parts on the backend's device (ChunkJob::resident)
  bool prompt = false;        ///< do not wait for a device to be ready (ChunkJob::prompt)
  bool outermost = false;     ///< seams lead to virtual neighbours, whose field is the domain's own state (octree.h)
  bool sharp = false;         ///< with sharp features (sharpen_chunk.h)
  bool sums_only = false;     ///< compute the sums over the mesh instead of the mesh (ChunkJob::sums_only); not for
                              ///< sharp chunks

  friend bool operator==(const ChunkRequest&, const ChunkRequest&) = default;
};

/// A finished chunk and its grid.
struct PlacedChunk {
  ChunkKey key;
  ChunkGrid grid;
  ChunkMesh mesh;
  std::vector<Anchor> anchors;  ///< if requested; the chunk includes its low faces, but not its high ones
};

/// Appends the body and the seams that have triangles to a vector of PlacedPart, for welding, checking and hashing.
template <class Parts>
void appendParts(const PlacedChunk& chunk, Parts& parts) {
  if (!chunk.mesh.body.indices.empty()) parts.push_back({&chunk.mesh.body, chunk.grid, 0});
  for (size_t f = 0; f < chunk.mesh.seams.size(); ++f) {
    if (!chunk.mesh.seams[f].indices.empty()) {
      parts.push_back({&chunk.mesh.seams[f], chunk.grid, 1 + static_cast<int>(f)});
    }
  }
}

/// Called after every chunk; returning false cancels the work, except after the last chunk. Calls come from any thread,
/// but not concurrently, and `done` rises by one each time.
using Progress = std::function<bool(uint64_t done, uint64_t total)>;

/// The grid of a chunk. Errors: invalid_argument (no such level), range (not wholly inside the world).
Result<ChunkGrid> chunkGrid(const WorldField& world, const ChunkKey& key);

/// The closed box of the chunk, lo <= p <= hi. Precondition: chunkGrid gave the grid.
IntBox chunkBox(const ChunkGrid& grid);

/// The region in which the field of a level affects the chunk. level: the chunk's own, or the next, which seams read.
IntBox sampledBox(const ChunkGrid& grid, int level, bool sharp);

/// Returns one chunk for each request, in order, in the world's memory. edits: laid on the world, or null. Errors:
/// those of chunkGrid, derivation and compilation, out_of_memory, cancelled.
Result<std::pmr::vector<PlacedChunk>> meshChunks(const WorldField& world, Backend& backend, JobSystem& jobs,
                                                 std::span<const ChunkRequest> requests, const Progress& progress = {},
                                                 const EditSnapshot* edits = nullptr);

/// The voids of a meshed chunk. Precondition: its signs were requested.
VoidComponents voidsOf(const ChunkMesh& mesh);

/// All chunks of a level that meet the box lo <= p < hi, in order z, y, x, in the world's memory.
/// invalid_argument: no such level, or an empty box. range: a chunk leaves the world. limit: more than max_chunks, or
/// 2^24.
Result<std::pmr::vector<ChunkKey>> chunksOfRegion(const WorldField& world, const IntBox& region, int level,
                                                  uint64_t max_chunks);

}  // namespace sgm
