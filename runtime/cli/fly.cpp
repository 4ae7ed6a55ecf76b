// sgm fly: streams a world along a path, and says how well that went.

#include <fmt/core.h>

#include <algorithm>
#include <memory>

#include "cli/commands.h"
#include "cli/flight.h"
#include "cli/flight_picture.h"
#include "cli/json.h"
#include "cli/region.h"
#include "cli/source.h"
#include "render/image.h"

namespace sgm::cli {
namespace {

constexpr int32_t kHashedAround = 32 * SGM_UNITS_PER_METRE;

template <auto End>
struct EndWith {
  template <class T>
  void operator()(T* handle) const {
    static_cast<void>(End(handle));
  }
};
template <class T, auto End>
using Owner = std::unique_ptr<T, EndWith<End>>;

struct Scene {
  Owner<sgm_runtime, sgm_runtime_destroy> runtime;
  Owner<sgm_grammar, sgm_grammar_destroy> grammar;
  Owner<sgm_parameters, sgm_parameters_destroy> parameters;
  Owner<sgm_field, sgm_field_destroy> field;
  Owner<sgm_world, sgm_world_destroy> world;
  int32_t cell = 0;
};

Exit complain(const sgm_error& error) {
  const Exit status = error.code == SGM_ERR_UNSUPPORTED ? Exit::backend
                      : error.code == SGM_ERR_IO        ? Exit::file
                                                        : Exit::input;
  return cli::complain(status, error.message);
}

/// What the options say, through the public interface. Messages of the grammar have been printed before.
Exit makeScene(const FlyOptions& options, bool by_distance, Scene& scene) {
  sgm_error error = SGM_ERROR_INIT;
  sgm_runtime_desc runtime_desc = SGM_RUNTIME_DESC_INIT;
  runtime_desc.threads = options.threads;
  sgm_runtime* runtime = nullptr;
  if (sgm_runtime_create(&runtime_desc, &runtime, &error) != SGM_OK) return complain(error);
  scene.runtime.reset(runtime);

  const Result<std::string> text = readGrammarText(options.file);
  if (!text) return cli::complain(text.error());
  const std::string folder = std::filesystem::path(options.file).parent_path().string();
  sgm_grammar_desc grammar_desc = SGM_GRAMMAR_DESC_INIT;
  grammar_desc.text = text->data();
  grammar_desc.text_size = text->size();
  grammar_desc.name = options.file.c_str();
  grammar_desc.import_folder = folder.empty() ? "." : folder.c_str();
  sgm_grammar* grammar = nullptr;
  if (sgm_grammar_compile(runtime, &grammar_desc, &grammar, nullptr, &error) != SGM_OK) return complain(error);
  scene.grammar.reset(grammar);
  sgm_parameters* parameters = nullptr;
  if (sgm_parameters_create(grammar, &parameters, &error) != SGM_OK) return complain(error);
  scene.parameters.reset(parameters);
  for (const std::string& set : options.sets) {
    const size_t equals = set.find('=');
    if (sgm_parameters_set_text(parameters, set.substr(0, equals).c_str(), set.substr(equals + 1).c_str(), &error) !=
        SGM_OK)
      return complain(error);
  }

  const Result<int32_t> cell = cellUnits(options);
  if (!cell) return cli::complain(cell.error());
  scene.cell = *cell;
  sgm_field_desc field_desc = SGM_FIELD_DESC_INIT;
  field_desc.grammar = grammar;
  field_desc.parameters = parameters;
  field_desc.seed = options.seed;
  field_desc.cell_units = *cell;
  field_desc.backend = backendNamed(options.backend);
  sgm_field* field = nullptr;
  if (sgm_field_create(runtime, &field_desc, &field, &error) != SGM_OK) return complain(error);
  scene.field.reset(field);

  sgm_world_desc world_desc = SGM_WORLD_DESC_INIT;
  world_desc.top_level = options.top_level;
  // A margin for what is on its way while the viewer moves on.
  world_desc.finest_distance = options.finest + options.finest_margin;
  world_desc.view_distance = options.view;
  world_desc.mesh_bytes = options.mesh_mb << 20;
  if (by_distance) world_desc.flags = SGM_WORLD_BY_DISTANCE;
  sgm_world* world = nullptr;
  if (sgm_world_create(field, &world_desc, &world, &error) != SGM_OK) return complain(error);
  scene.world.reset(world);
  return Exit::done;
}

Result<FlightPath> pathOf(const FlyOptions& options, const Scene& scene) {
  if (!options.path.empty()) return FlightPath::ofFile(options.path);
  AutoFlight flight;
  flight.seed = options.seed;
  return FlightPath::automatic(scene.field.get(), scene.grammar.get(), flight);
}

/// Pictures of evenly spaced frames.
class Sheet {
 public:
  Sheet(const FlyOptions& options, const Scene& scene) : options_(options), scene_(scene) {}

