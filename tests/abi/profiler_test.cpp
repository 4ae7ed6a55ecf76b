// Tests the calls of an engine's profiler, for every outcome of the library's functions.

#include <algorithm>
#include <chrono>
#include <map>
#include <mutex>
#include <random>
#include <set>
#include <thread>

#include "fixture.h"
#include "rounds.h"

namespace {

const std::set<std::string> kZones = {"sgm.derive", "sgm.compile", "sgm.mesh", "sgm.pack",
                                      "sgm.plan",   "sgm.update",  "sgm.poll", "sgm.region"};
const std::set<std::string> kPlots = {"sgm.queued", "sgm.in_work", "sgm.mesh_bytes"};

/// A profiler that records the zones of each thread. Any thread may report zones; results may be read when all work has
/// ended.
class ZoneRecord {
 public:
  sgm_profiler table() {
    sgm_profiler profiler{};
    profiler.begin = [](void* user, const char* zone) { return static_cast<ZoneRecord*>(user)->begin(zone); };
    profiler.end = [](void* user, uint64_t begun) { static_cast<ZoneRecord*>(user)->end(begun); };
    profiler.thread = [](void* user, const char* name) { static_cast<ZoneRecord*>(user)->nameThread(name); };
    profiler.plot = [](void* user, const char* name, double value) {
      static_cast<ZoneRecord*>(user)->plotValue(name, value);
    };
    profiler.user = this;
    return profiler;
  }

  std::map<std::string, size_t> counts;  ///< number of zones with each name
  /// Number of zones by the pair (name of the enclosing zone, name of the zone); "" if there is no enclosing zone.
  std::map<std::pair<std::string, std::string>, size_t> within;
  std::map<std::string, std::vector<double>> plots;
  std::map<std::string, std::set<const void*>> pointers;  ///< for each name, the addresses of the strings that were
                                                          ///< passed
  std::map<std::thread::id, std::vector<std::string>> thread_names;
  std::set<std::thread::id> threads;
  size_t crossed = 0;  ///< number of end() calls that did not end the innermost zone of their thread

  size_t open() const {
    size_t sum = 0;
    for (const auto& [thread, stack] : open_) sum += stack.size();
    return sum;
  }
  size_t total() const {
    size_t sum = 0;
    for (const auto& [name, count] : counts) sum += count;
    return sum;
  }

 private:
  struct Zone {
    std::string name;
    uint64_t begun;
  };
  uint64_t begin(const char* zone) {
    const std::lock_guard lock(mutex_);
    std::vector<Zone>& stack = open_[std::this_thread::get_id()];
    threads.insert(std::this_thread::get_id());
    ++counts[zone];
    ++within[{stack.empty() ? "" : stack.back().name, zone}];
    pointers[zone].insert(zone);
    // Return a different value each time; the library must pass every bit of it back to end().
    next_ = next_ * 6364136223846793005u + 1442695040888963407u;
    stack.push_back({zone, next_});
    return next_;
  }
  void end(uint64_t begun) {
    const std::lock_guard lock(mutex_);
    std::vector<Zone>& stack = open_[std::this_thread::get_id()];
    if (stack.empty() || stack.back().begun != begun) {
      ++crossed;
    } else {
      stack.pop_back();
    }
  }
  void nameThread(const char* name) {
    const std::lock_guard lock(mutex_);
    thread_names[std::this_thread::get_id()].emplace_back(name);
  }
  void plotValue(const char* name, double value) {
    const std::lock_guard lock(mutex_);
    plots[name].push_back(value);
    pointers[name].insert(name);
  }

