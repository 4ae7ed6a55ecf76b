// Tests edits of a streamed world: each frame is closed and shows one state of the edits, digs are drawn soon, and
// worlds that exchange edits become equal.

#include <algorithm>
#include <filesystem>

#include "catch.h"
#include "rounds.h"
#include "streaming_support.h"
#include "temporary_folder.h"
#include "world/edits_support.h"

using namespace sgm;

namespace {

/// Edits a world, and records the brushes after every edit.
class Editor {
 public:
  explicit Editor(World& world) : world_(world), states_{nullptr} {}

  EditId lay(const Brush& brush) {
    const Result<EditId> id = world_.edit(brush);
    REQUIRE(id);
    remember();
    return *id;
  }
  EditId undo(EditId id) {
    const Result<EditId> undone = world_.undo(id);
    REQUIRE(undone);
    remember();
    return *undone;
  }
  /// The brushes of the edit state with this number.
  const EditSnapshot* at(uint64_t state) const { return states_.at(state).get(); }

 private:
  void remember() {
    REQUIRE(log_.import(world_.exportEdits(log_.size())));
    if (world_.stats().edits == states_.size()) states_.push_back(log_.snapshot());
    REQUIRE(world_.stats().edits + 1 == states_.size());
  }

  World& world_;
  EditLog log_{EditSettings{}};
  std::vector<std::shared_ptr<const EditSnapshot>> states_;
};

Brush dig(const Viewer& viewer, double x, double y, double z, double radius) {
  Brush brush;
  brush.cut = true;
  const std::array<double, 3> off{x, y, z};
  for (int axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<size_t>(axis);
    brush.from[axis] = static_cast<int32_t>(viewer.position[a] + off[a] * kUnitsPerMetre);
  }
  brush.radius = static_cast<int32_t>(radius * kUnitsPerMetre);
  return brush;
}

Brush randomEdit(std::mt19937& random, const Viewer& viewer) {
  IntBox around;
  for (int axis = 0; axis < 3; ++axis) {
    const auto at = static_cast<int32_t>(viewer.position[static_cast<size_t>(axis)]);
    around.lo[axis] = at - 40 * kUnitsPerMetre;
    around.hi[axis] = at + 40 * kUnitsPerMetre;
  }
  Brush brush = randomBrush(random, around, (random() % 8 == 0 ? 30 : 4) * kUnitsPerMetre);
  brush.material = brush.tag = 0;
  return brush;
}

}  // namespace

TEST_CASE("every frame shows one state of the edits, and is closed") {
  for (uint32_t seed = 1; seed <= rounds(3); ++seed) {
    CAPTURE(seed);
    std::mt19937 random(seed);
    WorldSettings settings;
    settings.by_reach = seed % 2 == 0;
    Scene scene(std::make_unique<LateJobs>(seed), caveText(), settings);
    Engine engine;
    Editor editor(*scene.world);
    Viewer viewer = viewerAt(96, 96, 96);
    std::vector<EditId> made;
    for (int turn = 0; turn < 40; ++turn) {
      viewer = wander(random, viewer);
      REQUIRE(scene.world->setViewers({&viewer, 1}));
      for (auto edits = random() % 4; edits > 0; --edits) {
        made.push_back(!made.empty() && random() % 4 == 0 ? editor.undo(made[random() % made.size()])
                                                          : editor.lay(randomEdit(random, viewer)));
      }
      for (int update = 0; update < 8; ++update) {
        REQUIRE(scene.world->update(size_t{1} << 30));
        engine.take(*scene.world);
        for (auto jobs = random() % 90; jobs > 0 && scene.jobs->help(); --jobs) {
        }
      }
      if (turn % 5 == 4) checkFrame(scene, engine, editor.at(scene.world->drawn()->edits));
    }
    CHECK(scene.world->drawn()->edits > 0);
    comeToRest(scene, engine);
    checkFrame(scene, engine, editor.at(scene.world->stats().edits));
    CHECK(scene.world->stats().edits_drawn == scene.world->stats().edits);
  }
}

