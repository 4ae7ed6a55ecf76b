// Tests replacing a world's field: exactly the changed chunks are meshed again, and every frame shows one field.

#include <chrono>
#include <thread>

#include "catch.h"
#include "edits_support.h"
#include "rounds.h"
#include "streaming_support.h"
#include "temporary_folder.h"

using namespace sgm;

namespace {

std::shared_ptr<const WorldField> fieldOf(WorldFieldSettings settings) {
  return std::make_shared<const WorldField>(std::move(settings), std::pmr::get_default_resource());
}

std::shared_ptr<const WorldField> fieldOf(const std::string& text, const std::string& parameter = "",
                                          double value = 0) {
  WorldFieldSettings settings = settingsOf(text, kStreamedCell, 3);
  if (!parameter.empty()) REQUIRE(settings.parameters.set(*settings.program, parameter, value));
  return fieldOf(std::move(settings));
}

/// The cave with all its layers, and with drips that are visible with grid cells of 0.5 m.
std::string drippingText() { return replaced(yardstick("cave.sgm"), "detail 0.3m", "detail 0.6m"); }

/// The cave with rules nested more deeply than derivation allows, an error that is found at once.
std::string tooDeepText() {
  return replaced(caveText(), "rule Chamber(r) {",
                  "rule Deep(n) depth 100 -> Leaf(n) { Deep(n + 1); } rule Leaf(n) { sphere(1m); }\n"
                  "rule Chamber(r) { Deep(1);");
}

/// A change of that text as an author would make it.
struct EditedText {
  std::string what, text;
};

std::vector<EditedText> editedTexts() {
  const std::string cave = drippingText();
  return {
      {"layout alone", replaced(cave, "  anchor spawn", "  // here\n     anchor spawn")},
      {"a rule's number", replaced(cave, "sphere(0.7*r)", "sphere(0.72*r)")},
      {"an anchor's name", replaced(cave, "anchor spawn \"chamber\"", "anchor spawn \"hall\"")},
      {"a material's name", replaced(cave, "mat calcite", "mat aragonite")},
      {"a layer less", replaced(cave, "layer drip cell 24m reach 5m uses net { start Drips; }", "")},
      {"a layer's cells", replaced(cave, "drip cell 24m", "drip cell 20m")},
      {"a weight", replaced(cave, "Hall(r) weight 1", "Hall(r) weight 2")},
      {"a layer's detail", replaced(cave, "reach 176m detail 4m", "reach 176m detail 1m")},
      {"a layer more", replaced(cave, "rule Node {",
                                "layer more cell 64m reach 8m { start Pearl; }\n"
                                "rule Pearl { at(20m, 20m, 20m) sphere(6m); }\nrule Node {")},
      {"the domain", replaced(cave, "solid limestone", "solid granite")},
      {"what drips", replaced(cave, "scatter poisson(2.2m)", "scatter poisson(2.3m)")},
  };
}

/// All contents of a chunk that an engine receives.
struct Content {
  std::vector<ContentHash> hashes;
  std::vector<uint64_t> anchors;
  std::vector<Frame> frames;
  friend bool operator==(const Content&, const Content&) = default;
};

std::vector<Content> contentsOf(const WorldField& field, const std::vector<ChunkRequest>& requests) {
  std::vector<Content> contents;
  for (const PlacedChunk& chunk : meshAll(field, requests, 2)) {
    Content& content = contents.emplace_back();
    content.hashes.push_back(chunk.mesh.body.hash);
    for (const MeshPart& seam : chunk.mesh.seams) content.hashes.push_back(seam.hash);
    for (const MeshPart* part : {&chunk.mesh.body}) {
      for (const auto& vertex : part->vertices) content.anchors.push_back(vertex.material);
    }
    const Program& program = *field.settings().program;
    for (const Anchor& anchor : chunk.anchors) {
      content.anchors.push_back(anchor.key.value);
      content.anchors.push_back(hashText(program.names[anchor.name]));
      content.frames.push_back(anchor.frame);
    }
  }
  return contents;
}

/// Random chunks near halls, where most surfaces are.
std::vector<ChunkRequest> randomChunks(std::mt19937& random, const WorldField& field, int level, size_t count) {
  const IntBox halls{{-300000, -300000, -300000}, {600000, 600000, 600000}};
  const Result<std::vector<Anchor>> anchors = field.anchors(halls);
  REQUIRE(anchors);
  REQUIRE(!anchors->empty());
  std::vector<ChunkRequest> requests;
  for (size_t i = 0; i < count; ++i) {
    ChunkRequest& request = requests.emplace_back();
    request.key.level = level;
    const Int3 hall = (*anchors)[random() % anchors->size()].frame.origin;
    for (int axis = 0; axis < 3; ++axis) {
      const int32_t off = static_cast<int32_t>(random() % 60000) - 30000;
      request.key.at[axis] = (hall[axis] + off) >> level >> 14;  // chunks of level 0 are 2^14 units wide
    }
    request.seams = 63;
    request.anchors = level == 0;
  }
  return requests;
}
static_assert(kChunkCells * kStreamedCell == 1 << 14);

/// Levels with cells of 0.5 to 8 m: the cave's passages are omitted if cells are larger than 4 m.
constexpr int kLevels = 5;
/// Number of tested chunks of a level, half with a sanitizer: most of the time of these tests is spent on meshing them
/// twice for every changed text.
size_t chunksOf(int level) { return (rounds(4) < 4 ? 1u : 2u) * (level == 0 ? 30u : 6u); }
size_t allChunks() {
  size_t all = 0;
  for (int level = 0; level < kLevels; ++level) all += chunksOf(level);
  return all;
}

/// Compares both fields on random chunks. Returns how many of these must be meshed again.
size_t checkChange(std::mt19937& random, const std::shared_ptr<const WorldField>& from,
                   const std::shared_ptr<const WorldField>& to) {
  const FieldChange change(from, to);
  size_t touched = 0;
  for (int level = 0; level < kLevels; ++level) {
    const std::vector<ChunkRequest> requests = randomChunks(random, *from, level, chunksOf(level));
    const std::vector<Content> before = contentsOf(*from, requests), after = contentsOf(*to, requests);
    for (size_t i = 0; i < requests.size(); ++i) {
      const bool differs = before[i] != after[i];
      const bool told = change.touches(requests[i].key);
      touched += told;
      INFO("level " << level << ", chunk " << requests[i].key.at.x << ' ' << requests[i].key.at.y << ' '
                    << requests[i].key.at.z);
      if (differs) CHECK(told);
    }
  }
  return touched;
}

}  // namespace

