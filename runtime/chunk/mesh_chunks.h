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
  Neighbourhood coarser = 0;  ///< of the blocks around; decides the fans in seam keys (mesh/fans.h)
  bool signs = false;         ///< also give the signs of the samples (ChunkMesh::signs)
  bool keys = true;           ///< false: parts may be without their keys, which welding and checks ask for
  bool anchors = false;       ///< also give the anchors in the chunk
  bool body = true;           ///< false: seams alone, of a chunk whose body is there already
  bool resident = false;      ///< also leave the parts on the backend's device (ChunkJob::resident)
  bool prompt = false;        ///< do not wait for a device to be ready (ChunkJob::prompt)
  bool outermost = false;     ///< seams lead to virtual neighbours, whose field is the domain's own state (octree.h)
  bool sharp = false;         ///< with sharp features (sharpen_chunk.h)
  bool sums_only = false;     ///< in place of the mesh the sums over it (ChunkJob::sums_only); not of sharp chunks

  friend bool operator==(const ChunkRequest&, const ChunkRequest&) = default;
};

/// A finished chunk and where it lies.
struct PlacedChunk {
  ChunkKey key;
  ChunkGrid grid;
  ChunkMesh mesh;
  std::vector<Anchor> anchors;  ///< where asked for; the chunk's low faces belong to it, its high ones do not
};

/// Appends the body and the seams that have triangles, as parts for welding, checking and hashing, to a vector of
/// PlacedPart.
template <class Parts>
void appendParts(const PlacedChunk& chunk, Parts& parts) {
  if (!chunk.mesh.body.indices.empty()) parts.push_back({&chunk.mesh.body, chunk.grid, 0});
  for (size_t f = 0; f < chunk.mesh.seams.size(); ++f) {
    if (!chunk.mesh.seams[f].indices.empty()) {
      parts.push_back({&chunk.mesh.seams[f], chunk.grid, 1 + static_cast<int>(f)});
    }
  }
}

/// Says how far the work is, after every chunk; false stops it, but after the last one, when nothing is left to stop.
/// One call at a time, with `done` rising by one, from any thread.
using Progress = std::function<bool(uint64_t done, uint64_t total)>;

/// The grid of a chunk. Errors: invalid_argument (no such level), range (it does not lie wholly inside the world).
Result<ChunkGrid> chunkGrid(const WorldField& world, const ChunkKey& key);

/// The chunk with its borders: lo <= p <= hi. Precondition: chunkGrid gave the grid.
IntBox chunkBox(const ChunkGrid& grid);

/// Where the field of a level decides what becomes of a chunk: its own, or the one above, which its seams read.
IntBox sampledBox(const ChunkGrid& grid, int level, bool sharp);

/// One mesh a request, in order, in the world's memory. edits: laid on the world, or null. Errors: those of chunkGrid,
/// derivation and compilation, out_of_memory, cancelled.
Result<std::pmr::vector<PlacedChunk>> meshChunks(const WorldField& world, Backend& backend, JobSystem& jobs,
                                                 std::span<const ChunkRequest> requests, const Progress& progress = {},
                                                 const EditSnapshot* edits = nullptr);

/// The voids of a meshed chunk. Precondition: its signs were asked for.
VoidComponents voidsOf(const ChunkMesh& mesh);

/// All chunks of a level that meet the box lo <= p < hi, in order z, y, x, in the world's memory.
/// invalid_argument: no such level, an empty box. range: they leave the world. limit: more than max_chunks, or 2^24.
Result<std::pmr::vector<ChunkKey>> chunksOfRegion(const WorldField& world, const IntBox& region, int level,
                                                  uint64_t max_chunks);

}  // namespace sgm
