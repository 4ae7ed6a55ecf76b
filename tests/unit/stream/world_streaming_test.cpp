// A streamed world: every frame is the closed frame of its octree, within its caps, whatever the viewers do.

#include <algorithm>
#include <map>
#include <random>
#include <thread>

#include "catch.h"
#include "mesh/check.h"
#include "rounds.h"
#include "stream/frame.h"
#include "stream/world.h"
#include "world_support.h"

using namespace sgm;

namespace {

constexpr int32_t kStreamedCell = 512;

/// The cave without its drips: small cells in plenty would make the tests slow, and nothing else.
std::string caveText() {
  return replaced(sample("cave.sgm"), "layer drip cell 24m reach 5m uses net { start Drips; }", "");
}

/// Jobs that run only when somebody helps, in an order drawn at random: the latest and the most disorderly system that
/// the contract allows.
class LateJobs final : public JobSystem {
 public:
  explicit LateJobs(uint32_t seed) : random_(seed) {}
  ~LateJobs() override {
    while (help()) {
    }
  }
  unsigned concurrency() const override { return 3; }
  void submit(void (*function)(void*), void* argument, int) override {
    const std::lock_guard lock(mutex_);
    jobs_.push_back({function, argument});
  }
  bool help() override {
    std::pair<void (*)(void*), void*> job;
    {
      const std::lock_guard lock(mutex_);
      if (jobs_.empty()) return false;
      std::swap(jobs_[random_() % jobs_.size()], jobs_.back());
      job = jobs_.back();
      jobs_.pop_back();
    }
    job.first(job.second);
    return true;
  }

 private:
  std::mutex mutex_;
  std::mt19937 random_;
  std::vector<std::pair<void (*)(void*), void*>> jobs_;
};

struct Scene {
  explicit Scene(std::unique_ptr<JobSystem> jobs_in, const std::string& text = caveText(),
                 WorldSettings settings_in = {})
      : field(settingsOf(text, kStreamedCell, 3), std::pmr::get_default_resource()),
        jobs(std::move(jobs_in)),
        settings(settings_in) {
    std::pmr::memory_resource* memory = field.memory();
    settings.lod.top = 3;
    settings.lod.finest_cell = kStreamedCell;
    if (settings_in.lod.finest_distance == WorldSettings{}.lod.finest_distance) {
      settings.lod.finest_distance = 20.0 * kUnitsPerMetre;
    }
    settings.lod.view_distance = 120.0 * kUnitsPerMetre;
    Result<std::unique_ptr<Backend>> made = makeBackend({}, *jobs, memory);
    REQUIRE(made);
    backend = std::move(*made);
    Result<std::unique_ptr<World>> created = World::create(field, *backend, *jobs, settings, memory);
    REQUIRE(created);
    world = std::move(*created);
  }

  WorldField field;
  std::unique_ptr<JobSystem> jobs;
  WorldSettings settings;
  std::unique_ptr<Backend> backend;
  std::unique_ptr<World> world;
};

/// An engine that believes nothing but events.
class Engine {
 public:
  struct Shown {
    std::shared_ptr<const ChunkSurface> surface;
    uint8_t seams = 0;
    Neighbourhood coarser = 0;
  };

  /// Bytes that came since the last call.
  size_t take(World& world) {
    using Kind = WorldEvent::Kind;
    size_t bytes = 0;
    world.poll([&](const WorldEvent& event) {
      switch (event.kind) {
        case Kind::ready:
          REQUIRE(event.surface != nullptr);
          ready_[event.key] = event.surface;
          bytes += event.surface->mesh.bytes();
          break;
        case Kind::shown:
          CHECK(shown.count(event.key) == 0);
          shown[event.key] = {surfaceOf(event.key), event.seams, event.coarser};
          break;
        case Kind::replaced:
          REQUIRE(shown.count(event.key) == 1);
          shown[event.key] = {surfaceOf(event.key), event.seams, event.coarser};
          break;
        case Kind::seams:
          REQUIRE(shown.count(event.key) == 1);
          shown[event.key].seams = event.seams;
          shown[event.key].coarser = event.coarser;
          break;
        case Kind::removed:
          CHECK(shown.erase(event.key) + ready_.erase(event.key) > 0);
          break;
        case Kind::failed:
          FAIL(event.error->message);
      }
      return true;
    });
    return bytes;
  }

