// Tests a streamed world: every frame is the closed frame of its octree and within its limits, however the viewers
// move.

#include <algorithm>
#include <limits>
#include <map>

#include "catch.h"
#include "rounds.h"
#include "streaming_support.h"

using namespace sgm;

namespace {

/// Distance in units from a place along the x axis to the nearest drawn surface. side: 1 or -1, the direction.
double wallAlong(const Engine& engine, const std::array<double, 3>& from, double side) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const auto& [key, shown] : engine.shown) {
    const PackedMesh& mesh = shown.surface->mesh;
    for (size_t part = 0; part < mesh.ranges.size(); ++part) {
      if (part > 0 && !(shown.seams >> (part - 1) & 1)) continue;
      const PackedRange& range = mesh.ranges[part];
      for (uint32_t i = range.first_index; i < range.first_index + range.index_count; i += 3) {
        // The triangle's corners relative to a line along the x axis. Seen along this line, the line and each two
        // corners form a triangle. If the signed areas of these three triangles have the same sign, the line passes
        // through the original triangle.
        std::array<std::array<double, 3>, 3> p{};
        for (size_t c = 0; c < 3; ++c) {
          const Int3 at = vertexUnits(shown.surface->grid, mesh.vertices[mesh.indices[i + c]]);
          p[c] = {(at.x - from[0]) * side, at.y - from[1] + 0.25, at.z - from[2] + 0.125};
        }
        std::array<double, 3> area{};
        for (size_t c = 0; c < 3; ++c) {
          const auto &a = p[(c + 1) % 3], &b = p[(c + 2) % 3];
          area[c] = a[1] * b[2] - a[2] * b[1];
        }
        const double sum = area[0] + area[1] + area[2];
        const bool crossed = (area[0] > 0 && area[1] > 0 && area[2] > 0) || (area[0] < 0 && area[1] < 0 && area[2] < 0);
        if (!crossed) continue;
        const double x = (area[0] * p[0][0] + area[1] * p[1][0] + area[2] * p[2][0]) / sum;
        if (x > 0) nearest = std::min(nearest, x);
      }
    }
  }
  return nearest;
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
    comeToRest(scene, engine);
    checkFrame(scene, engine);
    if (!scene.settings.by_reach) {
      CHECK(scene.world->drawn()->tree == lodTarget(lodViewers({&viewer, 1}, scene.settings.lod), scene.settings.lod));
    }
  }
}

