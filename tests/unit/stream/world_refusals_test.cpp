// Tests that a streamed world refuses caps, distances and viewers that it cannot serve, and goes on afterwards.

#include <limits>

#include "catch.h"
#include "streaming_support.h"

using namespace sgm;

TEST_CASE("a cap too small to stream with is refused, with how much is needed") {
  Scene scene(*makeThreadPool(2));
  WorldSettings settings = scene.settings;
  settings.mesh_bytes = size_t{1} << 20;
  const Result<std::unique_ptr<World>> refused =
      World::create(external(scene.field), *scene.backend, *scene.jobs, settings, scene.field.memory());
  REQUIRE_FALSE(refused);
  CHECK(refused.error().code == Code::limit);
}

TEST_CASE("distances that would take too many chunks are refused, with what would do") {
  Scene scene(*makeThreadPool(1));
  const auto refused = [&](double finest, double view, Code code, const std::string& says) {
    WorldSettings settings = scene.settings;
    settings.lod.finest_distance = finest;
    settings.lod.view_distance = view;
    const Result<std::unique_ptr<World>> world =
        World::create(external(scene.field), *scene.backend, *scene.jobs, settings, scene.field.memory());
    REQUIRE_FALSE(world);
    CHECK(world.error().code == code);
    CHECK(world.error().message.find(says) != std::string::npos);
  };
  refused(20.0 * kUnitsPerMetre, 1e6 * kUnitsPerMetre, Code::limit, "coarsest level");
  refused(5e4 * kUnitsPerMetre, 120.0 * kUnitsPerMetre, Code::limit, "larger cells");
  refused(0, 1000, Code::invalid_argument, "above 0");
  refused(1000, std::numeric_limits<double>::infinity(), Code::invalid_argument, "finite");
}

TEST_CASE("viewers of great weight see as far as can be planned, and too many are refused") {
  Scene scene(*makeThreadPool(1));
  Viewer viewer = viewerAt(96, 96, 96);
  viewer.weight = 100;
  viewer.fov = 0.05;
  REQUIRE(scene.world->setViewers({&viewer, 1}));
  for (int updates = 0; updates < 100'000 && scene.world->stats().plans == 0; ++updates) {
    REQUIRE(scene.world->update(size_t{1} << 30));
    scene.world->poll([](const WorldEvent&) { return true; });
    workOrWait(scene);
  }
  CHECK(scene.world->stats().plans > 0);
  // The number includes coarser chunks that are drawn until the finer ones are ready.
  CHECK(scene.world->stats().queued < static_cast<size_t>(kMaxExpectedLeaves * 9 / 8));
  const std::vector<Viewer> many(kMaxViewers + 1, viewer);
  const Result<void> set = scene.world->setViewers(many);
  REQUIRE_FALSE(set);
  CHECK(set.error().code == Code::limit);
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
