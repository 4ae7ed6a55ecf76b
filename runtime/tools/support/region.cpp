#include "tools/support/region.h"

#include <fmt/core.h>

#include <algorithm>
#include <cstdlib>
#include <map>
#include <tuple>

#include "api/backend_request.h"
#include "backend/open/open_backend.h"
#include "chunk/surface_shapes.h"
#include "mesh/split_creases.h"
#include "region/places.h"
#include "tools/support/region_notes.h"
#include "tools/support/source.h"

namespace sgm::cli {
namespace {

constexpr size_t kMaxNotes = 10;
constexpr const char* kEndless = "the grammar's world is endless: choose a part with --region x0,y0,z0:x1,y1,z1";
constexpr uint64_t kChosenChunks = 4096;  // maximum number of chunks if cell size and region are chosen automatically
constexpr int32_t kFinestSeen = kUnitsPerMetre / 100;  // units, minimum cell size that a view may request
// Surfaces nearer to the camera than this distance, in units, do not make the cells smaller, so they may look coarser
// than the view requests.
constexpr double kNearestSeen = kUnitsPerMetre;

RegionResult failure(Exit status) { return {std::nullopt, status}; }

struct ChosenWorld {
  WorldFieldSettings settings;
  std::optional<IntBox> region;  ///< the region to mesh; nullopt if RegionPlan::choose still has to choose it
};

/// Returns the settings of the world, and its region, as far as the options determine them.
Result<ChosenWorld> chooseWorld(const std::shared_ptr<const Program>& program, const WorldOptions& options,
                                const RegionPlan& plan) {
  ChosenWorld chosen;
  if (!options.region.empty()) {
    const Result<IntBox> given = parseRegion(options.region);
    if (!given) return given.error();
    chosen.region = *given;
  }
  const Result<int32_t> cell = cellUnits(options);
  if (!cell) return cell.error();
  if (plan.check) {
    if (const Result<void> fits = plan.check(*program); !fits) return fits.error();
  }
  Result<ParameterValues> parameters = parameterValues(*program, options.sets);
  if (!parameters) return parameters.error();
  if (options.region.empty() && !program->domain.infinite && !plan.part) chosen.region = program->domain.box;
  if (!chosen.region && !plan.choose) return Error{Code::invalid_argument, kEndless};
  chosen.settings.program = program;
  chosen.settings.parameters = std::move(*parameters);
  chosen.settings.seed = options.seed;
  chosen.settings.finest_cell = *cell;
  chosen.settings.cache_bytes = kCacheBytes;
  return chosen;
}

/// Completes the settings that the options leave open. Without a region, plan.choose chooses it. If the options then
/// give no cell size either, plan.cell gives it; if plan.cell is empty or returns 0, the cell size follows from the
/// size of the region.
Result<void> settleRegion(ChosenWorld& chosen, const WorldOptions& options, const RegionPlan& plan) {
  if (chosen.region) return {};
  const Result<IntBox> region = plan.choose(WorldField(chosen.settings, std::pmr::new_delete_resource()));
  if (!region) return region.error();
  chosen.region = *region;
  if (options.cell || options.density) return {};
  if (const int32_t cell = plan.cell ? plan.cell() : 0; cell > 0) {
    chosen.settings.finest_cell = cell;
    return {};
  }
  const Result<int32_t> fitting = cellFor(std::span(&*region, 1), std::min(kChosenChunks, options.max_chunks));
  if (!fitting) return fitting.error();
  chosen.settings.finest_cell = *fitting;
  return {};
}

/// Checks all options that do not depend on the grammar, then loads it. Errors are printed; `program` is then null.
LoadedGrammar loadForWorld(const WorldOptions& options, const RegionPlan& plan) {
  const auto refused = [](Exit status) {
    LoadedGrammar none;
    none.status = status;
    return none;
  };
  if (!options.region.empty()) {
    const Result<IntBox> given = parseRegion(options.region);
    if (!given) return refused(reportError(given.error()));
  }
  const Result<int32_t> cell = cellUnits(options);
  if (!cell) return refused(reportError(cell.error()));
  LoadedGrammar grammar = loadGrammar(options.file);
  if (grammar.program != nullptr && options.region.empty() && grammar.program->domain.infinite && !plan.choose)
    return refused(reportError(Exit::usage, kEndless));
  return grammar;
}

}  // namespace

sgm_backend backendNamed(const std::string& name) {
  if (name == "cpu") return SGM_BACKEND_CPU;
  if (name == "vulkan") return SGM_BACKEND_VULKAN;
  if (name == "cuda") return SGM_BACKEND_CUDA;
  return SGM_BACKEND_AUTO;
}

std::string pipelineFolder() {
  // A relative path in one of these variables must be ignored (XDG Base Directory Specification).
  const auto absolute = [](const char* variable) {
    const char* text = std::getenv(variable);
    return text != nullptr && *text == '/' ? std::string(text) : std::string();
  };
  if (const std::string cache = absolute("XDG_CACHE_HOME"); !cache.empty()) return cache + "/sgm/pipelines";
  const std::string home = absolute("HOME");
  return home.empty() ? home : home + "/.cache/sgm/pipelines";
}

Result<std::unique_ptr<Backend>> backendOf(const WorldOptions& options, JobSystem& jobs) {
  BackendRequest request = *api::requestOf(backendNamed(options.backend));
  request.pipeline_folder = pipelineFolder();
  request.warn = [](const std::string& message) { fmt::print(stderr, "sgm: warning: {}\n", message); };
  return makeBackend(request, jobs, std::pmr::new_delete_resource());
}

void warnOfNotes(const std::string& file, const std::vector<DeriveNote>& notes) {
  std::map<std::tuple<int, int, std::string>, std::pair<size_t, std::string>> by_place;
  for (const DeriveNote& note : notes) {
    auto& [count, path] = by_place[{note.line, note.column, note.message}];
    if (count++ == 0) path = note.path;
  }
  size_t shown = 0;
  for (const auto& [place, found] : by_place) {
    const auto& [line, column, message] = place;
    if (++shown > kMaxNotes) {
      fmt::print(stderr, "{}: warning: {} more places where shapes were left out\n", file, by_place.size() - kMaxNotes);
      return;
    }
    fmt::print(stderr, "{}:{}:{}: warning: {} ({} times, first in {})\n", file, line, column, message, found.first,
               found.second);
  }
}

/// Prints a note if --sharp had to leave edges rounded. rounded: number of cells with rounded edges.
void noteRounded(const std::string& file, uint64_t rounded) {
  if (rounded == 0) return;
  fmt::print(stderr, "{}: note: {} rounded edges, since sharp ones would fold or cut the surface there\n", file,
             rounded == 1 ? "1 cell keeps" : fmt::format("{} cells keep", rounded));
}

Result<void> checkChunks(const WorldOptions& options, const IntBox& region, int32_t finest_cell) {
  const bool empty = region.lo.x >= region.hi.x || region.lo.y >= region.hi.y || region.lo.z >= region.hi.z;
  const uint64_t most = std::min(options.max_chunks, kMaxRegionChunks);
  const uint64_t count = empty ? 0 : countChunks(region, int64_t{finest_cell} << options.level);
  if (count <= most) return {};
  const std::optional<double> fitting = fittingCell({&region, 1}, options.level, finest_cell, most);
  return Error{
      Code::limit,
      fmt::format(
          "the region has {} chunks with cells of {} m, more than {}: choose larger cells{} or a smaller --region{}",
          count, metres(finest_cell << options.level), most, fitting ? fmt::format(" (--cell {} fits)", *fitting) : "",
          options.max_chunks < kMaxRegionChunks ? ", or raise --max-chunks" : "")};
}

bool isCut(const Region& region) {
  const IntBox& extent = region.meshed.extent;
  const Int3 origin = region.meshed.mesh.origin;
  std::array<double, 3> low{}, high{};
  for (size_t axis = 0; axis < 3; ++axis) {
    const int a = static_cast<int>(axis);
    low[axis] = static_cast<double>(int64_t{extent.lo[a]} - origin[a]) / kUnitsPerMetre;
    high[axis] = static_cast<double>(int64_t{extent.hi[a]} - origin[a]) / kUnitsPerMetre;
  }
  return std::ranges::any_of(region.meshed.mesh.positions, [&](const std::array<double, 3>& p) {
    bool outermost = false;
    for (size_t axis = 0; axis < 3; ++axis) outermost |= p[axis] == low[axis] || p[axis] == high[axis];
    return outermost;
  });
}

Json toJson(const WorldOptions& options, const Region& region) {
  const IntBox& extent = region.meshed.extent;
  const Int3 origin = region.meshed.mesh.origin;
  Json texture;
  if (region.texture) {
    const TexelDensity& density = region.texture->density;
    texture = {{"wedges", region.texture->unwrapped.wedges.size()},
               {"seams", density.seams},
               {"density", {{"p5", density.low}, {"p50", density.middle}, {"p95", density.high}}}};
  }
  return {{"texture", texture},
          {"triangles", region.meshed.mesh.indices.size() / 3},
          {"vertices", region.meshed.mesh.positions.size()},
          {"chunks", region.meshed.chunks},
          {"seconds", region.seconds},
          {"hash", fmt::format("{:016x}", region.meshed.hash.value())},
          {"seed", options.seed},
          {"level", options.level},
          {"cell", metres(region.cell)},
          {"cell_units", region.cell},
          {"density", 1 / metres(region.cell)},
          {"region", {metresJson(extent.lo), metresJson(extent.hi)}},
          {"cut", isCut(region)},
          {"origin", metresJson(origin)},
          {"origin_units", {origin.x, origin.y, origin.z}},
          {"anchors", region.anchors.size()},
          {"backend", region.backend}};
}

Result<Region> meshProgram(std::shared_ptr<const Program> compiled, const WorldOptions& options,
                           const RegionPlan& plan) {
  Result<ChosenWorld> chosen_world = chooseWorld(compiled, options, plan);
  if (!chosen_world) return chosen_world.error();
  WorldFieldSettings& settings = chosen_world->settings;
  std::optional<IntBox>& region = chosen_world->region;

  const Stopwatch watch;
  const Result<std::unique_ptr<JobSystem>> pool = makeThreadPool(options.threads);
  if (!pool) return pool.error();
  const std::unique_ptr<JobSystem>& jobs = *pool;
  std::pmr::memory_resource* memory = std::pmr::new_delete_resource();
  const Result<std::unique_ptr<Backend>> backend = backendOf(options, *jobs);
  if (!backend) return backend.error();
  if (const Result<void> settled = settleRegion(*chosen_world, options, plan); !settled) return settled.error();
  const int halvings = plan.view ? halvingsFor(*plan.view, settings.finest_cell, kFinestSeen, kNearestSeen) : 0;
  settings.finest_cell = settings.finest_cell >> halvings;
  const int level = options.level + halvings;
  const int32_t cell = settings.finest_cell << halvings;
  if (const Result<void> few = checkChunks(options, *region, cell); !few) return few.error();
  const auto kept = std::make_shared<const WorldField>(std::move(settings), memory);
  const WorldField& world = *kept;
  std::optional<ProgressBar> bar;
  const auto now = [&](std::string_view what) {
    if (!plan.quiet) bar.emplace(what);
  };
  now(plan.doing);
  const Progress progress = [&](uint64_t done, uint64_t total) {
    if (bar) bar->show(done, total);
    return !plan.go_on || plan.go_on();
  };
  std::optional<Octree> tree;
  if (halvings > 0) tree = viewTarget(*plan.view, *region, level, world.cellAt(0));
  Result<RegionMesh> meshed =
      tree ? meshRegion(world, **backend, *jobs, *region, *tree, options.max_chunks, options.sharp, progress)
           : meshRegion(world, **backend, *jobs, *region, level, options.max_chunks, options.sharp, progress);
  if (!meshed) return meshed.error();
  std::vector<Anchor> anchors;
  if (plan.anchors) {
    now("looking for anchors");
    Result<std::vector<Anchor>> found = world.anchors(meshed->extent);
    if (!found) return found.error();
    anchors = std::move(*found);
  }
  std::optional<WorldMesh> unsplit;
  if (options.sharp) {
    unsplit = std::move(meshed->mesh);
    meshed->mesh = splitCreases(*unsplit, memory);
  }
  std::optional<TexturedRegion> texture;
  std::optional<Unwrapped> blends;
  const ChunkAt chunk_at = tree ? [&tree](Int3 place) { return tree->leafAt(place); } : chunksOfLevel(world, level);
  if (plan.texture) {
    now("unwrapping");
    Result<TexturedRegion> unwrapped = unwrapRegion(world, *jobs, meshed->mesh, chunk_at, kTile);
    if (!unwrapped) return unwrapped.error();
    texture = std::move(*unwrapped);
  } else if (plan.blends) {
    now("blending materials");
    Result<Unwrapped> blended = blendRegion(world, *jobs, meshed->mesh, chunk_at);
    if (!blended) return blended.error();
    blends = std::move(*blended);
  }
  const double seconds = watch.seconds();
  std::vector<DeriveNote> notes;
  std::vector<ThinPart> thin;
  if (plan.notes) {
    now("looking for notes");
    Result<std::vector<DeriveNote>> left_out = world.notes(meshed->extent, cell << options.level);
    if (!left_out) return left_out.error();
    notes = std::move(*left_out);
    Result<std::vector<ThinPart>> parts = thinParts(world, meshed->extent, level);
    if (!parts) return parts.error();
    thin = std::move(*parts);
  }
  bar.reset();

  const BackendCapabilities& capabilities = (*backend)->capabilities();
  Region result{std::move(compiled),
                std::move(*meshed),
                cell << options.level,
                level,
                std::move(anchors),
                backendName(capabilities.kind),
                capabilities.device,
                seconds,
                std::move(texture),
                std::move(blends),
                std::move(unsplit),
                {},
                std::move(notes),
                std::move(thin),
                plan.keep_world ? kept : nullptr};
  if (result.meshed.mesh.indices.empty()) {
    Result<std::string> why = whyEmpty(world, result);
    if (!why) return why.error();
    result.empty_because = std::move(*why);
  }
  if (plan.after) {
    if (const Result<void> done = plan.after(world, **backend, *jobs, result); !done) return done.error();
  }
  return result;
}

OpenedWorld openWorld(const WorldOptions& options, const RegionPlan& plan) {
  OpenedWorld opened;
  const LoadedGrammar grammar = loadForWorld(options, plan);
  opened.status = grammar.status;
  if (grammar.program == nullptr) return opened;
  Result<ChosenWorld> chosen = chooseWorld(grammar.program, options, plan);
  const Result<void> settled = chosen ? settleRegion(*chosen, options, plan) : chosen.error();
  if (!settled) {
    opened.status = reportError(settled.error());
    return opened;
  }
  opened.program = grammar.program;
  opened.settings = std::move(chosen->settings);
  opened.region = *chosen->region;
  return opened;
}

RegionResult meshRegion(const WorldOptions& options, const RegionPlan& plan) {
  const LoadedGrammar grammar = loadForWorld(options, plan);
  if (grammar.program == nullptr) return failure(grammar.status);
  Result<Region> made = meshProgram(grammar.program, options, plan);
  if (!made) return failure(reportError(made.error()));
  warnOfNotes(options.file, made->notes);
  noteRounded(options.file, made->meshed.rounded);
  warnOfThinWalls(options.file, *grammar.program, made->cell);
  // If the mesh is empty, the caller explains why.
  if (!made->meshed.mesh.indices.empty()) sayThinParts(made->thin, made->cell);
  return {std::move(*made), Exit::done};
}

}  // namespace sgm::cli