TEST_CASE("what differs between two fields is told for every chunk that it changes", "[threads]") {
  for (uint32_t seed = 1; seed <= rounds(2); ++seed) {
    CAPTURE(seed);
    std::mt19937 random(seed);
    const std::string cave = drippingText();
    const auto from = fieldOf(cave);
    CHECK(checkChange(random, from, fieldOf(cave)) == 0);
    const size_t boxy = checkChange(random, from, fieldOf(cave, "boxy", 0.5));
    CHECK(boxy > 0);
    CHECK(boxy < allChunks());  // passages do not depend on the parameter
    const size_t wet = checkChange(random, from, fieldOf(cave, "wet", 0.6));
    CHECK(wet > 0);
    CHECK(wet < allChunks());
    for (const EditedText& edited : editedTexts()) {
      CAPTURE(edited.what);
      const size_t touched = checkChange(random, from, fieldOf(edited.text));
      if (edited.what == "layout alone") CHECK(touched == 0);
      if (edited.what == "the domain") CHECK(touched == allChunks());
      if (edited.what != "layout alone") CHECK(touched > 0);
    }
  }
}

TEST_CASE("cells that have read no parameter that differs are taken over and not derived again") {
  const std::string cave = drippingText();
  const auto from = fieldOf(cave);
  const uint32_t net = 0, drip = 1;
  for (int32_t x = 0; x < 3; ++x) {
    REQUIRE(from->cell(net, {x, 0, 0}));
    REQUIRE(from->cell(drip, {x, 0, 0}));
  }
  const size_t cells = from->cacheStats().cells;
  const auto wetter = fieldOf(cave, "wet", 0.7);
  wetter->adopt(*from);
  const auto cellOf = [](const WorldField& field, uint32_t layer, Int3 cell) { return *field.cell(layer, cell); };
  for (int32_t x = 0; x < 3; ++x) CHECK(cellOf(*wetter, net, {x, 0, 0}) == cellOf(*from, net, {x, 0, 0}));
  CHECK(wetter->cacheStats().misses == 0);
  CHECK(wetter->cacheStats().cells < cells);
  // A drip hangs from the ceiling of the hall that its probe found, so it depends on that hall's shape.
  const auto boxier = fieldOf(cave, "boxy", 0.9);
  uint64_t probed = 0;
  for (int32_t x = 0; x < 8; ++x) probed |= cellOf(*from, drip, {x, 2, 2})->chunk.parameters;
  const Program& program = *from->settings().program;
  CHECK((probed & parameterBit(program.findParam("boxy"))) != 0);
  CHECK((cellOf(*from, net, {0, 0, 0})->chunk.parameters & parameterBit(program.findParam("wet"))) == 0);
}

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
    REQUIRE(scene.world->waitIdle());
    engine.take(*scene.world);
    CHECK(scene.world->field() == last);
    CHECK(scene.world->stats().edits_drawn == scene.world->stats().edits);
    REQUIRE(log.import(scene.world->exportEdits(log.size())));
    checkFrame(scene, engine, log.snapshot().get(), last.get());
    // Queries use the field that is drawn.
    const Result<ContentHash> streamed = scene.world->hashBodies({{60000, 60000, 60000}, {90000, 90000, 90000}}, 0);
    REQUIRE(streamed);
  }
}