  Result<void> begin() {
    if (options_.pictures == 0) return {};
    Result<Renderer> renderer = Renderer::create();
    if (!renderer) return renderer.error();
    renderer_.emplace(std::move(*renderer));
    return {};
  }

  void take(uint64_t frame, const FlightPlace& place, const DrawnMeshes& drawn) {
    const uint64_t wanted = options_.pictures;
    if (!renderer_ || error_ || (frame + 1) * wanted / options_.frames == frame * wanted / options_.frames) return;
    std::vector<PicturedChunk> chunks;
    for (const auto& [key, chunk] : drawn) {
      PicturedChunk& pictured = chunks.emplace_back();
      sgm_mesh_get_view(chunk.mesh.get(), &pictured.mesh, nullptr);
      pictured.seams = chunk.seams;
    }
    PictureWish wish;
    wish.camera = place;
    wish.levels = options_.levels;
    Result<Image> image = drawChunks(*renderer_, scene_.grammar.get(), chunks, wish);
    if (image) {
      images_.push_back(std::move(*image));
    } else {
      error_ = image.error();
    }
  }

  Result<void> write() {
    if (!renderer_) return {};
    if (error_) return *error_;
    Result<FileWriter> file = FileWriter::create(options_.out, &unfinished_files);
    if (!file) return file.error();
    return writePng(contactSheet(images_, images_.size() > 1 ? 2 : 1), *file);
  }

