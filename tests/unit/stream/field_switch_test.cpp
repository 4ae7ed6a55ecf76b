// Tests replacing the field of a streamed world: the changed chunks are meshed again, and no others; every frame shows
// one field.

#include <chrono>
#include <thread>

#include "catch.h"
#include "edited_fields.h"
#include "rounds.h"
#include "temporary_folder.h"
#include "world/edits_support.h"

using namespace sgm;

namespace {

/// The cave with rules that are nested deeper than derivation allows, so that deriving fails at once.
std::string tooDeepText() {
  return replaced(caveText(), "rule Chamber(r) {",
                  "rule Deep(n) depth 100 -> Leaf(n) { Deep(n + 1); } rule Leaf(n) { sphere(1m); }\n"
                  "rule Chamber(r) { Deep(1);");
}

}  // namespace

TEST_CASE("every frame shows one field with one state of the edits, and is closed") {
  const std::vector<EditedText> texts = editedTexts();
  for (uint32_t seed = 1; seed <= rounds(3); ++seed) {
    CAPTURE(seed);
    std::mt19937 random(seed);
    WorldSettings settings;
    settings.by_reach = seed % 2 == 0;
    Scene scene(std::make_unique<LateJobs>(seed), caveText(), settings);
    Engine engine;
    std::map<uint64_t, std::shared_ptr<const WorldField>> fields;
    EditLog log{EditSettings{}};
    std::map<uint64_t, std::shared_ptr<const EditSnapshot>> brushes;
    const auto remember = [&] {
      const uint64_t state = scene.world->stats().edits;
      if (fields.count(state) != 0) return;
      REQUIRE(log.import(scene.world->exportEdits(log.size())));
      fields[state] = scene.world->field();
      brushes[state] = log.snapshot();
    };
    remember();
    std::shared_ptr<const WorldField> last;
    Viewer viewer = viewerAt(96, 96, 96);
    for (int turn = 0; turn < 40; ++turn) {
      viewer = wander(random, viewer);
      REQUIRE(scene.world->setViewers({&viewer, 1}));
      if (random() % 3 == 0) {
        last = random() % 4 == 0 ? fieldOf(texts[random() % texts.size()].text)
                                 : fieldOf(caveText(), "boxy", static_cast<double>(random() % 101) / 100);
        REQUIRE(scene.world->setField(last));
      }
      if (random() % 4 == 0) {
        Brush brush = randomBrush(random, IntBox{{60000, 60000, 60000}, {130000, 130000, 130000}}, 8000);
        brush.material = brush.tag = 0;
        REQUIRE(scene.world->edit(brush));
        remember();
      }
      for (int update = 0; update < 8; ++update) {
        REQUIRE(scene.world->update(size_t{1} << 30));
        engine.take(*scene.world);
        for (auto jobs = random() % 90; jobs > 0 && scene.jobs->help(); --jobs) remember();
      }
      if (turn % 5 == 4) {
        const uint64_t state = scene.world->drawn()->edits;
        checkFrame(scene, engine, brushes.at(state).get(), fields.at(state).get());
      }
    }
    comeToRest(scene, engine);
    CHECK(scene.world->field() == last);
    CHECK(scene.world->stats().edits_drawn == scene.world->stats().edits);
    REQUIRE(log.import(scene.world->exportEdits(log.size())));
    checkFrame(scene, engine, log.snapshot().get(), last.get());
    // A query of the world uses the field that is drawn now.
    const Result<ContentHash> streamed = scene.world->hashBodies({{60000, 60000, 60000}, {90000, 90000, 90000}}, 0);
    REQUIRE(streamed);
  }
}

