// `sgm bench chunks`: measures how fast this machine meshes a region of a grammar's world, for each instruction set.

#include <fmt/core.h>

#include <algorithm>
#include <vector>

#include "backend/cpu/cpu_backend.h"
#include "backend/cpu/instruction_sets.h"
#include "base/json.h"
#include "chunk/mesh_chunks.h"
#include "mesh/hash.h"
#include "tools/cli/bench/commands.h"
#include "tools/support/console.h"
#include "tools/support/region.h"

namespace sgm::cli {
namespace {

/// The results for one instruction set and one number of threads. Times are in milliseconds.
struct Row {
  std::string set;
  unsigned threads = 0;
  /// Times for meshing all chunks: the first run, which also derives the grammar cells, and the median of later runs,
  /// in which derived cells are cached.
  double first = 0, median = 0;
  /// Times for single chunks that contain a surface: median and maximum. Measured only with one thread.
  double chunk_median = 0, chunk_most = 0;
  size_t chunks = 0, surfaces = 0, triangles = 0;
  ContentHash hash;
};

double medianOf(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const size_t half = values.size() / 2;
  return values.size() % 2 == 1 ? values[half] : (values[half - 1] + values[half]) / 2;
}

/// Measures meshing with one instruction set and one number of threads.
class Contest {
 public:
  Contest(const OpenedWorld& opened, const BenchChunksOptions& options, std::string set, unsigned threads)
      : options_(options), world_(opened.settings, std::pmr::new_delete_resource()) {
    row_.set = std::move(set);
    row_.threads = threads;
  }

  Result<Row> run(const IntBox& region) {
    if (const Result<void> few = checkChunks(options_, region, world_.cellAt(0)); !few) return few.error();
    Result<std::unique_ptr<JobSystem>> jobs = makeThreadPool(row_.threads);
    if (!jobs) return jobs.error();
    jobs_ = std::move(*jobs);
    row_.threads = jobs_->concurrency();
    Result<std::unique_ptr<Backend>> backend = makeCpuBackend(row_.set, *jobs_, std::pmr::new_delete_resource(), {});
    if (!backend) return backend.error();
    backend_ = std::move(*backend);
    const Result<std::pmr::vector<ChunkKey>> keys = chunksOfRegion(world_, region, options_.level, options_.max_chunks);
    if (!keys) return keys.error();
    // Request the chunks in the form in which a streamed world requests them.
    for (const ChunkKey& key : *keys) requests_.push_back({key, 0, Neighbourhood{}, false, false});

    Result<double> took = meshAll();
    if (!took) return took.error();
    row_.first = *took;
    std::vector<double> times;
    for (uint64_t i = 0; i < options_.runs; ++i) {
      took = meshAll();
      if (!took) return took.error();
      times.push_back(*took);
    }
    row_.median = medianOf(times);
    if (row_.threads == 1)
      if (const Result<void> each = meshEach(); !each) return each.error();
    return row_;
  }

 private:
  Result<double> meshAll() {
    const Stopwatch watch;
    const Result<std::pmr::vector<PlacedChunk>> chunks = meshChunks(world_, *backend_, *jobs_, requests_);
    if (!chunks) return chunks.error();
    const double took = 1000 * watch.seconds();
    std::vector<PlacedPart> parts;
    row_.chunks = chunks->size();
    row_.surfaces = row_.triangles = 0;
    for (const PlacedChunk& chunk : *chunks) {
      appendParts(chunk, parts);
      row_.surfaces += !chunk.mesh.body.indices.empty();
      row_.triangles += chunk.mesh.body.indices.size() / 3;
    }
    row_.hash = hashParts(parts);
    return took;
  }

  Result<void> meshEach() {
    std::vector<double> times;
    for (const ChunkRequest& request : requests_) {
      const Stopwatch watch;
      const Result<std::pmr::vector<PlacedChunk>> chunk = meshChunks(world_, *backend_, *jobs_, {&request, 1});
      if (!chunk) return chunk.error();
      if (!chunk->front().mesh.body.indices.empty()) times.push_back(1000 * watch.seconds());
    }
    if (times.empty()) return {};
    row_.chunk_median = medianOf(times);
    row_.chunk_most = *std::max_element(times.begin(), times.end());
    return {};
  }