TEST_CASE("a passage that a level leaves out ends in no larger a wall than is stated") {
  // The wall may appear as large as sgm.h states at sgm_world_desc.finest_distance. Sizes are in pixels of a screen
  // whose focal length is 1 pixel.
  const double width = 8, wider = 1;  // metres: width of the passage; edge of the first cell wider than its `detail`
  const std::string text = replaced(sample("passage.sgm"), "detail 4m", "detail 0.9990234375m");
  Scene scene(*makeThreadPool(2), text);
  const double cell = static_cast<double>(kStreamedCell) / kUnitsPerMetre;
  const double finest = scene.settings.lod.finest_distance / kUnitsPerMetre;
  const double stated = 2 * cell / finest * width / wider;
  Engine engine;
  double largest = 0;
  for (uint32_t seed = 1; seed <= rounds(6); ++seed) {
    CAPTURE(seed);
    std::mt19937 random(seed);
    const double at = static_cast<double>(random() % 64'000) / 1000;
    const Viewer viewer = viewerAt(at, 0, 0);
    lookFrom(scene, engine, viewer);
    for (const double side : {-1.0, 1.0}) {
      const double wall = wallAlong(engine, viewer.position, side) / kUnitsPerMetre;
      CAPTURE(at, side, wall);
      // The wall is nearer than the end of the view distance.
      CHECK(wall < scene.settings.lod.view_distance / kUnitsPerMetre);
      CHECK(width / wall <= stated);
      largest = std::max(largest, width / wall);
    }
  }
  CHECK(largest > stated / 2);
}

TEST_CASE("a world at rest draws the same by whatever way its viewers came, with any number of threads", "[threads]") {
  std::vector<ContentHash> hashes;
  const IntBox region{{64 * 1024, 64 * 1024, 64 * 1024}, {128 * 1024, 128 * 1024, 128 * 1024}};
  const Viewer goal = viewerAt(100, 96, 96);
  for (const unsigned threads : {1u, 2u, 3u, 8u}) {
    Scene scene(*makeThreadPool(threads));
    Engine engine;
    Viewer viewer = viewerAt(10.0 * threads, 96, 70);
    REQUIRE(scene.world->setViewers({&viewer, 1}));
    if (threads > 1) {
      comeToRest(scene, engine);
    }
    lookFrom(scene, engine, goal);
    const Result<ContentHash> hash = scene.world->hashBodies(region, 0);
    REQUIRE(hash);
    hashes.push_back(*hash);
    CHECK(hashes.back() == hashes.front());
  }
  // Streaming and meshing a region give the same hash.
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

TEST_CASE("no update hands over more bytes than it may, and a small budget loses nothing", "[threads]") {
  const Viewer viewer = viewerAt(96, 96, 96);
  std::map<ChunkKey, ContentHash> whole;
  for (const size_t budget : {std::numeric_limits<size_t>::max(), size_t{200'000}, size_t{15'000}}) {
    CAPTURE(budget);
    Scene scene(*makeThreadPool(2));
    Engine engine;  // the engine fails the test if a chunk fails
    REQUIRE(scene.world->setViewers({&viewer, 1}));
    // beyond: number of bytes that were delivered in excess of the budgets, and that later budgets have not yet made up
    // for.
    size_t updates = 0, beyond = 0, largest = 0;
    while (!scene.world->stats().idle && ++updates < 100'000) {
      REQUIRE(scene.world->update(budget));
      const size_t bytes = engine.take(*scene.world);
      beyond = beyond + bytes > budget ? beyond + bytes - budget : 0;
      for (const auto& [key, shown] : engine.shown) largest = std::max(largest, shown.surface->mesh.bytes());
      CHECK(beyond <= std::max<size_t>(largest, size_t{1} << 17));
      workOrWait(scene);
    }
    CHECK(scene.world->stats().idle);
    CHECK(scene.world->stats().planner.failed == 0);
    std::map<ChunkKey, ContentHash> drawn;
    for (const auto& [key, shown] : engine.shown) drawn[key] = shown.surface->mesh.ranges[0].hash;
    if (whole.empty()) whole = drawn;
    CHECK(drawn == whole);
    checkFrame(scene, engine);
  }
}

TEST_CASE("a wandering viewer's world comes to rest whatever its updates may hand over", "[threads]") {
  for (uint32_t seed = 1; seed <= rounds(3); ++seed) {
    CAPTURE(seed);
    std::mt19937 random(seed);
    Scene scene(*makeThreadPool(2));
    Engine engine;
    Viewer viewer = viewerAt(96, 96, 96);
    uint64_t frames = 0;
    for (int turn = 0; turn < 12; ++turn) {
      viewer = wander(random, viewer);
      REQUIRE(scene.world->setViewers({&viewer, 1}));
      const size_t bytes = turn % 2 == 0 ? size_t{1} << 30 : 10'000;
      for (int updates = 0; updates < 100'000 && !scene.world->stats().idle; ++updates) {
        REQUIRE(scene.world->update(bytes));
        engine.take(*scene.world);
        workOrWait(scene);
      }
      CHECK(scene.world->stats().idle);
      checkFrame(scene, engine);
      frames = scene.world->stats().frame;
    }
    CHECK(frames > 12);
    CHECK(scene.world->stats().planner.failed == 0);
  }
}

TEST_CASE("a viewer that never rests sees something new, however little its updates may hand over") {
  Scene scene(*makeThreadPool(2));
  Engine engine;
  Viewer viewer = viewerAt(96, 96, 96);
  // The viewer moves before each update, and the budget of each update is smaller than the changes that the move
  // causes.
  for (int updates = 0; updates < 50'000 && scene.world->stats().frame < 4; ++updates) {
    viewer.position[0] += 0.02 * kUnitsPerMetre;
    REQUIRE(scene.world->setViewers({&viewer, 1}));
    REQUIRE(scene.world->update(3000));
    engine.take(*scene.world);
    workOrWait(scene);
  }
  CHECK(scene.world->stats().frame >= 4);
  checkFrame(scene, engine);
}

TEST_CASE("surfaces stay below their cap, and detail comes nearer instead", "[costly]") {
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

TEST_CASE("jobs that run at once, where they are submitted, mesh a chunk an update and no more") {
  /// A job system without threads, which cannot queue any jobs either.
  class NoJobs final : public JobSystem {
   public:
    unsigned concurrency() const override { return 1; }
    void submit(void (*function)(void*), void* argument, int) override {
      deepest = std::max(deepest, ++depth);
      function(argument);
      --depth;
    }
    bool help() override { return false; }
    int depth = 0, deepest = 0;
  };
  Scene scene(std::make_unique<NoJobs>());
  Engine engine;
  const Viewer viewer = viewerAt(96, 96, 96);
  REQUIRE(scene.world->setViewers({&viewer, 1}));
  uint64_t before = 0, most = 0;
  for (int updates = 0; updates < 100'000 && !scene.world->stats().idle; ++updates) {
    REQUIRE(scene.world->update(size_t{1} << 30));
    engine.take(*scene.world);
    const WorldStats stats = scene.world->stats();
    most = std::max(most, stats.planner.meshed + stats.planner.seam_jobs - before);
    before = stats.planner.meshed + stats.planner.seam_jobs;
  }
  CHECK(scene.world->stats().idle);
  CHECK(most <= 2);
  CHECK(static_cast<const NoJobs&>(*scene.jobs).deepest < 8);
  checkFrame(scene, engine);
}

TEST_CASE("while there is always something to mesh no jobs pile up that have nothing to do") {
  /// A job system with one worker, which runs the most urgent job; among equally urgent jobs, it runs the one that has
  /// waited longest.
  class OneWorker final : public JobSystem {
   public:
    ~OneWorker() override {
      while (help()) {
      }
    }
    unsigned concurrency() const override { return 2; }
    void submit(void (*function)(void*), void* argument, int priority) override {
      jobs_.emplace(std::pair(-priority, submitted_++), std::pair(function, argument));
      most = std::max(most, jobs_.size());
    }
    bool help() override {
      if (jobs_.empty()) return false;
      const auto job = jobs_.extract(jobs_.begin()).mapped();
      job.first(job.second);
      return true;
    }
    size_t most = 0;

   private:
    std::map<std::pair<int, uint64_t>, std::pair<void (*)(void*), void*>> jobs_;
    uint64_t submitted_ = 0;
  };
  Scene scene(std::make_unique<OneWorker>());
  Engine engine;
  Viewer viewer = viewerAt(96, 96, 96);
  uint64_t meshed = 0;
  bool always = true;  // whether the world always had a chunk to mesh
  for (int updates = 0; updates < 300; ++updates) {
    viewer.position[0] += 2.0 * kUnitsPerMetre;
    REQUIRE(scene.world->setViewers({&viewer, 1}));
    REQUIRE(scene.world->update(size_t{1} << 30));
    engine.take(*scene.world);
    for (int jobs = 0; jobs < 4; ++jobs) scene.jobs->help();
    const WorldStats stats = scene.world->stats();
    meshed = stats.planner.meshed;
    always = always && (updates < 2 || stats.queued + stats.in_work > 0);
  }
  CHECK(always);
  CHECK(meshed > 200);
  CHECK(static_cast<const OneWorker&>(*scene.jobs).most < 20);
}

TEST_CASE("a world ends while it is at work, and without viewers it rests", "[threads]") {
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

TEST_CASE("surfaces may be let go of on any thread, after the world's end too", "[threads]") {
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

TEST_CASE("a chunk with more anchors than fit into what is reserved for it fails, and nothing else does") {
  // All shapes of the grammar are in the chunk at the origin.
  const std::string text =
      "sgm 1; units m; start Main;\n"
      "rule Main { repeat 250 rot(y, 1deg) { repeat 250 rot(x, 1deg) { anchor spawn \"x\"; } } sphere(12m); }\n";
  WorldSettings settings;
  settings.collider_distance = 8.0 * kUnitsPerMetre;
  Scene scene(*makeThreadPool(2), text, settings);
  const Viewer viewer = viewerAt(4, 4, 4);
  REQUIRE(scene.world->setViewers({&viewer, 1}));
  REQUIRE(scene.world->waitIdle());
  uint64_t failed = 0;
  scene.world->poll([&](const WorldEvent& event) {
    if (event.kind == WorldEvent::Kind::failed) {
      ++failed;
      CHECK(event.error->code == Code::limit);
      CHECK(event.error->message.find("place fewer anchors") != std::string::npos);
      CHECK(event.key.level == 0);
    }
    return true;
  });
  CHECK(failed > 0);
  CHECK(scene.world->drawn()->drawn.size() >= 8);
  CHECK(scene.world->stats().peak_surface_bytes <= settings.mesh_bytes);
}
