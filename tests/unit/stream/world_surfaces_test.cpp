// Tests measures and texture coordinates of a streamed world's surfaces: they equal those of each chunk alone.

#include <cmath>

#include "catch.h"
#include "chunk/surface_shapes.h"
#include "measure/measure_chunk.h"
#include "streaming_support.h"

using namespace sgm;
using namespace sgm::measure;

TEST_CASE("a streamed world sums the measures of what it draws", "[threads]") {
  WorldSettings settings;
  settings.measure = true;
  Scene scene(*makeThreadPool(2), caveText(), settings);
  Engine engine;
  std::mt19937 random(29);
  Viewer viewer = viewerAt(112, 96, 96);
  for (int step = 0; step < 3; ++step, viewer = wander(random, viewer)) {
    lookFrom(scene, engine, viewer);
    const std::optional<WorldMeasures> measures = scene.world->measures();
    REQUIRE(measures);
    CHECK(measures->drawn.sound());
    CHECK(measures->made.sums.sound());
    CHECK(measures->drawn.area > 0);
    for (const double component : measures->drawn.area_vector)
      CHECK(std::fabs(component) < 1e-9 * measures->drawn.area);
    SurfaceSums drawn;
    for (const auto& [key, shown] : engine.shown) {
      REQUIRE(shown.surface->measures);
      ChunkMeasures again;
      MeasureScratch scratch(std::pmr::get_default_resource());
      measureBody(viewOf(shown.surface->mesh, 0), {}, scratch, again);
      for (size_t face = 0; face < 6; ++face)
        again.parts[1 + face] = measureSeam(viewOf(shown.surface->mesh, 1 + face));
      again.topology.compared = shown.surface->measures->topology.compared;
      CHECK(again == *shown.surface->measures);
      drawn.add(again, shown.surface->grid, true, shown.seams);
    }
    CHECK(drawn == measures->drawn);
    CHECK(measures->made.sums.triangles >= drawn.triangles);
    CHECK(measures->made.sums.compared > 0);
    CHECK(measures->made.measuring > 0);
    CHECK(measures->made.meshing > 0);
  }
  CHECK_FALSE(Scene(*makeThreadPool(1)).world->measures());
}

TEST_CASE("a world that is asked to has texture coordinates on all that it draws, edits and fields included",
          "[threads]") {
  WorldSettings settings;
  settings.texture = true;
  Scene scene(*makeThreadPool(2), caveText(), settings);
  Engine engine;
  const Viewer viewer = viewerAt(96, 96, 96);
  REQUIRE(scene.world->setViewers({&viewer, 1}));
  EditLog log{EditSettings{}};
  const auto check = [&](const WorldField& field) {
    comeToRest(scene, engine);
    REQUIRE(log.import(scene.world->exportEdits(log.size())));
    size_t triangles = 0;
    for (const auto& [key, shown] : engine.shown) {
      const ChunkSurface& surface = *shown.surface;
      REQUIRE(surface.texture.corners.size() == surface.mesh.indices.size());
      for (size_t i = 0; i < surface.mesh.indices.size(); ++i) {
        REQUIRE(surface.texture.wedges[surface.texture.corners[i]].vertex == surface.mesh.indices[i]);
      }
      const std::shared_ptr<const EditSnapshot> edits = log.snapshot();
      const Result<Unwrapped> alone =
          unwrapChunk(field, surface.mesh, surface.grid, edits.get(), kTile, field.memory());
      REQUIRE(alone);
      CHECK(*alone == surface.texture);
      triangles += surface.mesh.indices.size() / 3;
    }
    CHECK(triangles > 1000);
  };
  check(scene.field);
  Brush brush;
  brush.cut = true;
  brush.from = {96 << 10, 100 << 10, 96 << 10};
  brush.radius = 12 << 10;
  REQUIRE(scene.world->edit(brush));
  check(scene.field);
  WorldFieldSettings other = settingsOf(caveText(), kStreamedCell, 3);
  REQUIRE(other.parameters.set(*other.program, "boxy", 0.9));
  const auto boxy = std::make_shared<const WorldField>(std::move(other), std::pmr::get_default_resource());
  REQUIRE(scene.world->setField(boxy));
  check(*boxy);
}
