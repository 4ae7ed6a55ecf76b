#include "stream/mesh_chunks.h"

#include <algorithm>
#include <atomic>
#include <mutex>

namespace sgm {

namespace {

// Enough to keep every thread busy, few enough that the programs of a batch stay in cache and memory.
constexpr size_t kBatchChunks = 64;

IntBox closedBox(const ChunkGrid& grid) {
  IntBox box{grid.origin, grid.origin};
  for (int axis = 0; axis < 3; ++axis) box.hi[axis] += kChunkCells * grid.cell;
  return box;
}

Result<ChunkJob> makeJob(const WorldField& world, const ChunkRequest& request) {
  Result<ChunkGrid> grid = chunkGrid(world, request.key);
  if (!grid) return grid.error();
  ChunkJob job;
  job.grid = *grid;
  job.seams = request.seams;
  job.coarser = request.coarser;
  Result<std::shared_ptr<const FieldProgram>> field = world.compile(closedBox(*grid), request.key.level);
  if (!field) return field.error();
  job.field = std::move(*field);
  if (request.seams == 0) return job;
  Result<std::shared_ptr<const FieldProgram>> coarse = world.compile(closedBox(*grid), request.key.level + 1);
  if (!coarse) return coarse.error();
  job.coarse = std::move(*coarse);
  return job;
}

}  // namespace

void appendParts(const PlacedChunk& chunk, std::vector<PlacedPart>& parts) {
  if (!chunk.mesh.body.indices.empty()) parts.push_back({&chunk.mesh.body, chunk.grid, 0});
  for (size_t f = 0; f < chunk.mesh.seams.size(); ++f) {
    if (!chunk.mesh.seams[f].indices.empty()) {
      parts.push_back({&chunk.mesh.seams[f], chunk.grid, 1 + static_cast<int>(f)});
    }
  }
}

Result<ChunkGrid> chunkGrid(const WorldField& world, const ChunkKey& key) {
  if (key.level < 0 || key.level > kMaxLevel) {
    return Error{Code::invalid_argument, "a chunk's level lies between 0 and " + std::to_string(kMaxLevel)};
  }
  const int64_t cell = int64_t{world.settings().finest_cell} << key.level;
  const int64_t edge = kChunkCells * cell;
  ChunkGrid grid;
  grid.level = key.level;
  for (int axis = 0; axis < 3; ++axis) {
    const int64_t lo = key.at[axis] * edge;
    if (lo < INT32_MIN || lo + edge > INT32_MAX) {
      return Error{Code::invalid_argument, "the chunk leaves the world, which ends about 2,097 km from the origin"};
    }
    grid.origin[axis] = static_cast<int32_t>(lo);
  }
  grid.cell = static_cast<int32_t>(cell);
  return grid;
}

Result<std::vector<PlacedChunk>> meshChunks(const WorldField& world, Backend& backend, JobSystem& jobs,
                                            std::span<const ChunkRequest> requests, const Progress& progress) {
  std::vector<PlacedChunk> chunks;
  chunks.reserve(requests.size());
  for (size_t first = 0; first < requests.size(); first += kBatchChunks) {
    const auto batch = requests.subspan(first, std::min(kBatchChunks, requests.size() - first));
    std::vector<ChunkJob> chunk_jobs(batch.size());
    std::mutex mutex;
    std::optional<Error> error;
    size_t error_at = 0;
    parallelFor(jobs, batch.size(), [&](size_t i) {
      Result<ChunkJob> job = makeJob(world, batch[i]);
      if (job) {
        chunk_jobs[i] = std::move(*job);
        return;
      }
      // Of several the first request's error, whichever thread was faster.
      std::lock_guard lock(mutex);
      if (!error || i < error_at) {
        error = job.error();
        error_at = i;
      }
    });
    if (error) return *error;

    for (const ChunkJob& job : chunk_jobs) {
      chunks.push_back({batch[chunks.size() - first].key, job.grid, ChunkMesh(world.memory())});
    }
    Result<std::unique_ptr<ChunkBatch>> submitted = backend.submit(std::move(chunk_jobs));
    if (!submitted) return submitted.error();
    (*submitted)->wait();
    Result<std::vector<ChunkMesh>> meshes = (*submitted)->take();
    if (!meshes) return meshes.error();
    for (size_t i = 0; i < meshes->size(); ++i) chunks[first + i].mesh = std::move((*meshes)[i]);
    if (progress && !progress(chunks.size(), requests.size())) {
      return Error{Code::cancelled, "meshing was cancelled"};
    }
  }
  return chunks;
}

Result<std::vector<ChunkKey>> chunksOfRegion(const WorldField& world, const IntBox& region, int level,
                                             uint64_t max_chunks) {
  Result<ChunkGrid> unit = chunkGrid(world, {level, {}});
  if (!unit) return unit.error();
  const int64_t edge = int64_t{kChunkCells} * unit->cell;
  auto floorDiv = [](int64_t a, int64_t b) { return a / b - (a % b < 0 ? 1 : 0); };
  std::array<int64_t, 3> first{}, last{};
  // The counts of three axes may overflow together; each alone is at most 2^27.
  long double count = 1;
  for (int axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<size_t>(axis);
    if (region.lo[axis] >= region.hi[axis]) {
      return Error{Code::invalid_argument, "the region is empty: its first corner must lie below its second"};
    }
    first[a] = floorDiv(region.lo[axis], edge);
    last[a] = floorDiv(int64_t{region.hi[axis]} - 1, edge);
    if (first[a] * edge < INT32_MIN || (last[a] + 1) * edge > INT32_MAX) {
      return Error{Code::invalid_argument,
                   "the region's chunks leave the world, which ends about 2,097 km from the origin"};
    }
    count *= static_cast<long double>(last[a] - first[a] + 1);
  }
  if (count > static_cast<long double>(max_chunks)) {
    return Error{Code::limit, "the region has more than " + std::to_string(max_chunks) +
                                  " chunks; make it smaller, the cells larger, or raise the limit"};
  }
  std::vector<ChunkKey> keys;
  keys.reserve(static_cast<size_t>(count));
  for (int64_t z = first[2]; z <= last[2]; ++z) {
    for (int64_t y = first[1]; y <= last[1]; ++y) {
      for (int64_t x = first[0]; x <= last[0]; ++x) {
        keys.push_back({level, {static_cast<int32_t>(x), static_cast<int32_t>(y), static_cast<int32_t>(z)}});
      }
    }
  }
  return keys;
}

}  // namespace sgm
