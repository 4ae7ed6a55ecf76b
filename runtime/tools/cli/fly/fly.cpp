// `sgm fly`: streams a world along a path, and reports the quality of the streaming.

#include <fmt/core.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <limits>
#include <memory>

#include "tools/cli/fly/commands.h"
#include "tools/cli/fly/fly_pictures.h"
#include "tools/cli/fly/fly_report.h"
#include "tools/flight/flight_animation.h"
#include "tools/support/awaited_signals.h"
#include "tools/support/console.h"
#include "tools/support/region.h"
#include "tools/support/source.h"

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
  /// Suppresses the world's log messages while the command itself reports the same problem as an error.
  std::atomic<bool> quiet = false;
  Owner<sgm_runtime, sgm_runtime_destroy> runtime;
  Owner<sgm_grammar, sgm_grammar_destroy> grammar;
  Owner<sgm_parameters, sgm_parameters_destroy> parameters;
  Owner<sgm_field, sgm_field_destroy> field;
  Owner<sgm_world, sgm_world_destroy> world;
  int32_t cell = 0;
  sgm_field_desc field_desc = SGM_FIELD_DESC_INIT;
};

Exit reportApiError(const sgm_error& error) {
  const Exit status = error.code == SGM_ERR_UNSUPPORTED ? Exit::backend
                      : error.code == SGM_ERR_IO        ? Exit::file
                                                        : Exit::input;
  return reportError(status, error.message);
}

/// Log callback of the world: prints warnings to stderr, for example about a damaged journal or an unwritable folder.
void tellWarning(void* scene, sgm_log_level level, const char* message) {
  if (level >= SGM_LOG_WARNING && !static_cast<Scene*>(scene)->quiet)
    std::fprintf(stderr, "sgm: warning: %s\n", message);
}

/// Flushes all edits to the journal file. If this fails, the caller prints the error.
Result<void> keepEdits(Scene& scene) {
  scene.quiet = true;
  sgm_error error = SGM_ERROR_INIT;
  if (sgm_world_flush_edits(scene.world.get(), &error) != SGM_OK) return errorOf(error);
  scene.quiet = false;
  return {};
}

/// Creates the scene that the options describe, through the public interface, and prints diagnostics of the grammar.
/// by_distance: whether the distance alone selects level 0.
Exit makeScene(const FlyOptions& options, bool by_distance, Scene& scene) {
  sgm_error error = SGM_ERROR_INIT;
  sgm_runtime_desc runtime_desc = SGM_RUNTIME_DESC_INIT;
  runtime_desc.threads = options.threads;
  const sgm_log_sink sink{tellWarning, &scene};
  runtime_desc.log = &sink;
  const std::string pipelines = pipelineFolder();
  if (!pipelines.empty()) runtime_desc.pipeline_folder = pipelines.c_str();
  sgm_runtime* runtime = nullptr;
  if (sgm_runtime_create(&runtime_desc, &runtime, &error) != SGM_OK) return reportApiError(error);
  scene.runtime.reset(runtime);

  const Result<std::string> text = readGrammarText(options.file);
  if (!text) return reportError(text.error());
  const std::string folder = std::filesystem::path(options.file).parent_path().string();
  sgm_grammar_desc grammar_desc = SGM_GRAMMAR_DESC_INIT;
  grammar_desc.text = text->data();
  grammar_desc.text_size = text->size();
  grammar_desc.name = options.file.c_str();
  grammar_desc.import_folder = folder.empty() ? "." : folder.c_str();
  sgm_grammar* grammar = nullptr;
  if (sgm_grammar_compile(runtime, &grammar_desc, &grammar, nullptr, &error) != SGM_OK) return reportApiError(error);
  scene.grammar.reset(grammar);
  sgm_parameters* parameters = nullptr;
  if (sgm_parameters_create(grammar, &parameters, &error) != SGM_OK) return reportApiError(error);
  scene.parameters.reset(parameters);
  for (const std::string& set : options.sets) {
    const size_t equals = set.find('=');
    if (sgm_parameters_set_text(parameters, set.substr(0, equals).c_str(), set.substr(equals + 1).c_str(), &error) !=
        SGM_OK)
      return reportApiError(error);
  }

  const Result<int32_t> cell = cellUnits(options);
  if (!cell) return reportError(cell.error());
  scene.cell = *cell;
  sgm_field_desc& field_desc = scene.field_desc;
  field_desc.grammar = grammar;
  field_desc.parameters = parameters;
  field_desc.seed = options.seed;
  field_desc.cell_units = *cell;
  field_desc.backend = backendNamed(options.backend);
  sgm_field* field = nullptr;
  if (sgm_field_create(runtime, &field_desc, &field, &error) != SGM_OK) return reportApiError(error);
  scene.field.reset(field);

  sgm_world_desc world_desc = SGM_WORLD_DESC_INIT;
  world_desc.top_level = options.top_level;
  // Level 0 is requested up to a margin beyond options.finest, so that chunks arrive before the viewer is within
  // options.finest of them.
  world_desc.finest_distance = options.finest + options.finest_margin;
  world_desc.view_distance = options.view;
  world_desc.mesh_bytes = options.mesh_mb << 20;
  world_desc.collider_distance = kWalkableDistance;
  if (!options.journal.empty()) world_desc.journal = options.journal.c_str();
  // The second flight (by_distance) must mesh all chunks itself to be comparable, so it gets no cache.
  if (!options.cache.empty() && !by_distance) world_desc.cache_folder = options.cache.c_str();
  std::vector<const char*> stores;
  for (const std::string& store : options.stores) stores.push_back(store.c_str());
  if (!by_distance) {
    world_desc.stores = stores.data();
    world_desc.store_count = static_cast<uint32_t>(stores.size());
  }
  if (by_distance) world_desc.flags |= SGM_WORLD_BY_DISTANCE;
  if (options.sharp) world_desc.flags |= SGM_WORLD_SHARP;
  // Measures are reported for the first flight only.
  if (options.measure && !by_distance) world_desc.flags |= SGM_WORLD_MEASURE;
  sgm_world* world = nullptr;
  if (sgm_world_create(field, &world_desc, &world, &error) != SGM_OK) return reportApiError(error);
  scene.world.reset(world);
  return Exit::done;
}