TEST_CASE("Birger: the sky is edited while it is looked at", "[table4]") {
  const std::string sky = sample("table4/birger.sgm");
  Scene scene(*makeThreadPool(2), sky);
  Engine engine;
  Viewer viewer = viewerAt(200, 930, 200);
  lookFrom(scene, engine, viewer);
  const auto triangles = [&] {
    size_t count = 0;
    for (const auto& [key, shown] : engine.shown) count += shown.surface->mesh.ranges[0].index_count / 3;
    return count;
  };
  std::vector<size_t> counts{triangles()};
  // The author changes two parameters while the viewer moves; every frame shows the sky of one setting.
  const std::pair<const char*, double> turns[] = {{"cover", 0.3}, {"octaves", 2}};
  for (const auto& [knob, value] : turns) {
    const std::shared_ptr<const WorldField> edited = fieldOf(sky, knob, value);
    REQUIRE(scene.world->setField(edited));
    viewer.position[0] += 6 * kUnitsPerMetre;
    lookFrom(scene, engine, viewer);
    checkFrame(scene, engine, nullptr, edited.get());
    counts.push_back(triangles());
    CAPTURE(knob, value, counts);
    CHECK(counts.back() != counts[counts.size() - 2]);
  }
  CHECK(counts[0] > 1000);
}

TEST_CASE("a parameter changes what depends on it alone, and back again gives the same surfaces", "[threads]") {
  Scene scene(*makeThreadPool(2), drippingText());
  Engine engine;
  const Viewer viewer = viewerAt(96, 96, 96);
  lookFrom(scene, engine, viewer);
  const auto before = engine.shown;
  const WorldStats first = scene.world->stats();
  REQUIRE(scene.world->setField(fieldOf(drippingText(), "wet", 0.6)));
  comeToRest(scene, engine);
  const WorldStats wetter = scene.world->stats();
  CHECK(wetter.planner.outdated > 0);
  CHECK(wetter.planner.outdated < first.planner.records);
  size_t same = 0, other = 0;
  for (const auto& [key, shown] : engine.shown) {
    const auto was = before.find(key);
    if (was == before.end()) continue;
    ++(was->second.surface == shown.surface ? same : other);
    // Only level 0 has stalactites, which are a detail of 0.6 m, so that other levels do not change.
    if (key.level > 0) CHECK(was->second.surface == shown.surface);
  }
  CHECK(same > 0);
  REQUIRE(scene.world->setField(fieldOf(drippingText())));
  comeToRest(scene, engine);
  REQUIRE(engine.shown.size() == before.size());
  for (const auto& [key, shown] : engine.shown) {
    // Compares only the drawn seams: a surface may hold other seams that were drawn before the world came to rest.
    const Engine::Shown& was = before.at(key);
    CHECK(shown.seams == was.seams);
    for (size_t range = 0; range < 7; ++range) {
      if (range > 0 && (shown.seams >> (range - 1) & 1) == 0) continue;
      CHECK(shown.surface->mesh.ranges[range].hash == was.surface->mesh.ranges[range].hash);
    }
  }
  // Setting the same field again makes no chunk outdated.
  const uint64_t outdated = scene.world->stats().planner.outdated;
  REQUIRE(scene.world->setField(fieldOf(drippingText())));
  REQUIRE(scene.world->waitIdle());
  CHECK(scene.world->stats().planner.outdated == outdated);
}

TEST_CASE("a field that cannot be derived leaves what is drawn, and the next one is drawn") {
  Scene scene(*makeThreadPool(2));
  Engine engine;
  engine.fails_may_come = true;
  const Viewer viewer = viewerAt(96, 96, 96);
  lookFrom(scene, engine, viewer);
  const size_t drawn = engine.shown.size();
  REQUIRE(scene.world->setField(fieldOf(tooDeepText())));
  comeToRest(scene, engine);
  CHECK(engine.shown.size() == drawn);
  CHECK(scene.world->stats().planner.failed > 0);
  REQUIRE(scene.world->setField(fieldOf(caveText(), "boxy", 0.8)));
  comeToRest(scene, engine);
  checkFrame(scene, engine, nullptr, scene.world->field().get());
  CHECK(scene.world->stats().edits_drawn == scene.world->stats().edits);
}

TEST_CASE("fields with another cell, or that would spoil what is on disk, are refused") {
  Scene scene(*makeThreadPool(1));
  const Result<void> cell = scene.world->setField(fieldOf(settingsOf(caveText(), 2 * kStreamedCell)));
  REQUIRE_FALSE(cell);
  CHECK(cell.error().message.find("finest cell") != std::string::npos);
}