TEST_CASE("Birger: the sky is edited while it is looked at", "[table4]") {
  const std::string sky = sample("table4/birger.sgm");
  Scene scene(*makeThreadPool(2), sky);
  Engine engine;
  Viewer viewer = viewerAt(200, 930, 200);
  REQUIRE(scene.world->setViewers({&viewer, 1}));
  REQUIRE(scene.world->waitIdle());
  engine.take(*scene.world);
  const auto triangles = [&] {
    size_t count = 0;
    for (const auto& [key, shown] : engine.shown) count += shown.surface->mesh.ranges[0].index_count / 3;
    return count;
  };
  std::vector<size_t> counts{triangles()};
  // Two parameters change while the viewer moves; every drawn frame belongs to exactly one pair of their values.
  const std::pair<const char*, double> turns[] = {{"cover", 0.3}, {"octaves", 2}};
  for (const auto& [knob, value] : turns) {
    const std::shared_ptr<const WorldField> edited = fieldOf(sky, knob, value);
    REQUIRE(scene.world->setField(edited));
    viewer.position[0] += 6 * kUnitsPerMetre;
    REQUIRE(scene.world->setViewers({&viewer, 1}));
    REQUIRE(scene.world->waitIdle());
    engine.take(*scene.world);
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
  REQUIRE(scene.world->setViewers({&viewer, 1}));
  REQUIRE(scene.world->waitIdle());
  engine.take(*scene.world);
  const auto before = engine.shown;
  const WorldStats first = scene.world->stats();
  REQUIRE(scene.world->setField(fieldOf(drippingText(), "wet", 0.6)));
  REQUIRE(scene.world->waitIdle());
  engine.take(*scene.world);
  const WorldStats wetter = scene.world->stats();
  CHECK(wetter.planner.outdated > 0);
  CHECK(wetter.planner.outdated < first.planner.records);
  size_t same = 0, other = 0;
  for (const auto& [key, shown] : engine.shown) {
    const auto was = before.find(key);
    if (was == before.end()) continue;
    ++(was->second.surface == shown.surface ? same : other);
    // Stalactites have a detail of 0.6 m, so only level 0 has any.
    if (key.level > 0) CHECK(was->second.surface == shown.surface);
  }
  CHECK(same > 0);
  REQUIRE(scene.world->setField(fieldOf(drippingText())));
  REQUIRE(scene.world->waitIdle());
  engine.take(*scene.world);
  REQUIRE(engine.shown.size() == before.size());
  for (const auto& [key, shown] : engine.shown) {
    // Only seams that are drawn now are compared: a surface may also have seams that were needed on the way.
    const Engine::Shown& was = before.at(key);
    CHECK(shown.seams == was.seams);
    for (size_t range = 0; range < 7; ++range) {
      if (range > 0 && (shown.seams >> (range - 1) & 1) == 0) continue;
      CHECK(shown.surface->mesh.ranges[range].hash == was.surface->mesh.ranges[range].hash);
    }
  }
  // Setting the same field again meshes nothing.
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
  REQUIRE(scene.world->setViewers({&viewer, 1}));
  REQUIRE(scene.world->waitIdle());
  engine.take(*scene.world);
  const size_t drawn = engine.shown.size();
  REQUIRE(scene.world->setField(fieldOf(tooDeepText())));
  REQUIRE(scene.world->waitIdle());
  engine.take(*scene.world);
  CHECK(engine.shown.size() == drawn);
  CHECK(scene.world->stats().planner.failed > 0);
  REQUIRE(scene.world->setField(fieldOf(caveText(), "boxy", 0.8)));
  REQUIRE(scene.world->waitIdle());
  engine.take(*scene.world);
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
  REQUIRE(scene.world->waitIdle());
  engine.take(*scene.world);
  checkFrame(scene, engine, nullptr, scene.world->field().get());
}

TEST_CASE("anchors that change without the surface come to the engine") {
  Scene scene(*makeThreadPool(2));
  Engine engine;
  const Viewer viewer = viewerAt(96, 96, 96);
  REQUIRE(scene.world->setViewers({&viewer, 1}));
  REQUIRE(scene.world->waitIdle());
  engine.take(*scene.world);
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
  REQUIRE(scene.world->waitIdle());
  engine.take(*scene.world);
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
  REQUIRE(scene.world->setViewers({&viewer, 1}));
  REQUIRE(scene.world->waitIdle());
  engine.take(*scene.world);
  for (int bad = 0; bad < 3; ++bad) {
    REQUIRE(scene.world->setField(fieldOf(tooDeepText())));
    REQUIRE(scene.world->waitIdle());
    engine.take(*scene.world);
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
  REQUIRE(scene.world->waitIdle());
  engine.take(*scene.world);
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
  // If each of ten changes a second restarted the work, nothing would ever be drawn.
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
  REQUIRE(scene.world->setViewers({&viewer, 1}));
  REQUIRE(scene.world->waitIdle());
  engine.take(*scene.world);
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