 private:
  const FlyOptions& options_;
  const Scene& scene_;
  std::optional<Renderer> renderer_;
  std::vector<Image> images_;
  std::optional<Error> error_;
};

double share(uint64_t part, uint64_t whole) {
  return whole == 0 ? 0.0 : static_cast<double>(part) / static_cast<double>(whole);
}

/// The hash of level 0 around the flight's end, at rest.
Result<uint64_t> hashAround(const Scene& scene, const FlightPlace& place) {
  sgm_error error = SGM_ERROR_INIT;
  if (sgm_world_wait_idle(scene.world.get(), nullptr, nullptr, &error) != SGM_OK) {
    return Error{Code::limit, error.message};
  }
  int32_t low[3], high[3];
  for (int axis = 0; axis < 3; ++axis) {
    const auto middle = static_cast<int32_t>(place.position[axis] * SGM_UNITS_PER_METRE);
    low[axis] = middle - kHashedAround;
    high[axis] = middle + kHashedAround;
  }
  uint64_t hash = 0;
  if (sgm_world_hash(scene.world.get(), low, high, 0, &hash, &error) != SGM_OK) {
    return Error{Code::limit, error.message};
  }
  return hash;
}

struct Flown {
  FlightReport report;
  uint64_t hash = 0;
};

Json toJson(const FlyOptions& options, const Flown& flown, const std::optional<FlightReport>& by_distance) {
  const FlightReport& r = flown.report;
  Json json = {{"frames", r.frames},
               {"commits", r.commits},
               {"checked", options.check},
               {"open_edges", r.worst.open_edges},
               {"nonmanifold_edges", r.worst.nonmanifold_edges},
               {"degenerate_triangles", r.worst.degenerate_triangles},
               {"overlaps", r.worst.overlaps},
               {"whole_checks", r.whole_checks},
               {"whole_failures", r.whole_failures},
               {"main_thread_ms", {{"p50", r.main_thread.p50}, {"p99", r.main_thread.p99}, {"max", r.main_thread.max}}},
               {"time_to_walkable_ms", r.walkable_ms},
               {"chunks_meshed", r.stats.chunks_meshed},
               {"finest_meshed", r.stats.finest_meshed},
               {"seam_jobs", r.stats.seam_jobs},
               {"chunks_per_second", r.seconds > 0 ? static_cast<double>(r.stats.chunks_meshed) / r.seconds : 0.0},
               {"wasted_fraction", share(r.stats.chunks_in_vain, r.stats.chunks_meshed)},
               {"stale_at_teleports", r.stale_before},
               {"stale_after_2_frames", r.stale_after},
               {"lod0_coverage", share(r.seen_finest, r.seen)},
               {"lod0_covered_frames", share(r.frames_covered, r.frames_seen)},
               {"peak_bytes", {{"meshes", r.stats.peak_mesh_bytes}}},
               {"world_hash", fmt::format("{:016x}", flown.hash)},
               {"seconds", r.seconds}};
  if (by_distance) {
    json["finest_meshed_by_distance"] = by_distance->stats.finest_meshed;
    json["finest_saved"] = 1 - share(r.stats.finest_meshed, by_distance->stats.finest_meshed);
  }
  return json;
}

void print(const FlyOptions& options, const Flown& flown, const std::optional<FlightReport>& by_distance) {
  const FlightReport& r = flown.report;
  fmt::print("{} frames at {} m/s, {} changes of what is drawn, {:.1f} s\n", r.frames, options.speed, r.commits,
             r.seconds);
  if (options.check) {
    fmt::print(
        "  surface   {} open edges, {} non-manifold, {} overlaps in any frame (up to {} triangles); {} of {} "
        "whole checks failed\n",
        r.worst.open_edges, r.worst.nonmanifold_edges, r.worst.overlaps, r.worst.triangles, r.whole_failures,
        r.whole_checks);
  }
  fmt::print("  frame     {:.3f} ms of the caller's thread in the middle, {:.3f} at 99 %, {:.3f} at most\n",
             r.main_thread.p50, r.main_thread.p99, r.main_thread.max);
  if (r.walkable_ms >= 0)
    fmt::print("  start     all that is seen within 16 m of level 0 after {:.0f} ms\n", r.walkable_ms);
  fmt::print("  level 0   {:.2f} % of the surfaces seen within {} m, all of them in {:.2f} % of frames\n",
             100 * share(r.seen_finest, r.seen), options.finest, 100 * share(r.frames_covered, r.frames_seen));
  fmt::print("  chunks    {} meshed ({} of level 0), {} given further seams, {:.1f} % in vain\n", r.stats.chunks_meshed,
             r.stats.finest_meshed, r.stats.seam_jobs, 100 * share(r.stats.chunks_in_vain, r.stats.chunks_meshed));
  if (by_distance) {
    fmt::print("  reach     {} of level 0 instead of {} by distance alone: {:.1f} % saved\n", r.stats.finest_meshed,
               by_distance->stats.finest_meshed,
               100 * (1 - share(r.stats.finest_meshed, by_distance->stats.finest_meshed)));
  }
  fmt::print("  memory    {:.1f} MB of meshes at most\n", static_cast<double>(r.stats.peak_mesh_bytes) / 1e6);
  fmt::print("  hash      {:016x} (level 0 within 32 m of the end, seed {})\n", flown.hash, options.seed);
}

struct FlightResult {
  std::optional<Flown> flown;
  Exit status = Exit::done;
};

FlightResult flyOnce(const FlyOptions& options, bool by_distance) {
  Scene scene;
  if (const Exit status = makeScene(options, by_distance, scene); status != Exit::done) return {{}, status};
  Result<FlightPath> path = pathOf(options, scene);
  if (!path) return {{}, cli::complain(path.error())};
  Sheet sheet(options, scene);
  if (!by_distance) {
    if (Result<void> begun = sheet.begin(); !begun) return {{}, cli::complain(begun.error())};
  }
  FlightSettings settings;
  settings.cell_units = scene.cell;
  settings.speed = options.speed;
  settings.frames = options.frames;
  settings.teleports = options.teleports;
  settings.check = options.check;
  settings.paced = !options.unpaced;
  settings.finest_distance = options.finest;
  FlightPlace last;
  ProgressBar bar(by_distance ? "by distance" : "flying");
  Result<FlightReport> report = sgm::cli::fly(scene.world.get(), scene.field.get(), *path, settings,
                                              [&](uint64_t frame, const FlightPlace& place, const DrawnMeshes& drawn) {
                                                bar.show(frame + 1, options.frames);
                                                last = place;
                                                sheet.take(frame, place, drawn);
                                                return true;
                                              });
  if (!report) return {{}, cli::complain(report.error())};
  if (Result<void> written = sheet.write(); !written) return {{}, cli::complain(written.error())};
  Flown flown{*report, 0};
  if (!by_distance) {
    const Result<uint64_t> hash = hashAround(scene, last);
    if (!hash) return {{}, cli::complain(hash.error())};
    flown.hash = *hash;
  }
  return {flown, Exit::done};
}

}  // namespace

Exit fly(const FlyOptions& options) {
  if (const LoadedGrammar loaded = loadGrammar(options.file); loaded.program == nullptr) return loaded.status;
  const FlightResult flight = flyOnce(options, false);
  if (!flight.flown) return flight.status;
  std::optional<FlightReport> by_distance;
  if (options.compare) {
    const FlightResult other = flyOnce(options, true);
    if (!other.flown) return other.status;
    by_distance = other.flown->report;
  }
  if (options.json) {
    fmt::print("{}\n", toJson(options, *flight.flown, by_distance).text());
  } else {
    print(options, *flight.flown, by_distance);
  }
  const FlightReport& r = flight.flown->report;
  return r.worst.closed() && r.whole_failures == 0 ? Exit::done
                                                   : cli::complain(Exit::input, "a frame's surface was not closed");
}

}  // namespace sgm::cli