Result<FlightPath> pathOf(const FlyOptions& options, const Scene& scene) {
  if (!options.path.empty()) return FlightPath::ofFile(options.path);
  AutoFlight flight;
  flight.seed = options.seed;
  return FlightPath::automatic(scene.field.get(), scene.grammar.get(), flight);
}

/// Returns the hash of the level-0 chunks around the last position of the flight.
Result<uint64_t> hashAround(const Scene& scene, const FlightPlace& place) {
  // Clamp the position, so that the box, extended to whole chunks, stays within the range of coordinates.
  const int64_t farthest = std::numeric_limits<int32_t>::max() - int64_t{SGM_CHUNK_CELLS} * scene.cell - kHashedAround;
  int32_t low[3], high[3];
  for (int axis = 0; axis < 3; ++axis) {
    const int64_t place_units = std::llround(place.position[axis] * SGM_UNITS_PER_METRE);
    const auto middle = static_cast<int32_t>(std::clamp(place_units, -farthest, farthest));
    low[axis] = middle - kHashedAround;
    high[axis] = middle + kHashedAround;
  }
  sgm_error error = SGM_ERROR_INIT;
  uint64_t hash = 0;
  if (sgm_world_hash(scene.world.get(), low, high, 0, &hash, &error) != SGM_OK) return errorOf(error);
  return hash;
}

FlightSettings settingsOf(const FlyOptions& options, const Scene& scene) {
  FlightSettings settings;
  settings.cell_units = scene.cell;
  settings.seed = options.seed;
  settings.speed = options.speed;
  settings.frames = options.frames;
  settings.teleports = options.teleports;
  settings.edits = options.edits;
  settings.check = options.check;
  settings.paced = !options.unpaced;
  settings.finest_distance = options.finest;
  return settings;
}

struct FlightResult {
  std::optional<Flown> flown;
  Exit status = Exit::done;
};