TEST_CASE("a dig is in the next frame of changes or the one after, while the viewer moves", "[threads]") {
  for (uint32_t seed = 1; seed <= rounds(3); ++seed) {
    CAPTURE(seed);
    std::mt19937 random(seed);
    Scene scene(*makeThreadPool(2));
    Viewer viewer = viewerAt(96, 96, 96);
    REQUIRE(scene.world->setViewers({&viewer, 1}));
    REQUIRE(scene.world->waitIdle());
    scene.world->poll([](const WorldEvent&) { return true; });
    for (int digs = 0; digs < 12; ++digs) {
      for (double& p : viewer.position) p += 1.5 * kUnitsPerMetre;
      REQUIRE(scene.world->setViewers({&viewer, 1}));
      REQUIRE(scene.world->edit(dig(viewer, 3, 0, static_cast<double>(random() % 8), 4)));
      const uint64_t state = scene.world->stats().edits;
      uint64_t before = scene.world->drawn()->number, frames = 0;
      for (int updates = 0; updates < 100'000 && scene.world->stats().edits_drawn < state; ++updates) {
        REQUIRE(scene.world->update(size_t{1} << 30));
        scene.world->poll([](const WorldEvent&) { return true; });
        frames += scene.world->drawn()->number != before;
        before = scene.world->drawn()->number;
        workOrWait(scene);
      }
      CHECK(scene.world->stats().edits_drawn >= state);
      CHECK(frames <= 2);
    }
  }
}

TEST_CASE("digs come faster than they can be drawn, and what waits stays bounded", "[threads]") {
  Scene scene(*makeThreadPool(2));
  const Viewer viewer = viewerAt(96, 96, 96);
  REQUIRE(scene.world->setViewers({&viewer, 1}));
  REQUIRE(scene.world->waitIdle());
  Engine engine;
  engine.take(*scene.world);
  std::mt19937 random(5);
  const size_t drawn = scene.world->drawn()->tree.leaves().size();
  size_t most = 0;
  for (int digs = 0; digs < 300; ++digs) {
    const auto metres = [&] { return static_cast<double>(random() % 17) - 8; };
    REQUIRE(scene.world->edit(dig(viewer, metres(), metres(), metres(), 4)));
    REQUIRE(scene.world->update(size_t{1} << 30));
    engine.take(*scene.world);
    const WorldStats stats = scene.world->stats();
    most = std::max(most, stats.queued + stats.in_work);
  }
  CHECK(most < drawn);
  comeToRest(scene, engine);
  CHECK(scene.world->stats().edits_drawn == 300);
  EditLog log{EditSettings{}};
  REQUIRE(log.import(scene.world->exportEdits()));
  checkFrame(scene, engine, log.snapshot().get());
}

TEST_CASE("an edit larger than all that is drawn finds room under a small cap", "[threads]") {
  WorldSettings settings;
  settings.lod.finest_distance = 60.0 * kUnitsPerMetre;
  settings.mesh_bytes = size_t{21} << 20;
  Scene scene(*makeThreadPool(2),
              "sgm 1; units m; domain infinite; layer l cell 16m reach 1m detail 1m { start Balls; }\n"
              "rule Balls { for x in 0..1 { for y in 0..1 { for z in 0..1 { at(2m+4m*x, 2m+4m*y, 2m+4m*z) "
              "sphere(1.6m); } } } }",
              settings);
  Engine engine;
  Editor editor(*scene.world);
  const Viewer viewer = viewerAt(96, 96, 96);
  REQUIRE(scene.world->setViewers({&viewer, 1}));
  const auto settle = [&] {
    for (int updates = 0; updates < 100'000 && !scene.world->stats().idle; ++updates) {
      REQUIRE(scene.world->update(size_t{1} << 30));
      engine.take(*scene.world);
      workOrWait(scene);
    }
    CHECK(scene.world->stats().idle);
  };
  settle();
  Brush plate;
  plate.shape = Brush::Shape::box;
  plate.half = {300 * kUnitsPerMetre, kUnitsPerMetre, 300 * kUnitsPerMetre};
  for (int y = 75; y < 115; y += 10) {
    plate.from = {96 * kUnitsPerMetre, y * kUnitsPerMetre, 96 * kUnitsPerMetre};
    editor.lay(plate);
  }
  settle();
  const WorldStats stats = scene.world->stats();
  CAPTURE(stats.surface_bytes, stats.peak_surface_bytes, stats.planner.detail);
  CHECK(stats.edits_drawn == stats.edits);
  CHECK(stats.planner.detail < 1);
  CHECK(stats.peak_surface_bytes <= settings.mesh_bytes);
  checkFrame(scene, engine, editor.at(stats.edits_drawn));
}

