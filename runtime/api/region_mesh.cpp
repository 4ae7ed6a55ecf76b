#include "api/region_mesh.h"

#include <cstdlib>

namespace sgm::api {
namespace {

constexpr int64_t kNear = int64_t{4096} * kUnitsPerMetre;

Int3 originFor(const IntBox& extent) {
  for (int axis = 0; axis < 3; ++axis) {
    if (std::abs(int64_t{extent.lo[axis]}) > kNear || std::abs(int64_t{extent.hi[axis]}) > kNear) return extent.lo;
  }
  return {};
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
  const ChunkGrid &first = chunks->front().grid, &last = chunks->back().grid;
  result.extent = {first.origin, last.origin};
  for (int axis = 0; axis < 3; ++axis) result.extent.hi[axis] += kChunkCells * last.cell;
  Result<WorldMesh> mesh = weld(parts, originFor(result.extent), world.memory());
  if (!mesh) return mesh.error();
  result.mesh = std::move(*mesh);
  return result;
}

}  // namespace sgm::api