  std::map<ChunkKey, Shown> shown;

 private:
  const std::shared_ptr<const ChunkSurface>& surfaceOf(const ChunkKey& key) {
    REQUIRE(ready_.count(key) == 1);
    return ready_[key];
  }
  std::map<ChunkKey, std::shared_ptr<const ChunkSurface>> ready_;
};

using PartHashes = std::map<std::pair<ChunkKey, size_t>, ContentHash>;

/// What the engine draws is, part by part, the frame of the octree; and that frame is closed in every vertex.
void checkFrame(const Scene& scene, const Engine& engine) {
  const std::shared_ptr<const DrawnFrame> frame = scene.world->drawn();
  PartHashes drawn, wanted;
  for (const auto& [key, shown] : engine.shown) {
    for (size_t i = 0; i < shown.surface->mesh.ranges.size(); ++i) {
      if (i > 0 && !(shown.seams >> (i - 1) & 1)) continue;
      const PackedRange& range = shown.surface->mesh.ranges[i];
      if (range.index_count > 0) drawn[{key, i}] = range.hash;
    }
  }
  const std::pmr::vector<PlacedChunk> chunks = meshAll(scene.field, frameRequests(frame->tree), 2);
  std::vector<const MeshPart*> parts;
  for (const PlacedChunk& chunk : chunks) {
    std::vector<PlacedPart> placed;
    appendParts(chunk, placed);
    for (const PlacedPart& part : placed) {
      wanted[{chunk.key, static_cast<size_t>(part.number)}] = part.mesh->hash;
      parts.push_back(part.mesh);
    }
  }
  CHECK(drawn == wanted);
  CHECK(checkParts(parts).closed());
}

/// A frame's time of an engine that lends its thread.
void workOrWait(Scene& scene) {
  for (int jobs = 0; jobs < 50; ++jobs) {
    if (!scene.jobs->help()) return std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
}

Viewer viewerAt(double x, double y, double z) {
  Viewer viewer;
  viewer.position = {x * kUnitsPerMetre, y * kUnitsPerMetre, z * kUnitsPerMetre};
  return viewer;
}

/// A walk with turns, and now and then a leap to another part of the world.
Viewer wander(std::mt19937& random, Viewer viewer) {
  const auto step = [&](double most) {
    return (static_cast<double>(random() % 2001) / 1000.0 - 1) * most * kUnitsPerMetre;
  };
  const bool leap = random() % 12 == 0;
  for (size_t axis = 0; axis < 3; ++axis) {
    viewer.position[axis] += leap ? step(150) : step(6);
    viewer.velocity[axis] = leap ? 0 : step(20);
    viewer.direction[axis] = step(1);
  }
  return viewer;
}

}  // namespace

TEST_CASE("every frame of a wandering viewer is the closed frame of its octree") {
  for (uint32_t seed = 1; seed <= rounds(3); ++seed) {
    CAPTURE(seed);
    std::mt19937 random(seed);
    WorldSettings settings;
    settings.by_reach = seed % 2 == 0;
    Scene scene(std::make_unique<LateJobs>(seed), caveText(), settings);
    Engine engine;
    Viewer viewer = viewerAt(96, 96, 96);
    uint64_t frames = 0;
    for (int turn = 0; turn < 40; ++turn) {
      viewer = wander(random, viewer);
      REQUIRE(scene.world->setViewers({&viewer, 1}));
      for (int update = 0; update < 6; ++update) {
        REQUIRE(scene.world->update(size_t{1} << 30));
        engine.take(*scene.world);
        for (auto jobs = random() % 60; jobs > 0 && scene.jobs->help(); --jobs) {
        }
      }
      frames = scene.world->stats().frame;
      if (turn % 8 == 7) checkFrame(scene, engine);
    }
    CHECK(frames > 20);
    REQUIRE(scene.world->waitIdle());
    engine.take(*scene.world);
    checkFrame(scene, engine);
    if (!scene.settings.by_reach) {
      CHECK(scene.world->drawn()->tree == lodTarget(lodViewers({&viewer, 1}, scene.settings.lod), scene.settings.lod));
    }
  }
}

TEST_CASE("a world at rest draws the same by whatever way its viewers came, with any number of threads") {
  std::vector<ContentHash> hashes;
  const IntBox region{{64 * 1024, 64 * 1024, 64 * 1024}, {128 * 1024, 128 * 1024, 128 * 1024}};
  const Viewer goal = viewerAt(100, 96, 96);
  for (const unsigned threads : {1u, 2u, 3u, 8u}) {
    Scene scene(*makeThreadPool(threads));
    Engine engine;
    Viewer viewer = viewerAt(10.0 * threads, 96, 70);
    REQUIRE(scene.world->setViewers({&viewer, 1}));
    if (threads > 1) {
      REQUIRE(scene.world->waitIdle());
      engine.take(*scene.world);
    }
    REQUIRE(scene.world->setViewers({&goal, 1}));
    REQUIRE(scene.world->waitIdle());
    engine.take(*scene.world);
    const Result<ContentHash> hash = scene.world->hashBodies(region, 0);
    REQUIRE(hash);
    hashes.push_back(*hash);
    CHECK(hashes.back() == hashes.front());
  }
  // Streamed or meshed by region.
  const WorldField field(settingsOf(caveText(), kStreamedCell, 3), std::pmr::get_default_resource());
  std::vector<ChunkRequest> requests;
  const Result<std::pmr::vector<ChunkKey>> keys = chunksOfRegion(field, region, 0, 1u << 20);
  for (const ChunkKey& key : *keys) requests.emplace_back().key = key;
  std::vector<PlacedPart> parts;
  const std::pmr::vector<PlacedChunk> chunks = meshAll(field, requests, 2);
  for (const PlacedChunk& chunk : chunks) appendParts(chunk, parts);
  CHECK(hashParts(parts) == hashes.front());
  CHECK(parts.size() > 10);
}

TEST_CASE("no update hands over more bytes than it may") {
  Scene scene(*makeThreadPool(2));
  Engine engine;
  const Viewer viewer = viewerAt(96, 96, 96);
  REQUIRE(scene.world->setViewers({&viewer, 1}));
  constexpr size_t kMost = 200'000;
  size_t most = 0, updates = 0;
  while (!scene.world->stats().idle && ++updates < 100'000) {
    REQUIRE(scene.world->update(kMost));
    most = std::max(most, engine.take(*scene.world));
    workOrWait(scene);
  }
  CHECK(scene.world->stats().idle);
  CHECK(most <= kMost);
  CHECK(most > kMost / 4);
  checkFrame(scene, engine);
}

TEST_CASE("a mesh that is too large to be handed over is told of, and what is coarser stays") {
  Scene scene(*makeThreadPool(2));
  const Viewer viewer = viewerAt(96, 96, 96);
  REQUIRE(scene.world->setViewers({&viewer, 1}));
  size_t failed = 0;
  for (int updates = 0; updates < 100'000 && !scene.world->stats().idle; ++updates) {
    REQUIRE(scene.world->update(20'000));
    scene.world->poll([&](const WorldEvent& event) {
      if (event.kind == WorldEvent::Kind::failed) {
        ++failed;
        CHECK(event.error->code == Code::limit);
      }
      return true;
    });
    workOrWait(scene);
  }
  CHECK(scene.world->stats().idle);
  CHECK(failed > 0);
}

TEST_CASE("surfaces stay below their cap, and detail comes nearer instead") {
  WorldSettings settings;
  settings.lod.finest_distance = 60.0 * kUnitsPerMetre;
  settings.mesh_bytes = size_t{21} << 20;
  Scene scene(*makeThreadPool(2),
              "sgm 1; units m; domain infinite; layer l cell 16m reach 1m { start Balls; }\n"
              "rule Balls { for x in 0..1 { for y in 0..1 { for z in 0..1 { at(2m+4m*x, 2m+4m*y, 2m+4m*z) "
              "sphere(1.6m); } } } }",
              settings);
  Engine engine;
  const Viewer viewer = viewerAt(96, 96, 96);
  REQUIRE(scene.world->setViewers({&viewer, 1}));
  for (int updates = 0; updates < 100'000 && !scene.world->stats().idle; ++updates) {
    REQUIRE(scene.world->update(size_t{1} << 30));
    engine.take(*scene.world);
    workOrWait(scene);
  }
  const WorldStats stats = scene.world->stats();
  CAPTURE(stats.surface_bytes, stats.peak_surface_bytes, stats.planner.detail);
  CHECK(stats.idle);
  CHECK(stats.planner.detail < 1);
  CHECK(stats.peak_surface_bytes <= settings.mesh_bytes);
  CHECK(stats.peak_surface_bytes > settings.mesh_bytes / 8);
  checkFrame(scene, engine);
}

TEST_CASE("a cap too small to stream with is refused, with how much is needed") {
  Scene scene(*makeThreadPool(2));
  WorldSettings settings = scene.settings;
  settings.mesh_bytes = size_t{1} << 20;
  const Result<std::unique_ptr<World>> refused =
      World::create(scene.field, *scene.backend, *scene.jobs, settings, scene.field.memory());
  REQUIRE_FALSE(refused);
  CHECK(refused.error().code == Code::limit);
}

TEST_CASE("viewers that make no sense are refused, and the world goes on") {
  Scene scene(*makeThreadPool(1));
  Viewer good = viewerAt(96, 96, 96);
  REQUIRE(scene.world->setViewers({&good, 1}));
  REQUIRE(scene.world->waitIdle());
  const uint64_t frame = scene.world->stats().frame;
  const auto refused = [&](const Viewer& viewer, Code code) {
    const Result<void> set = scene.world->setViewers({&viewer, 1});
    REQUIRE_FALSE(set);
    CHECK(set.error().code == code);
  };
  Viewer bad = good;
  bad.position[1] = std::numeric_limits<double>::quiet_NaN();
  refused(bad, Code::invalid_argument);
  bad = viewerAt(0, 3000e3, 0);
  refused(bad, Code::range);
  bad = good;
  bad.velocity[2] = 1e9 * kUnitsPerMetre;
  refused(bad, Code::range);
  bad = good;
  bad.weight = 0;
  refused(bad, Code::invalid_argument);
  bad = good;
  bad.fov = 4;
  refused(bad, Code::invalid_argument);
  CHECK(scene.world->stats().frame == frame);
  CHECK(scene.world->stats().idle);
}

TEST_CASE("a world ends while it is at work, and without viewers it rests") {
  for (uint32_t seed = 1; seed <= rounds(5); ++seed) {
    CAPTURE(seed);
    std::mt19937 random(seed);
    Scene scene(*makeThreadPool(2));
    const Viewer viewer = viewerAt(96, 96, 96);
    REQUIRE(scene.world->setViewers({&viewer, 1}));
    for (auto i = random() % 20; i > 0; --i) {
      REQUIRE(scene.world->update(size_t{1} << 30));
      scene.world->poll([](const WorldEvent&) { return true; });
      scene.jobs->help();
    }
    if (seed % 2 == 0) {
      scene.world->cancel();
      REQUIRE(scene.world->setViewers({}));
      const uint64_t meshed = scene.world->stats().planner.meshed;
      REQUIRE(scene.world->waitIdle());
      CHECK(scene.world->stats().planner.meshed <= meshed + 64);
    }
  }
}

TEST_CASE("surfaces may be let go of on any thread, after the world's end too") {
  std::vector<std::shared_ptr<const ChunkSurface>> kept;
  Scene scene(*makeThreadPool(2));
  const Viewer viewer = viewerAt(96, 96, 96);
  REQUIRE(scene.world->setViewers({&viewer, 1}));
  REQUIRE(scene.world->waitIdle());
  scene.world->poll([&](const WorldEvent& event) {
    if (event.surface != nullptr) kept.push_back(event.surface);
    return true;
  });
  scene.world.reset();
  REQUIRE(kept.size() > 10);
  CHECK(kept.front()->mesh.vertices.size() > 0);
  kept.clear();
}