  const BenchChunksOptions& options_;
  WorldField world_;
  std::unique_ptr<JobSystem> jobs_;
  std::unique_ptr<Backend> backend_;
  std::vector<ChunkRequest> requests_;
  Row row_;
};

double perSecond(double count, double milliseconds) { return milliseconds > 0 ? 1000 * count / milliseconds : 0; }

Json toJson(const Row& row) {
  Json json{{"instruction_set", row.set},
            {"threads", row.threads},
            {"first_ms", row.first},
            {"median_ms", row.median},
            {"chunks", row.chunks},
            {"surface_chunks", row.surfaces},
            {"triangles", row.triangles},
            {"triangles_per_second", perSecond(static_cast<double>(row.triangles), row.median)},
            {"hash", fmt::format("{:016x}", row.hash.value())}};
  if (row.threads == 1 && row.surfaces > 0)
    json.update({{"surface_chunk_median_ms", row.chunk_median}, {"surface_chunk_most_ms", row.chunk_most}});
  return json;
}

void print(const BenchChunksOptions& options, const std::vector<Row>& rows) {
  const Row& first = rows.front();
  fmt::print("{}: {} chunks, {} with a surface, {} triangles, hash {:016x}; medians of {} warm run{}, milliseconds\n",
             options.file, first.chunks, first.surfaces, first.triangles, first.hash.value(), options.runs,
             options.runs == 1 ? "" : "s");
  fmt::print("  {:<12} {:>7} {:>10} {:>10} {:>8} {:>11} {:>16} {:>10}\n", "set", "threads", "first", "warm", "Mtri/s",
             "chunks/s", "surface chunk", "longest");
  for (const Row& row : rows) {
    fmt::print("  {:<12} {:>7} {:>10.2f} {:>10.2f} {:>8.2f} {:>11.0f}", row.set, row.threads, row.first, row.median,
               perSecond(static_cast<double>(row.triangles), row.median) * 1e-6,
               perSecond(static_cast<double>(row.chunks), row.median));
    if (row.threads == 1 && row.surfaces > 0) fmt::print(" {:>16.3f} {:>10.3f}", row.chunk_median, row.chunk_most);
    fmt::print("\n");
  }
}

}  // namespace

Exit benchChunks(const BenchChunksOptions& options) {
  if (options.backend == "vulkan" || options.backend == "cuda")
    return reportError(Exit::usage,
                       "--backend: this command measures only the processor; compare devices with sgm bench paper");
  const OpenedWorld opened = openWorld(options);
  if (opened.program == nullptr) return opened.status;
  std::vector<Row> rows;
  for (const InstructionSet& set : instructionSets()) {
    if (!set.runs_here) continue;
    std::vector<unsigned> threads{1};
    if (options.threads != 1) threads.push_back(options.threads);
    for (const unsigned count : threads) {
      Result<Row> row = Contest(opened, options, set.kernels->name, count).run(opened.region);
      if (!row) return reportError(row.error());
      // On a machine with one processor, skip the measurement with all processors, since it would repeat the
      // measurement with a single thread.
      if (count != 1 && row->threads == 1) continue;
      rows.push_back(std::move(*row));
    }
  }
  if (options.json) {
    Json list = Json::array();
    for (const Row& row : rows) list.push_back(toJson(row));
    fmt::print("{}\n", Json{{"file", options.file}, {"runs", options.runs}, {"rows", std::move(list)}}.text());
  } else {
    print(options, rows);
  }
  for (const Row& row : rows) {
    if (row.hash == rows.front().hash) continue;
    return reportError(Exit::input, fmt::format("{} with {} threads makes other meshes than {}: please report this bug",
                                                row.set, row.threads, rows.front().set));
  }
  return Exit::done;
}

}  // namespace sgm::cli
