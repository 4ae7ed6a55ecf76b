#include "region/region_mesh.h"

#include <cstdlib>
#include <string>

#include "stream/plan/chunk_set.h"
#include "stream/plan/frame.h"

namespace sgm {
namespace {

constexpr int64_t kNear = int64_t{4096} * kUnitsPerMetre;

Int3 originFor(const IntBox& extent) {
  for (int axis = 0; axis < 3; ++axis) {
    if (std::abs(int64_t{extent.lo[axis]}) > kNear || std::abs(int64_t{extent.hi[axis]}) > kNear) return extent.lo;
  }
  return {};
}

/// Meshes the requests of a region. keys: the region's chunks at the coarsest level, in order z, y, x.
Result<RegionMesh> meshRequests(const WorldField& world, Backend& backend, JobSystem& jobs,
                                std::span<const ChunkKey> keys, std::span<const ChunkRequest> requests,
                                const Progress& progress) {
  const Result<std::pmr::vector<PlacedChunk>> chunks = meshChunks(world, backend, jobs, requests, progress);
  if (!chunks) return chunks.error();
  RegionMesh result(world.memory());
  result.chunks = chunks->size();
  std::pmr::vector<PlacedPart> parts(world.memory());
  for (const PlacedChunk& chunk : *chunks) {
    appendParts(chunk, parts);
    result.solid_samples += chunk.mesh.solid_samples;
    result.rounded += chunk.mesh.rounded;
  }
  result.hash = hashParts(parts);
  const Result<ChunkGrid> first = chunkGrid(world, keys.front()), last = chunkGrid(world, keys.back());
  if (!first) return first.error();
  if (!last) return last.error();
  result.extent = {first->origin, last->origin};
  for (int axis = 0; axis < 3; ++axis) result.extent.hi[axis] += kChunkCells * last->cell;
  Result<WorldMesh> mesh = weld(parts, originFor(result.extent), world.memory());
  if (!mesh) return mesh.error();
  result.mesh = std::move(*mesh);
  return result;
}

}  // namespace

Result<RegionMesh> meshRegion(const WorldField& world, Backend& backend, JobSystem& jobs, const IntBox& region,
                              int level, uint64_t max_chunks, bool sharp, const Progress& progress) {
  const Result<std::pmr::vector<ChunkKey>> keys = chunksOfRegion(world, region, level, max_chunks);
  if (!keys) return keys.error();
  std::pmr::vector<ChunkRequest> requests(world.memory());
  requests.reserve(keys->size());
  for (const ChunkKey& key : *keys) {
    requests.push_back({key, 0, Neighbourhood{}});
    requests.back().sharp = sharp;
  }
  return meshRequests(world, backend, jobs, *keys, requests, progress);
}

Result<RegionMesh> meshRegion(const WorldField& world, Backend& backend, JobSystem& jobs, const IntBox& region,
                              const Octree& tree, uint64_t max_chunks, bool sharp, const Progress& progress) {
  const Result<std::pmr::vector<ChunkKey>> keys = chunksOfRegion(world, region, tree.top(), max_chunks);
  if (!keys) return keys.error();
  ChunkSet coarsest;
  for (const ChunkKey& key : *keys) coarsest.insert(key);
  std::pmr::vector<ChunkRequest> requests(world.memory());
  for (ChunkRequest& request : frameRequests(tree)) {
    ChunkKey root = request.key;
    while (root.level < tree.top()) root = parentOf(root);
    if (!coarsest.contains(root)) continue;
    // The surface stays open at the region's border, which cuts it. So the outermost chunks get no seam to the virtual
    // neighbours beyond.
    if (request.outermost) request = {request.key, 0, Neighbourhood{}};
    request.sharp = sharp;
    requests.push_back(request);
  }
  if (requests.size() > max_chunks) {
    return Error{Code::limit, std::to_string(requests.size()) + " chunks of all levels are more than " +
                                  std::to_string(max_chunks) + ": use larger cells or a smaller region"};
  }
  return meshRequests(world, backend, jobs, *keys, requests, progress);
}

}  // namespace sgm