  std::mutex mutex_;
  std::map<std::thread::id, std::vector<Zone>> open_;
  uint64_t next_ = 1;
};

void checkWhole(const ZoneRecord& record) {
  CHECK(record.crossed == 0);
  CHECK(record.open() == 0);
  for (const auto& [name, count] : record.counts) CHECK(kZones.count(name) == 1);
  for (const auto& [name, values] : record.plots) CHECK(kPlots.count(name) == 1);
  for (const auto& [name, pointers] : record.pointers) CHECK(pointers.size() == 1);
}

constexpr const char* kOneLayer =
    "sgm 1; units m; domain infinite;\nlayer l cell 32m reach 8m { start Ball; }\n"
    "rule Ball { at(8m, 8m, 8m) sphere(7m); }\n";

/// A grammar with balls around the origin, and a second layer whose shapes query the first layer during derivation.
constexpr const char* kTwoLayers =
    "sgm 1; units m; domain infinite;\n"
    "layer l cell 32m reach 8m { start Ball; }\n"
    "layer top cell 32m reach 4m uses l { start Posts; }\n"
    "rule Ball { at(8m, 8m, 8m) sphere(7m); }\n"
    "rule Posts { scatter poisson(8m) probe up 8m of l { sphere(0.5m); } }\n";

RuntimeOwner profiled(const sgm_profiler& profiler, uint32_t threads = 3, uint64_t memory_limit = 0) {
  sgm_runtime_desc desc = SGM_RUNTIME_DESC_INIT;
  desc.threads = threads;
  desc.memory_limit = memory_limit;
  desc.profiler = &profiler;
  return makeRuntime(&desc);
}

WorldOwner streamFrom(sgm_field* field) {
  sgm_world_desc desc = SGM_WORLD_DESC_INIT;
  desc.top_level = 2;
  desc.finest_distance = 8;
  desc.view_distance = 40;
  return makeWorld(field, desc);
}

void lookFrom(sgm_world* world, double x) {
  sgm_viewer viewer = SGM_VIEWER_INIT;
  viewer.position[0] = x;
  REQUIRE(sgm_world_set_viewers(world, &viewer, 0, 1, nullptr) == SGM_OK);
}

/// Updates the world, and discards all events. Returns whether the update succeeded.
bool drawFrame(sgm_world* world) {
  const bool updated = sgm_world_update(world, 1 << 20, nullptr) == SGM_OK;
  sgm_world_event events[16];
  for (size_t count = 16;; count = 16) {
    REQUIRE(sgm_world_poll(world, events, 0, &count, nullptr) == SGM_OK);
    for (size_t i = 0; i < count; ++i) sgm_mesh_release(events[i].mesh);
    if (count == 0) return updated;
  }
}

/// Draws frames until the world's statistics satisfy a condition; returns the number of frames. This thread runs no
/// jobs meanwhile.
template <class Wanted>
size_t drawUntil(sgm_world* world, Wanted wanted) {
  sgm_world_stats stats = SGM_WORLD_STATS_INIT;
  for (size_t frames = 1; frames < 60'000; ++frames) {
    REQUIRE(drawFrame(world));
    REQUIRE(sgm_world_get_stats(world, &stats, nullptr) == SGM_OK);
    if (wanted(stats)) return frames;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  FAIL("the world does not come so far");
  return 0;
}

sgm_result meshRegion(sgm_field* field, int32_t edge, sgm_progress_function progress, void* user) {
  sgm_region_desc region = SGM_REGION_DESC_INIT;
  for (int32_t& v : region.maximum) v = edge;
  region.progress = progress;
  region.progress_user = user;
  sgm_surface* surface = nullptr;
  const sgm_result result = sgm_surface_from_region(field, &region, &surface, nullptr);
  sgm_surface_destroy(surface);
  return result;
}

}  // namespace

TEST_CASE("zones nest on each thread, and all of them are there", "[threads]") {
  ZoneRecord record;
  const sgm_profiler profiler = record.table();
  size_t updates = 0;
  {
    const RuntimeOwner runtime = profiled(profiler);
    const FieldOwner field = makeField(runtime.get(), compile(runtime.get(), kTwoLayers).get(), 1024);
    CHECK(record.total() == 0);
    CHECK(meshRegion(field.get(), 20'000, nullptr, nullptr) == SGM_OK);
    meshChunks(field.get(), {chunkAt({0, 0, 0, 0}, 63), chunkAt({1, 0, 0, 0})});
    const WorldOwner world = streamFrom(field.get());
    lookFrom(world.get(), 100);
    updates = drawUntil(world.get(), [](const sgm_world_stats& stats) { return stats.chunks_meshed > 0; });
  }
  checkWhole(record);
  for (const std::string& name : kZones) {
    CAPTURE(name);
    CHECK(record.counts[name] > 0);
  }
  CHECK(record.counts["sgm.region"] == 1);
  CHECK(record.counts["sgm.update"] == updates);
  CHECK(record.within[{"", "sgm.region"}] == 1);
  // Compiling a chunk derives a cell of the upper layer, and deriving that cell derives cells of the layer below.
  CHECK(record.within[{"sgm.compile", "sgm.derive"}] > 0);
  CHECK(record.within[{"sgm.derive", "sgm.compile"}] > 0);
  for (const std::string& name : kPlots) CHECK(record.plots[name].size() == updates);
  CHECK(record.threads.size() > 1);
}

TEST_CASE("plots are the world's figures") {
  ZoneRecord record;
  const sgm_profiler profiler = record.table();
  const RuntimeOwner runtime = profiled(profiler);
  const FieldOwner field = makeField(runtime.get(), compile(runtime.get(), kOneLayer).get(), 1024);
  const WorldOwner world = streamFrom(field.get());
  lookFrom(world.get(), 0);
  drawUntil(world.get(), [](const sgm_world_stats& stats) { return stats.idle == 1; });
  REQUIRE(drawFrame(world.get()));
  sgm_world_stats stats = SGM_WORLD_STATS_INIT;
  REQUIRE(sgm_world_get_stats(world.get(), &stats, nullptr) == SGM_OK);
  CHECK(stats.mesh_bytes > 0);
  CHECK(record.plots["sgm.mesh_bytes"].back() == static_cast<double>(stats.mesh_bytes));
  CHECK(record.plots["sgm.queued"].back() == 0);
  CHECK(record.plots["sgm.in_work"].back() == 0);
  const std::vector<double>& queued = record.plots["sgm.queued"];
  CHECK(*std::max_element(queued.begin(), queued.end()) > 0);
}

TEST_CASE("the runtime's own threads say their names before they work", "[threads]") {
  ZoneRecord record;
  const sgm_profiler profiler = record.table();
  {
    const RuntimeOwner runtime = profiled(profiler, 4);
    const FieldOwner field = makeField(runtime.get(), compile(runtime.get(), kBall).get());
    CHECK(meshRegion(field.get(), 40'000, nullptr, nullptr) == SGM_OK);
  }
  std::multiset<std::string> names;
  for (const auto& [thread, said] : record.thread_names) names.insert(said.begin(), said.end());
  CHECK(names == std::multiset<std::string>{"sgm worker 1", "sgm worker 2", "sgm worker 3"});
  record.threads.erase(std::this_thread::get_id());
  for (const std::thread::id thread : record.threads) CHECK(record.thread_names.count(thread) == 1);
}

TEST_CASE("every zone ends where calls fail", "[threads]") {
  ZoneRecord record;
  const sgm_profiler profiler = record.table();
  {
    const RuntimeOwner runtime = profiled(profiler);
    // Derivation fails: the grammar exceeds the limit on shapes.
    const GrammarOwner endless = compile(runtime.get(),
                                         "sgm 1; units m; domain infinite;\nlayer l cell 32m reach 8m { start Many; }\n"
                                         "rule Many { for i in 0..4000000 { at(1m, 1m, 1m) sphere(0.1m); } }\n");
    const FieldOwner capped = makeField(runtime.get(), endless.get(), 1024);
    CHECK(meshRegion(capped.get(), 20'000, nullptr, nullptr) == SGM_ERR_LIMIT);
    CHECK(record.counts["sgm.derive"] > 0);
    CHECK(record.counts["sgm.mesh"] == 0);
    // Compilation fails: every chunk of the world overlaps more cells than the limit allows.
    const GrammarOwner dense = compile(runtime.get(),
                                       "sgm 1; units m; domain infinite;\nlayer l cell 1m reach 0.5m { start Dot; }\n"
                                       "rule Dot { sphere(0.1m); }\n");
    const FieldOwner crowded = makeField(runtime.get(), dense.get(), 4096);
    const WorldOwner world = streamFrom(crowded.get());
    lookFrom(world.get(), 0);
    drawUntil(world.get(), [](const sgm_world_stats& stats) { return stats.chunks_failed > 0; });
    CHECK(sgm_world_update(world.get(), 0, nullptr) == SGM_ERR_INVALID_ARGUMENT);
    CHECK(sgm_world_poll(world.get(), nullptr, 0, nullptr, nullptr) == SGM_ERR_INVALID_ARGUMENT);
  }
  checkWhole(record);
}

TEST_CASE("every zone ends where work is cancelled", "[threads]") {
  std::mt19937 random(20'261'122);
  for (unsigned round = 0; round < sgm::rounds(12); ++round) {
    const uint64_t stop_at = 1 + random() % 20;
    const int frames = static_cast<int>(random() % 6);
    const bool cancels = random() % 2 == 0;
    CAPTURE(round, stop_at, frames, cancels);
    ZoneRecord record;
    const sgm_profiler profiler = record.table();
    {
      const RuntimeOwner runtime = profiled(profiler);
      const FieldOwner field = makeField(runtime.get(), compile(runtime.get(), kTwoLayers).get(), 1024);
      uint64_t last = stop_at;
      const auto stop = [](void* user, uint64_t done, uint64_t) -> int32_t {
        return done >= *static_cast<uint64_t*>(user) ? 1 : 0;
      };
      CHECK(meshRegion(field.get(), 90'000, stop, &last) == SGM_ERR_CANCELLED);
      // Zones must also end if a world is destroyed or stopped during its work.
      const WorldOwner world = streamFrom(field.get());
      lookFrom(world.get(), 0);
      for (int i = 0; i < frames; ++i) {
        REQUIRE(drawFrame(world.get()));
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
      }
      if (cancels) sgm_world_cancel(world.get());
    }
    checkWhole(record);
    CHECK(record.counts["sgm.mesh"] > 0);
  }
}

TEST_CASE("every zone ends where memory gives out", "[threads]") {
  std::mt19937 random(5);
  size_t refused = 0;
  for (unsigned round = 0; round < sgm::rounds(40); ++round) {
    const uint64_t limit = 20'000 + random() % 4'000'000;
    CAPTURE(round, limit);
    ZoneRecord record;
    const sgm_profiler profiler = record.table();
    {
      const RuntimeOwner runtime = profiled(profiler, 3, limit);
      sgm_grammar_desc text = SGM_GRAMMAR_DESC_INIT;
      text.text = kTwoLayers;
      sgm_grammar* grammar = nullptr;
      sgm_field_desc desc = SGM_FIELD_DESC_INIT;
      sgm_field* field = nullptr;
      if (sgm_grammar_compile(runtime.get(), &text, &grammar, nullptr, nullptr) == SGM_OK) {
        desc.grammar = grammar;
        if (sgm_field_create(runtime.get(), &desc, &field, nullptr) == SGM_OK) {
          const sgm_result result = meshRegion(field, 40'000, nullptr, nullptr);
          CHECK((result == SGM_OK || result == SGM_ERR_OUT_OF_MEMORY));
          if (result != SGM_OK) ++refused;
        }
      }
      sgm_field_destroy(field);
      sgm_grammar_destroy(grammar);
    }
    checkWhole(record);
  }
  CHECK(refused > 0);
}

TEST_CASE("a profiler of zones alone suffices, and changes no byte") {
  uint64_t hashes[2] = {};
  for (const bool watched : {false, true}) {
    ZoneRecord record;
    sgm_profiler profiler = record.table();
    profiler.thread = nullptr;
    profiler.plot = nullptr;
    {
      const RuntimeOwner runtime = watched ? profiled(profiler) : makeRuntime();
      const FieldOwner field = makeField(runtime.get(), compile(runtime.get(), kTwoLayers).get(), 1024);
      hashes[watched] = viewOf(meshChunks(field.get(), {chunkAt({0, 0, 0, 0}, 63)})[0]).hash;
      const WorldOwner world = streamFrom(field.get());
      lookFrom(world.get(), 0);
      CHECK(drawFrame(world.get()));
    }
    checkWhole(record);
    CHECK((record.total() > 0) == watched);
    CHECK(record.plots.empty());
    CHECK(record.thread_names.empty());
  }
  CHECK(hashes[0] != 0);
  CHECK(hashes[0] == hashes[1]);
}
