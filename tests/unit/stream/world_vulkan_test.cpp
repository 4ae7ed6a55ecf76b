// Tests a world that is streamed from a Vulkan device: its surface is closed in every frame, and in the end equals the
// surface that the CPU meshes.

#include <cstdlib>
#include <iostream>

#include "backend/open/open_backend.h"
#include "streaming_support.h"

using namespace sgm;

TEST_CASE("a world that a Vulkan device meshes is closed as it streams, and comes to rest as the CPU's") {
  // The grammar uses few kinds of instructions, because software Vulkan compiles its shaders anew for each kind.
  const std::string balls =
      "sgm 1; units m; domain infinite; layer l cell 16m reach 1m { start Balls; }\n"
      "rule Balls { for x in 0..1 { for z in 0..1 { at(4m+8m*x, 8m, 4m+8m*z) sphere(2.6m); } } }";
  const BackendRequest vulkan{BackendKind::vulkan, false, -1, {}};
  {
    const auto jobs = *makeThreadPool(1);
    const auto backend = makeBackend(vulkan, *jobs, std::pmr::get_default_resource());
    if (!backend) {
      INFO(backend.error().message);
      REQUIRE(std::getenv("SGM_REQUIRE_VULKAN") == nullptr);
      std::cerr << "SKIPPED: " << backend.error().message << '\n';
      return;
    }
  }
  constexpr uint32_t kSeed = 3;
  CAPTURE(kSeed);
  std::mt19937 random(kSeed);
  Scene scene(*makeThreadPool(2), balls, {}, {}, vulkan);
  Engine engine;
  Viewer viewer = viewerAt(96, 96, 96);
  for (int turn = 0; turn < 6; ++turn) {
    viewer = wander(random, viewer);
    REQUIRE(scene.world->setViewers({&viewer, 1}));
    for (int update = 0; update < 20; ++update) {
      REQUIRE(scene.world->update(size_t{1} << 30));
      engine.take(*scene.world);
      workOrWait(scene);
    }
    checkFrame(scene, engine);
  }
  comeToRest(scene, engine);
  checkFrame(scene, engine);
  CHECK(engine.shown.size() > 10);
  CHECK(scene.backend->counters().batches > 0);
  CHECK(scene.backend->counters().device_lost == 0);

  Scene same(*makeThreadPool(2), balls, {});
  REQUIRE(same.world->setViewers({&viewer, 1}));
  REQUIRE(same.world->waitIdle());
  Int3 middle;
  for (int axis = 0; axis < 3; ++axis) middle[axis] = static_cast<int32_t>(viewer.position[static_cast<size_t>(axis)]);
  const IntBox near = IntBox{middle, middle}.grown(16 * kUnitsPerMetre);
  const auto hash = scene.world->hashBodies(near, 0), expected = same.world->hashBodies(near, 0);
  REQUIRE(hash);
  REQUIRE(expected);
  CHECK(*hash == *expected);
  CHECK(*hash != ContentHash{});
}
