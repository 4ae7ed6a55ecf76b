#include "chunk/mesh_chunks.h"

#include <algorithm>
#include <array>
#include <limits>
#include <mutex>

#include "chunk/sharpen_chunk.h"

namespace sgm {

namespace {

// The number of chunks in a batch. At the end of a batch, threads that have finished wait for the others, because
// chunks take different times. A batch is so large that this wait matters little, and so small that its field programs
// take little memory. A device may require larger batches.
constexpr size_t kBatchChunks = 256;
// The maximum number of successive chunks that one thread prepares together. Successive chunks mostly use the same
// cells, which the thread then derives only once.
constexpr size_t kPreparedTogether = 16;
// The maximum number of cells that a thread keeps in memory between chunks, in addition to the cells in the cache.
constexpr size_t kMaxCachedCells = 1024;

/// True if a thread should release the cells that it keeps between chunks: there are more than kMaxCachedCells, or they
/// use more than the thread's share of the cache's bytes.
bool tooMany(const CachedCells& cells, size_t byte_limit) {
  if (cells.size() > kMaxCachedCells) return true;
  size_t bytes = 0;
  for (const auto& [key, cell] : cells) bytes += cell->bytes;
  return bytes > byte_limit;
}

/// Prepares the backend's job for a chunk, and the content of the chunk that needs no meshing (such as anchors).
Result<void> prepare(const WorldField& world, const ChunkRequest& request, const EditSnapshot* edits,
                     CachedCells& cached_cells, ChunkJob& job, PlacedChunk& chunk) {
  const Result<ChunkGrid> grid = chunkGrid(world, request.key);
  if (!grid) return grid.error();
  chunk.grid = job.grid = *grid;
  job.seams = request.seams;
  job.coarser = request.coarser;
  job.signs = request.signs;
  job.keys = request.keys || request.sharp;
  job.body = request.body;
  job.resident = request.resident && !request.sharp;
  job.prompt = request.prompt;
  job.sums_only = request.sums_only;
  Result<std::shared_ptr<const FieldProgram>> field =
      world.compile(sampledBox(*grid, grid->level, request.sharp), grid->level, edits, &cached_cells);
  if (!field) return field.error();
  job.field = std::move(*field);
  if (request.seams != 0) {
    const int above = grid->level + 1;
    Result<std::shared_ptr<const FieldProgram>> coarse =
        request.outermost ? world.compileOutside(above)
                          : world.compile(sampledBox(*grid, above, request.sharp), above, edits, &cached_cells);
    if (!coarse) return coarse.error();
    job.coarse = std::move(*coarse);
  }
  if (request.anchors) {
    Result<std::vector<Anchor>> anchors = world.anchors(chunkBox(*grid), &cached_cells);
    if (!anchors) return anchors.error();
    chunk.anchors = std::move(*anchors);
  }
  return {};
}

/// The field programs of a chunk at its own level and at the next coarser level. Sharpening needs them after the
/// backend has consumed the chunk's job. Null if the chunk is not sharpened.
struct SampledPrograms {
  std::shared_ptr<const FieldProgram> field, coarse;
};
using Programs = std::vector<SampledPrograms>;

Programs programsOf(std::span<const ChunkRequest> requests, std::span<const ChunkJob> jobs) {
  Programs programs(jobs.size());
  for (size_t i = 0; i < jobs.size(); ++i) {
    if (requests[i].sharp) programs[i] = {jobs[i].field, jobs[i].coarse};
  }
  return programs;
}

/// Counts finished chunks over all batches, and calls the progress function after each chunk.
class Counter {
 public:
  Counter(const Progress& progress, uint64_t total) : progress_(progress), total_(total) {}

  /// Counts one chunk; returns false if the work is cancelled. Any thread may call it.
  bool one() {
    const std::lock_guard lock(mutex_);
    ++done_;
    // After the last chunk there is nothing left to cancel, so the result of progress is ignored.
    if (!stopped_ && !progress_(done_, total_) && done_ < total_) stopped_ = true;
    return !stopped_;
  }
  /// True if the work was cancelled. Any thread may call it.
  bool stopped() const {
    const std::lock_guard lock(mutex_);
    return stopped_;
  }