TEST_CASE("worlds that have exchanged their edits are equal", "[threads]") {
  Scene one(*makeThreadPool(2)), other(*makeThreadPool(1));
  const Viewer viewer = viewerAt(96, 96, 96);
  const IntBox region{{64 * 1024, 64 * 1024, 64 * 1024}, {128 * 1024, 128 * 1024, 128 * 1024}};
  REQUIRE(one.world->setViewers({&viewer, 1}));
  REQUIRE(one.world->waitIdle());
  const ContentHash plain = *one.world->hashBodies(region, 0);
  std::mt19937 random(11);
  for (int i = 0; i < 10; ++i) {
    REQUIRE(one.world->edit(randomEdit(random, viewer)));
    const Result<EditId> made = other.world->edit(randomEdit(random, viewer));
    REQUIRE(made);
    if (i % 3 == 0) REQUIRE(other.world->undo(*made));
  }
  const std::vector<std::byte> from_one = one.world->exportEdits(), from_other = other.world->exportEdits();
  REQUIRE(one.world->importEdits(from_other));
  REQUIRE(other.world->importEdits(from_one));
  CHECK(one.world->editHash() == other.world->editHash());
  const ContentHash before = *one.world->hashBodies(region, 0);  // no chunk of the region is drawn yet
  CHECK(before != plain);
  REQUIRE(one.world->waitIdle());
  CHECK(*one.world->hashBodies(region, 0) == before);
  CHECK(*other.world->hashBodies(region, 0) == before);

  std::vector<std::byte> damaged = from_one;
  damaged[damaged.size() / 2] ^= std::byte{1};
  const uint64_t hash = other.world->editHash();
  REQUIRE_FALSE(other.world->importEdits(damaged));
  CHECK(other.world->editHash() == hash);
}

TEST_CASE("a journal brings the edits back, and a world of another kind does not take it", "[threads]") {
  const TemporaryFolder folder;
  const std::filesystem::path path = folder.path / "journal";
  WorldSettings settings;
  settings.journal = path;
  const Viewer viewer = viewerAt(96, 96, 96);
  uint64_t hash = 0;
  {
    Scene scene(*makeThreadPool(2), caveText(), settings);
    for (int i = 0; i < 5; ++i) REQUIRE(scene.world->edit(dig(viewer, i, 0, 0, 2)));
    hash = scene.world->editHash();
    REQUIRE(scene.world->setViewers({&viewer, 1}));
    // Only the jobs of the world write the journal here.
    const auto size = std::filesystem::file_size(path);
    for (int updates = 0; updates < 100'000 && std::filesystem::file_size(path) == size; ++updates) {
      REQUIRE(scene.world->update(size_t{1} << 30));
      scene.world->poll([](const WorldEvent&) { return true; });
      workOrWait(scene);
    }
    CHECK(std::filesystem::file_size(path) > size);
    REQUIRE(scene.world->edit(dig(viewer, 9, 0, 0, 2)));  // this edit is written when the world is destroyed
    CHECK(scene.world->editHash() != hash);
    hash = scene.world->editHash();
  }
  {
    Scene scene(*makeThreadPool(2), caveText(), settings);
    CHECK(scene.world->editHash() == hash);
    CHECK(scene.world->stats().edits > 0);
    const Result<std::unique_ptr<World>> second =
        World::create(external(scene.field), *scene.backend, *scene.jobs, scene.settings, scene.field.memory());
    REQUIRE_FALSE(second);  // the first world has the journal open
    CHECK(second.error().code == Code::limit);
  }
  Scene other(*makeThreadPool(1), replaced(caveText(), "detail 4m", "detail 5m"));
  WorldSettings wrong = other.settings;
  wrong.journal = path;
  const Result<std::unique_ptr<World>> refused =
      World::create(external(other.field), *other.backend, *other.jobs, wrong, other.field.memory());
  REQUIRE_FALSE(refused);
  CHECK(refused.error().code == Code::bad_input);
}
