#pragma once
// Meshes many chunks of a world. Jobs on the CPU derive the cells around each chunk and compile its field programs; the
// backend meshes the chunks.

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
  uint8_t seams = 0;  ///< the requested seams: bit (1 << Face)
  /// the blocks around the chunk that belong to coarser levels: the keys of a seam's vertices depend on them
  /// (mesh/fans.h)
  Neighbourhood coarser = 0;
  bool signs = false;     ///< true: also return the signs of the samples (ChunkMesh::signs)
  bool keys = true;       ///< true: return the vertex keys that welding and checks need; false: keys may be missing
  bool anchors = false;   ///< true: also return the anchors in the chunk
  bool body = true;       ///< true: mesh the body; false: only the seams, because the body exists already
  bool resident = false;  ///< true: also keep the parts on the backend's device (ChunkJob::resident)
  bool prompt = false;    ///< true: do not wait until a device is ready (ChunkJob::prompt)
  /// true: the chunk lies at the border of the meshed world, so its seams lead to virtual neighbours (octree.h); these
  /// are entirely solid if the domain is solid, and void otherwise
  bool outermost = false;
  bool sharp = false;  ///< true: sharpen the edges and corners of the mesh (sharpen_chunk.h)
  /// true: compute only the sums over the mesh, without the mesh (ChunkJob::sums_only); not possible for sharp chunks
  bool sums_only = false;

  friend bool operator==(const ChunkRequest&, const ChunkRequest&) = default;
};

/// A finished chunk and its grid.
struct PlacedChunk {
  ChunkKey key;
  ChunkGrid grid;
  ChunkMesh mesh;
  /// anchors in the chunk, if requested; includes those in its low faces, but not those in its high faces
  std::vector<Anchor> anchors;
};

/// Appends the body and the seams that have triangles to `parts`, a vector of PlacedPart, for welding, checks and
/// hashes.
template <class Parts>
void appendParts(const PlacedChunk& chunk, Parts& parts) {
  if (!chunk.mesh.body.indices.empty()) parts.push_back({&chunk.mesh.body, chunk.grid, 0});
  for (size_t f = 0; f < chunk.mesh.seams.size(); ++f) {
    if (!chunk.mesh.seams[f].indices.empty()) {
      parts.push_back({&chunk.mesh.seams[f], chunk.grid, 1 + static_cast<int>(f)});
    }
  }
}

/// A function that is called after every chunk. Returning false cancels the work, except after the last chunk. Calls
/// come from any thread, but never concurrently, and `done` increases by one each time.
using Progress = std::function<bool(uint64_t done, uint64_t total)>;

/// Returns the grid of a chunk. Errors: invalid_argument (the level does not exist); range (the chunk is not wholly
/// inside the world).
Result<ChunkGrid> chunkGrid(const WorldField& world, const ChunkKey& key);

/// Returns the closed box of the chunk, lo <= p <= hi. Precondition: chunkGrid() has accepted the chunk.
IntBox chunkBox(const ChunkGrid& grid);

/// Returns the region in which the field of a level affects the chunk. level: the chunk's own level, or the next
/// coarser one, which seams sample.
IntBox sampledBox(const ChunkGrid& grid, int level, bool sharp);

/// Meshes one chunk for each request, and returns them in order, in the world's memory. edits: brushes on top of the
/// world, or null. Errors: those of chunkGrid, derivation and compilation; out_of_memory; cancelled.
Result<std::pmr::vector<PlacedChunk>> meshChunks(const WorldField& world, Backend& backend, JobSystem& jobs,
                                                 std::span<const ChunkRequest> requests, const Progress& progress = {},
                                                 const EditSnapshot* edits = nullptr);

/// Returns the voids of a meshed chunk. Precondition: its signs were requested.
VoidComponents voidsOf(const ChunkMesh& mesh);

/// Returns all chunks of a level that meet the box lo <= p < hi, in order z, y, x, in the world's memory. Errors:
/// invalid_argument (the level does not exist, or the box is empty); range (a chunk leaves the world); limit (more than
/// max_chunks chunks, or 2^24).
Result<std::pmr::vector<ChunkKey>> chunksOfRegion(const WorldField& world, const IntBox& region, int level,
                                                  uint64_t max_chunks);

}  // namespace sgm