TEST_CASE("fields that come faster than they are drawn are passed over, and a moving viewer still comes to see") {
  Scene scene(*makeThreadPool(2), drippingText());
  Engine engine;
  Viewer viewer = viewerAt(96, 96, 96);
  uint64_t sets = 0;
  uint64_t meshed = 0;
  for (int frame = 0; frame < 200; ++frame) {
    viewer.position[0] += 0.1 * kUnitsPerMetre;
    REQUIRE(scene.world->setViewers({&viewer, 1}));
    if (frame % 2 == 0) {
      REQUIRE(scene.world->setField(fieldOf(drippingText(), "boxy", (frame % 100) / 100.0)));
      ++sets;
    }
    REQUIRE(scene.world->update(size_t{8} << 20));
    engine.take(*scene.world);
    workOrWait(scene);
    meshed = scene.world->stats().planner.meshed;
  }
  CHECK(meshed > 0);
  CHECK(scene.world->stats().edits > 0);
  CHECK(scene.world->stats().edits < sets);
  comeToRest(scene, engine);
  checkFrame(scene, engine, nullptr, scene.world->field().get());
}

TEST_CASE("anchors that change without the surface come to the engine") {
  Scene scene(*makeThreadPool(2));
  Engine engine;
  const Viewer viewer = viewerAt(96, 96, 96);
  lookFrom(scene, engine, viewer);
  const auto anchorsOf = [&] {
    std::map<ChunkKey, size_t> anchors;
    for (const auto& [key, shown] : engine.shown) {
      if (!shown.surface->anchors.empty()) anchors[key] = shown.surface->anchors.size();
    }
    return anchors;
  };
  const std::map<ChunkKey, size_t> before = anchorsOf();
  REQUIRE(!before.empty());
  const auto hashes = [&] {
    std::map<ChunkKey, ContentHash> all;
    for (const auto& [key, shown] : engine.shown) all[key] = shown.surface->hash;
    return all;
  };
  const auto surfaces = hashes();
  const std::string two =
      replaced(caveText(), "anchor spawn \"chamber\";", "anchor spawn \"chamber\"; anchor loot \"chest\";");
  REQUIRE(scene.world->setField(fieldOf(two)));
  comeToRest(scene, engine);
  std::map<ChunkKey, size_t> after = anchorsOf();
  CHECK(hashes() == surfaces);
  REQUIRE(after.size() == before.size());
  for (const auto& [key, count] : before) CHECK(after[key] == 2 * count);
  CHECK(scene.world->stats().fields.drawn == 1);
}

TEST_CASE("after a field that fails edits are drawn, and queries are of what is drawn") {
  Scene scene(*makeThreadPool(2));
  Engine engine;
  engine.fails_may_come = true;
  const Viewer viewer = viewerAt(96, 96, 96);
  lookFrom(scene, engine, viewer);
  for (int bad = 0; bad < 3; ++bad) {
    REQUIRE(scene.world->setField(fieldOf(tooDeepText())));
    comeToRest(scene, engine);
  }
  CHECK(&*scene.world->field() == &scene.field);
  CHECK(scene.world->stats().fields.wanted == 3);
  CHECK(scene.world->stats().fields.drawn == 0);
  EditLog log{EditSettings{}};
  Brush brush;
  brush.cut = true;
  brush.from = {96 << 10, 96 << 10, 96 << 10};
  brush.radius = 14 << 10;
  REQUIRE(scene.world->edit(brush));
  comeToRest(scene, engine);
  REQUIRE(log.import(scene.world->exportEdits()));
  checkFrame(scene, engine, log.snapshot().get());
  CHECK(scene.world->stats().edits_drawn == scene.world->stats().edits);
}