/// Makes the name under which the service lists a world: characters that are not allowed become '_'.
std::string worldName(std::string_view text) {
  constexpr size_t kLongest = 64;
  std::string name(text.substr(0, kLongest));
  for (char& c : name) {
    const bool fits =
        (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' || c == '.';
    if (!fits) c = '_';
  }
  return name.empty() ? "world" : name;
}

/// Starts a service that watches the scene's world, and prints its address to stderr, because standard output is for
/// the report.
Result<Serving> serveWorld(const FlyOptions& options, const Scene& scene) {
  Result<Serving> serving = Serving::start(options.serving);
  if (!serving) return serving;
  const std::string name = std::filesystem::path(options.file).stem().string();
  if (Result<void> watched = serving->watch(worldName(name), scene.world.get()); !watched) return watched.error();
  fmt::print(stderr, "page {}/\nmetrics {}/metrics\n", serving->work(), serving->operations());
  return serving;
}

/// Runs one flight. pictures: null for the second flight, in which the distance alone selects level 0.
FlightResult flyOnce(const FlyOptions& options, FlyPictures* pictures) {
  Scene scene;
  const bool serves = options.serve && pictures != nullptr;
  std::optional<AwaitedSignals> signals;
  if (serves && options.keep_serving) signals.emplace();
  if (const Exit status = makeScene(options, pictures == nullptr, scene); status != Exit::done) return {{}, status};
  std::optional<Serving> serving;
  if (serves) {
    Result<Serving> started = serveWorld(options, scene);
    if (!started) return {{}, reportError(started.error())};
    serving = std::move(*started);
  }
  Result<FlightPath> path = pathOf(options, scene);
  if (!path) return {{}, reportError(path.error())};
  FlightSettings settings = settingsOf(options, scene);
  std::optional<FlightAnimation> animation;
  if (options.animate) {
    Result<FlightAnimation> made =
        FlightAnimation::of(scene.runtime.get(), scene.field_desc, scene.parameters.get(), options.animated);
    if (!made) return {{}, reportError(made.error())};
    animation = std::move(*made);
    settings.each_frame = [&](double seconds) { return animation->show(scene.world.get(), seconds); };
  }
  FlightPlace last;
  std::optional<ProgressBar> bar(std::in_place, "planning");
  const FlownScene flown_scene{scene.grammar.get(), scene.world.get()};
  FlightWatch watch;
  watch.planned = [&](uint64_t frame) {
    if (signals && signals->came()) signals->pass();
    bar->show(frame + 1, options.frames);
  };
  watch.flown = [&](uint64_t frame, const FlightPlace& place, const DrawnMeshes& drawn) {
    if (frame == 0) bar.emplace(pictures == nullptr ? "by distance" : "flying");
    bar->show(frame + 1, options.frames);
    last = place;
    if (signals && signals->came()) return false;
    return pictures == nullptr || pictures->take(flown_scene, frame, place, drawn);
  };
  if (pictures != nullptr) watch.pictured = [&](uint64_t frame) { return pictures->wants(frame); };
  Result<FlightReport> report = sgm::cli::fly(scene.world.get(), *path, settings, watch);
  bar.reset();
  // Write the journal before any step that may fail, since the edits exist only in this process until then.
  const Result<void> kept = keepEdits(scene);
  if (!kept && !report) return {{}, reportError(kept.error())};
  if (signals && signals->came() && !report) {
    fmt::print(stderr, "stopped before the end of the flight: there is no report\n");
    return {{}, Exit::done};
  }
  if (!report && report.error().code != Code::cancelled) return {{}, reportError(report.error())};
  if (pictures != nullptr) {
    if (Result<void> drawn = pictures->finish(); !drawn) return {{}, reportError(drawn.error())};
  }
  Flown flown;
  if (pictures != nullptr) flown.lights = pictures->lights();
  flown.report = std::move(*report);
  flown.frame_bytes = settings.frame_bytes;
  if (animation) {
    flown.fields = animation->fields();
    flown.fields_drawn = animation->drawn();
  }
  const Result<uint64_t> hash = hashAround(scene, last);
  if (!hash) return {{}, reportError(hash.error())};
  flown.hash = *hash;
  sgm_runtime_memory(scene.runtime.get(), nullptr, &flown.runtime_peak_bytes);
  sgm_error error = SGM_ERROR_INIT;
  if (options.measure && pictures != nullptr) {
    flown.measures = SGM_WORLD_MEASURES_INIT;
    if (sgm_world_get_measures(scene.world.get(), &*flown.measures, &error) != SGM_OK)
      return {{}, reportApiError(error)};
  }
  if (sgm_backend_query(scene.runtime.get(), backendNamed(options.backend), &flown.backend, &error) != SGM_OK)
    return {{}, reportApiError(error)};
  if (!kept) flown.edits_lost = kept.error();
  if (signals) signals->wait();
  return {std::move(flown), Exit::done};
}

}  // namespace

Exit fly(const FlyOptions& options) {
  if (const LoadedGrammar loaded = loadGrammar(options.file); loaded.program == nullptr) return loaded.status;
  FlyPictures pictures(options);
  if (Result<void> begun = pictures.begin(); !begun) return reportError(begun.error());
  const FlightResult flight = flyOnce(options, &pictures);
  if (!flight.flown) return flight.status;
  std::optional<FlightReport> by_distance;
  if (options.compare) {
    const FlightResult other = flyOnce(options, nullptr);
    if (!other.flown) return other.status;
    by_distance = other.flown->report;
  }
  if (options.json) {
    fmt::print("{}\n", toJson(options, *flight.flown, by_distance).text());
  } else {
    print(options, *flight.flown, by_distance);
  }
  const std::optional<std::string> defect = defectOf(*flight.flown);
  if (defect) reportError(Exit::input, *defect);
  if (flight.flown->edits_lost) return reportError(*flight.flown->edits_lost);
  return defect ? Exit::input : Exit::done;
}

}  // namespace sgm::cli
