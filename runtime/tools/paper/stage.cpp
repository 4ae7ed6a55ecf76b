#include "tools/paper/stage.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <deque>
#include <optional>

#include "backend/cpu/mesh_chunk.h"
#include "chunk/mesh_chunks.h"
#include "tools/paper/bundle.h"
#include "tools/paper/printed.h"
#include "tools/support/console.h"

namespace sgm::cli {
namespace {

constexpr uint64_t kMaxChunks = 65536;
constexpr size_t kDerivedBytes = size_t{512} << 20;  // size of the cache of derived cells; large enough for any stage

/// The world settings of a stage (a model of the paper's tables), and the cube of that world that each run meshes.
struct StageScene {
  WorldFieldSettings settings;
  IntBox cube;

  Result<std::pmr::vector<ChunkKey>> keys(const WorldField& world) const {
    return chunksOfRegion(world, cube, 0, kMaxChunks);
  }
};

struct StageRun {
  double seconds = 0;
  uint64_t chunks = 0, triangles = 0;
  ContentHash hash;
  IntBox extent;
};

Result<StageScene> makeStage(const StageModel& model, int32_t cell) {
  const CompileResult compiled = compileBundled(model.file);
  if (!compiled.program) return Error{Code::bad_input, renderDiagnostics(compiled)};
  StageScene scene;
  scene.settings.program = compiled.program;
  scene.settings.parameters = ParameterValues::defaults(*compiled.program);
  for (const auto& [name, value] : model.parameters) {
    const Result<void> set = scene.settings.parameters.set(*compiled.program, name, value);
    if (!set) return set.error();
  }
  scene.settings.seed = model.seed;
  scene.settings.finest_cell = cell;
  scene.settings.cache_bytes = kDerivedBytes;
  for (int axis = 0; axis < 3; ++axis) {
    scene.cube.lo[axis] = model.low[axis] * kUnitsPerMetre;
    scene.cube.hi[axis] = (model.low[axis] + model.edge) * kUnitsPerMetre;
  }
  return scene;
}

Result<StageRun> generate(const StageScene& scene, const WorldField& world, const BackendRun& backend_run) {
  const Stopwatch watch;
  const Result<std::pmr::vector<ChunkKey>> keys = scene.keys(world);
  if (!keys) return keys.error();
  std::vector<ChunkRequest> requests;
  for (const ChunkKey& key : *keys) requests.push_back({key, 0, Neighbourhood{}});
  const Result<std::pmr::vector<PlacedChunk>> chunks =
      meshChunks(world, *backend_run.backend, *backend_run.jobs, requests);
  if (!chunks) return chunks.error();
  StageRun run;
  run.seconds = watch.seconds();
  run.chunks = chunks->size();
  run.extent = {chunkBox(chunks->front().grid).lo, chunkBox(chunks->back().grid).hi};
  std::vector<PlacedPart> parts;
  for (const PlacedChunk& chunk : *chunks) appendParts(chunk, parts);
  for (const PlacedPart& part : parts) run.triangles += part.mesh->indices.size() / 3;
  run.hash = hashParts(parts);
  return run;
}

/// Counts the operations of a stage: meshes it as the CPU backend does, but with an evaluator that counts.
Result<uint64_t> countOperations(const StageScene& scene, const WorldField& world, JobSystem& jobs) {
  const Result<std::pmr::vector<ChunkKey>> keys = scene.keys(world);
  if (!keys) return keys.error();
  std::atomic<uint64_t> operations = 0;
  std::vector<std::optional<Error>> errors(keys->size());
  parallelFor(jobs, keys->size(), [&](size_t i) {
    ChunkJob job;
    // Dereference without a check: a previous run has verified that every chunk lies inside the world.
    job.grid = *chunkGrid(world, (*keys)[i]);
    Result<std::shared_ptr<const FieldProgram>> field = world.compile(chunkBox(job.grid), 0);
    if (!field) {
      errors[i] = field.error();
      return;
    }
    job.field = std::move(*field);
    ChunkScratch scratch(std::pmr::new_delete_resource());
    ChunkMesh mesh(std::pmr::new_delete_resource());
    meshChunk({countingKernels(), scalarMeshKernels()}, job, scratch, mesh);
    operations += scratch.evaluation.operations;
  });
  for (const std::optional<Error>& error : errors)
    if (error) return *error;
  return operations.load();
}

std::string outcomeOf(const BackendRun& backend_run, const StageRun& run) {
  return fmt::format("{} ({}) makes {} triangles with the hash {:016x}", backend_run.name, backend_run.device,
                     run.triangles, run.hash.value());
}

}  // namespace

std::span<const StageModel> stageModels() {
  static constexpr std::array<StageModel, 3> kModels = {{{"cave", "cave.sgm", 7, {64, 64, 112}, 64},
                                                         {"cloud", "cloud.sgm", 3, {0, 768, 0}, 1024},
                                                         {"building", "storeys.sgm", 0, {-16, -8, -16}, 32}}};
  return kModels;
}

double StageRow::median() const {
  std::vector<double> sorted = seconds;
  std::sort(sorted.begin(), sorted.end());
  const size_t half = sorted.size() / 2;
  return sorted.size() % 2 == 1 ? sorted[half] : (sorted[half - 1] + sorted[half]) / 2;
}

StageFigures figuresOf(const StageResult& result, const StageRow& row) {
  StageFigures figures;
  figures.seconds = row.median();
  figures.speedup = speedup(result.rows[0].median(), figures.seconds);
  figures.throughput = throughput(static_cast<double>(result.operations), figures.seconds);
  if (row.workers > 0) figures.efficiency = efficiency(figures.speedup, row.workers);
  return figures;
}

Result<StageResult> measureStage(const StageModel& model, int32_t cell, uint64_t runs,
                                 std::span<const BackendRun> backend_runs, const std::function<void()>& step) {
  const Result<StageScene> scene = makeStage(model, cell);
  if (!scene) return scene.error();
  StageResult result;
  result.model = &model;
  result.cell = cell;
  for (const BackendRun& backend_run : backend_runs) {
    StageRow& row = result.rows.emplace_back();
    row.name = backend_run.name;
    row.device = backend_run.device;
    row.reason = backend_run.reason;
    row.workers = backend_run.workers;
  }
  // Each backend run has its own world, so each derives the grammar cells itself in its first run.
  std::deque<WorldField> worlds;
  for (size_t i = 0; i < backend_runs.size(); ++i)
    worlds.emplace_back(scene->settings, std::pmr::new_delete_resource());
  std::optional<size_t> first, last;
  StageRun expected;
  for (uint64_t run = 0; run <= runs; ++run) {
    for (size_t i = 0; i < backend_runs.size(); ++i) {
      const BackendRun& backend_run = backend_runs[i];
      if (!backend_run.backend) continue;
      const uint64_t on_cpu = backend_run.backend->counters().on_cpu;
      const Result<StageRun> made = generate(*scene, worlds[i], backend_run);
      if (!made) {
        return Error{made.error().code, fmt::format("{}: {}: {}", model.name, backend_run.name, made.error().message)};
      }
      if (!first) {
        first = i;
        expected = *made;
      } else if (made->hash != expected.hash || made->triangles != expected.triangles) {
        return Error{Code::bad_input,
                     fmt::format("{}: the meshes differ: {}, and {}", model.name,
                                 outcomeOf(backend_runs[*first], expected), outcomeOf(backend_run, *made))};
      }
      last = i;
      result.rows[i].on_cpu += backend_run.backend->counters().on_cpu - on_cpu;
      if (run == 0) {
        result.rows[i].first = made->seconds;
      } else {
        result.rows[i].seconds.push_back(made->seconds);
      }
      step();
    }
  }
  if (!last) return Error{Code::invalid_argument, "none of the backends can be measured"};
  const Result<uint64_t> operations = countOperations(*scene, worlds[*last], *backend_runs[*last].jobs);
  if (!operations) return operations.error();
  result.operations = *operations;
  result.chunks = expected.chunks;
  result.triangles = expected.triangles;
  result.hash = expected.hash;
  result.extent = expected.extent;
  return result;
}

}  // namespace sgm::cli