TEST_CASE("before anything is drawn one field takes another's place, and the next one waits") {
  const std::unique_ptr<JobSystem> jobs = *makeThreadPool(1);
  WorldEdits edits(fieldOf(caveText()), EditSettings{}, std::pmr::get_default_resource());
  const auto nothing = std::make_shared<const DrawnFrame>(Octree(3, kStreamedCell));
  FieldSwitch fields;
  FieldSwitch::Progress progress;
  progress.viewed = true;
  const auto go = [&] {
    while (fields.compare(nothing, edits, *jobs)) REQUIRE(fields.begin(progress));
    progress.drawn = edits.number();
  };
  fields.want(fieldOf(caveText(), "boxy", 0.1));
  REQUIRE(fields.begin(progress));
  go();
  CHECK_FALSE(fields.begin(progress));
  CHECK(fields.turn().drawn == 1);
  // A new field every tenth of a second would restart the change of fields each time, so that no change would ever be
  // completed.
  fields.want(fieldOf(caveText(), "boxy", 0.2));
  std::this_thread::sleep_for(std::chrono::milliseconds(200));
  CHECK_FALSE(fields.begin(progress));
  SECTION("until something is drawn") { progress.shown = true; }
  SECTION("or there is nothing to draw") { progress.at_rest = true; }
  REQUIRE(fields.begin(progress));
  go();
  CHECK_FALSE(fields.begin(progress));
  CHECK(fields.turn().drawn == 2);
}

TEST_CASE("without viewers a field waits for its turn, and the last one takes it") {
  Scene scene(*makeThreadPool(2));
  Engine engine;
  std::shared_ptr<const WorldField> last;
  for (int i = 0; i < 50; ++i) {
    last = fieldOf(caveText(), "boxy", i / 50.0);
    REQUIRE(scene.world->setField(last));
    REQUIRE(scene.world->update(size_t{1} << 30));
  }
  REQUIRE(scene.world->waitIdle());
  CHECK(scene.world->stats().fields.drawn == 0);
  CHECK(scene.world->stats().edits == 0);
  const Viewer viewer = viewerAt(96, 96, 96);
  lookFrom(scene, engine, viewer);
  CHECK(scene.world->field() == last);
  CHECK(scene.world->stats().edits == 1);
  CHECK(scene.world->stats().fields.drawn == 50);
  checkFrame(scene, engine, nullptr, last.get());
}

TEST_CASE("a journal with a later grammar's materials opens with the first one again") {
  const TemporaryFolder folder;
  WorldSettings settings;
  settings.journal = folder.path / "journal";
  settings.edits.author = 0;
  const Viewer viewer = viewerAt(96, 96, 96);
  const std::string richer = replaced(caveText(), "tag \"cave.hall\";", "tag \"cave.hall\"; mat marble;");
  Brush brush;
  brush.from = {96 << 10, 90 << 10, 96 << 10};
  brush.radius = 3 << 10;
  uint64_t edits = 0;
  for (int run = 0; run < 2; ++run) {
    Scene scene(*makeThreadPool(2), caveText(), settings);
    CHECK(scene.world->editCount() == edits);
    REQUIRE(scene.world->setViewers({&viewer, 1}));
    REQUIRE(scene.world->waitIdle());
    const auto field = fieldOf(richer);
    brush.material = static_cast<uint16_t>(field->settings().program->materials.size() - 1);
    REQUIRE(brush.material >= scene.field.settings().program->materials.size());
    REQUIRE(scene.world->setField(field));
    REQUIRE(scene.world->waitIdle());
    REQUIRE(scene.world->edit(brush));
    REQUIRE(scene.world->flushEdits());
    edits = scene.world->editCount();
  }
  CHECK(edits == 2);
}

TEST_CASE("a job system that runs jobs at once compares some chunks an update, without depth") {
  class AtOnce final : public JobSystem {
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
  Scene scene(std::make_unique<AtOnce>(), drippingText());
  Engine engine;
  const Viewer viewer = viewerAt(96, 96, 96);
  REQUIRE(scene.world->setViewers({&viewer, 1}));
  const auto rest = [&] {
    int updates = 0;
    do {
      REQUIRE(scene.world->update(size_t{1} << 30));
      engine.take(*scene.world);
    } while (!scene.world->stats().idle && ++updates < 100'000);
    return updates;
  };
  rest();
  REQUIRE(scene.world->setField(fieldOf(drippingText(), "boxy", 0.7)));
  CHECK(rest() > 2);
  CHECK(static_cast<const AtOnce&>(*scene.jobs).deepest < 8);
  CHECK(scene.world->stats().fields.drawn == 1);
  checkFrame(scene, engine, nullptr, scene.world->field().get());
}