 private:
  const Progress& progress_;
  const uint64_t total_;
  mutable std::mutex mutex_;
  uint64_t done_ = 0;
  bool stopped_ = false;
};

}  // namespace

Result<ChunkGrid> chunkGrid(const WorldField& world, const ChunkKey& key) {
  if (key.level < 0 || key.level > kMaxLevel) {
    return Error{Code::invalid_argument, "a chunk's level must lie between 0 and " + std::to_string(kMaxLevel)};
  }
  const int64_t cell = int64_t{world.settings().finest_cell} << key.level;
  const int64_t edge = kChunkCells * cell;
  ChunkGrid grid;
  grid.level = key.level;
  for (int axis = 0; axis < 3; ++axis) {
    const int64_t lo = key.at[axis] * edge;
    if (lo < INT32_MIN || lo + edge > INT32_MAX) {
      return Error{Code::range, "the chunk leaves the world, which ends about 2,097 km from the origin"};
    }
    grid.origin[axis] = static_cast<int32_t>(lo);
  }
  grid.cell = static_cast<int32_t>(cell);
  return grid;
}

IntBox chunkBox(const ChunkGrid& grid) {
  IntBox box{grid.origin, grid.origin};
  for (int axis = 0; axis < 3; ++axis) box.hi[axis] += kChunkCells * grid.cell;
  return box;
}

IntBox sampledBox(const ChunkGrid& grid, int level, bool sharp) {
  const IntBox box = chunkBox(grid);
  return sharp ? box.grown(saturate(sharpReach(int64_t{grid.cell} << (level - grid.level)))) : box;
}

Result<std::pmr::vector<PlacedChunk>> meshChunks(const WorldField& world, Backend& backend, JobSystem& jobs,
                                                 std::span<const ChunkRequest> requests, const Progress& progress,
                                                 const EditSnapshot* edits) {
  std::pmr::vector<PlacedChunk> chunks(world.memory());
  chunks.reserve(requests.size());
  Counter counter(progress, requests.size());
  const size_t most = std::max<size_t>(kBatchChunks, backend.batch());
  for (size_t first = 0; first < requests.size(); first += most) {
    const auto batch = requests.subspan(first, std::min(most, requests.size() - first));
    for (const ChunkRequest& request : batch) chunks.push_back({request.key, {}, ChunkMesh(world.memory()), {}});
    std::vector<ChunkJob> chunk_jobs(batch.size());
    std::mutex mutex;
    std::optional<Error> error;
    size_t error_at = 0;
    const size_t together = std::clamp<size_t>(batch.size() / (4 * jobs.concurrency()), 1, kPreparedTogether);
    const size_t cached_cells_limit = world.settings().cache_bytes / jobs.concurrency();
    parallelFor(jobs, (batch.size() + together - 1) / together, [&](size_t run) {
      CachedCells cached_cells;
      for (size_t i = run * together; i < std::min((run + 1) * together, batch.size()); ++i) {
        if (tooMany(cached_cells, cached_cells_limit)) cached_cells.clear();
        const Result<void> prepared = prepare(world, batch[i], edits, cached_cells, chunk_jobs[i], chunks[first + i]);
        if (prepared) continue;
        // If several requests fail, the error of the first request is reported, so that the result does not depend on
        // the speed of threads.
        std::lock_guard lock(mutex);
        if (error && error_at <= i) continue;
        error = prepared.error();
        error_at = i;
      }
    });
    if (error) return *error;
    const Programs programs = programsOf(batch, chunk_jobs);
    // If any chunk of the batch must be sharpened, progress counts all chunks of the batch after sharpening instead of
    // after meshing.
    const bool sharp =
        std::any_of(batch.begin(), batch.end(), [](const ChunkRequest& request) { return request.sharp; });

    Result<std::unique_ptr<ChunkBatch>> submitted =
        backend.submit(std::move(chunk_jobs), progress ? [&] { return sharp || counter.one(); } : AfterChunk{});
    if (!submitted) return submitted.error();
    (*submitted)->wait();
    Result<std::vector<ChunkMesh>> meshes = (*submitted)->take();
    if (!meshes) return meshes.error();
    if (counter.stopped()) return Error{Code::cancelled, "meshing was cancelled"};
    for (size_t i = 0; i < meshes->size(); ++i) chunks[first + i].mesh = std::move((*meshes)[i]);
    if (!sharp) continue;
    parallelFor(jobs, batch.size(), [&](size_t i) {
      if (counter.stopped()) return;
      PlacedChunk& chunk = chunks[first + i];
      if (batch[i].sharp) {
        sharpenChunk(chunk.grid, *programs[i].field, programs[i].coarse.get(), chunk.mesh, world.memory());
      }
      if (progress) counter.one();
    });
    if (counter.stopped()) return Error{Code::cancelled, "meshing was cancelled"};
  }
  return chunks;
}

Result<std::pmr::vector<ChunkKey>> chunksOfRegion(const WorldField& world, const IntBox& region, int level,
                                                  uint64_t max_chunks) {
  Result<ChunkGrid> unit = chunkGrid(world, {level, {}});
  if (!unit) return unit.error();
  const int64_t edge = int64_t{kChunkCells} * unit->cell;
  std::array<int64_t, 3> first{}, last{};
  for (int axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<size_t>(axis);
    if (region.lo[axis] >= region.hi[axis]) {
      return Error{Code::invalid_argument, "the region is empty: its first corner must lie below its second"};
    }
    first[a] = floorDiv(region.lo[axis], edge);
    last[a] = floorDiv(int64_t{region.hi[axis]} - 1, edge);
    if (first[a] * edge < INT32_MIN || (last[a] + 1) * edge > INT32_MAX) {
      return Error{Code::range, "the region's chunks leave the world, which ends about 2,097 km from the origin"};
    }
  }
  const uint64_t count = countChunks(region, unit->cell);
  if (const uint64_t most = std::min(max_chunks, kMaxRegionChunks); count > most) {
    return Error{Code::limit,
                 "the region has " + std::to_string(count) + " chunks, more than " + std::to_string(most) +
                     "; make the cells larger" + fittingCellText({&region, 1}, level, world.cellAt(0), most) +
                     " or the region smaller" +
                     (max_chunks < kMaxRegionChunks ? ", or raise the limit" : ": the limit cannot be raised")};
  }
  std::pmr::vector<ChunkKey> keys(world.memory());
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

VoidComponents voidsOf(const ChunkMesh& mesh) {
  std::pmr::memory_resource* memory = mesh.signs.get_allocator().resource();
  return mesh.uniform ? voidOfUniform(mesh.solid_samples != 0, memory) : voidComponents(mesh.signs, memory);
}

}  // namespace sgm
