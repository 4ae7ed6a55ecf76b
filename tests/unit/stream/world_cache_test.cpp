// Tests a world with a cache folder.

#include "store/disk_cache_support.h"
#include "streaming_support.h"

using namespace sgm;

namespace {

/// Number of bodies and seams of chunks that the engine draws and that have a surface.
size_t drawnParts(const sgm::Engine& engine) {
  size_t count = 0;
  for (const auto& [key, shown] : engine.shown) {
    for (size_t i = 0; i < shown.surface->mesh.ranges.size(); ++i) {
      const bool drawn = i == 0 || (shown.seams >> (i - 1) & 1) != 0;
      count += drawn && shown.surface->mesh.ranges[i].index_count > 0;
    }
  }
  return count;
}

}  // namespace

TEST_CASE("a world takes from the disk cache what an earlier one has meshed, and draws the same", "[threads]") {
  const CacheFolder folder;
  WorldSettings settings;
  settings.cache = folder.path;
  const Viewer viewer = viewerAt(96, 96, 96);
  const IntBox region{{64 * 1024, 64 * 1024, 64 * 1024}, {128 * 1024, 128 * 1024, 128 * 1024}};
  ContentHash first;
  for (const bool again : {false, true}) {
    CAPTURE(again);
    sgm::Scene scene(*makeThreadPool(2), caveText(), settings);
    sgm::Engine engine;
    lookFrom(scene, engine, viewer);
    checkFrame(scene, engine);
    const ContentHash hash = *scene.world->hashBodies(region, 0);
    const DiskCacheStats cache = scene.world->stats().cache;
    if (again) {
      CHECK(hash == first);
      // Both worlds end with the same frame. Before that, they mesh different coarse chunks, depending on the timing of
      // their threads. The second world stores those chunks that the first one has not stored.
      const size_t drawn = drawnParts(engine);
      CHECK(drawn > 50);
      CHECK(cache.hits >= drawn);
    } else {
      first = hash;
      CHECK(cache.stored > 50);
    }
    CHECK(cache.damaged == 0);
    CHECK(cache.errors == 0);
  }
}

TEST_CASE("what is read from the disk measures as what was meshed, but for the samples", "[threads]") {
  const CacheFolder folder;
  WorldSettings settings;
  settings.cache = folder.path;
  settings.measure = true;
  const Viewer viewer = viewerAt(96, 96, 96);
  measure::SurfaceSums meshed;
  for (const bool again : {false, true}) {
    CAPTURE(again);
    sgm::Scene scene(*makeThreadPool(2), caveText(), settings);
    REQUIRE(scene.world->setViewers({&viewer, 1}));
    REQUIRE(scene.world->waitIdle());
    std::optional<WorldMeasures> measures = scene.world->measures();
    REQUIRE(measures);
    CHECK(measures->made.sums.sound());
    CHECK(measures->made.sums.triangles >= measures->drawn.triangles);
    if (!again) {
      meshed = measures->drawn;
      CHECK(meshed.triangles > 1000);
      CHECK(meshed.compared > 0);
      continue;
    }
    CHECK(scene.world->stats().cache.hits > 50);
    CHECK(measures->drawn.compared < meshed.compared);
    measures->drawn.compared = meshed.compared;
    CHECK(measures->drawn == meshed);
  }
}
