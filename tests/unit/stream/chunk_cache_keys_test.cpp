// Tests that the key of a chunk's part contains everything on which the part depends, and nothing else.

#include "chunk_cache_support.h"

using namespace sgm;

TEST_CASE("whatever a part depends on is in its key, and what it does not is not", "[stream][disk]") {
  const Excerpt& scene = scenes()[0];
  const WorldFieldSettings settings = scene.settings();
  const WorldField world(settings, std::pmr::get_default_resource());
  const ChunkRequest request = caveRequest();
  std::vector<std::vector<std::byte>> seen;
  const auto isNew = [&](const std::vector<std::byte>& inputs) {
    const bool found = std::find(seen.begin(), seen.end(), inputs) != seen.end();
    if (!found) seen.push_back(inputs);
    return !found;
  };
  for (int part = 0; part < kChunkParts; ++part) CHECK(isNew(inputsOf(world, request, part)));
  const auto changes = [&](const WorldFieldSettings& other) {
    const WorldField changed(other, std::pmr::get_default_resource());
    return isNew(inputsOf(changed, request, 0)) && isNew(inputsOf(changed, request, 1));
  };

  for (size_t p = 0; p < settings.parameters.values.size(); ++p) {
    WorldFieldSettings other = settings;
    other.parameters.values[p] = std::nextafter(other.parameters.values[p], 2);
    CHECK(changes(other));
  }
  REQUIRE(settings.parameters.values.size() == 2);
  for (int axis = 0; axis < 3; ++axis) {
    WorldFieldSettings other = settings;
    other.shift[axis] = 1;
    CHECK(changes(other));
  }
  WorldFieldSettings other = settings;
  other.seed ^= uint64_t{1} << 63;
  CHECK(changes(other));
  other = settings;
  ++other.finest_cell;
  CHECK(changes(other));

  // Changes each number in the grammar slightly, one after the other.
  const std::string text = yardstick("cave.sgm");
  size_t numbers = 0;
  for (size_t at = text.find("sgm 1;") + 6; at < text.size(); ++at) {
    const auto digit = [&](size_t i) { return i < text.size() && std::isdigit(static_cast<unsigned char>(text[i])); };
    if (!digit(at) || std::isalnum(static_cast<unsigned char>(text[at - 1]))) continue;
    size_t end = at;
    while (digit(end)) ++end;
    if (text[end] == '.' && digit(end + 1)) {
      for (++end; digit(end);) ++end;
    }
    std::string changed = text;
    const bool fraction = changed.substr(at, end - at).find('.') != std::string::npos;
    changed.insert(end, fraction ? "000001" : ".000001");
    at = end;
    CompileResult compiled = compileGrammar(changed, "test.sgm");
    // Not every change compiles: a count must be a whole number, and the reach must still be provable.
    if (!compiled.program) continue;
    ++numbers;
    other = settings;
    other.program = compiled.program;
    CAPTURE(changed.substr(0, end + 8));
    const bool same = compiled.program->hash == settings.program->hash;
    CHECK(changes(other) != same);
    // Comments, descriptions and expectations do not change the key, since they do not change the mesh.
    const size_t line = text.rfind('\n', end) + 1;
    const size_t slashes = text.find("//", line), quote = text.find('"', line);
    CHECK(same == (std::min(slashes, quote) < end || text.compare(line, 7, "expect ") == 0));
  }
  CHECK(numbers > 20);

  // Changes only the comments and the layout of the grammar.
  other = settings;
  other.program =
      compileGrammar(replaced(text, "rule Chamber(r) {", "// tall\n\n rule  Chamber( (r)\n) {"), "b").program;
  if (!other.program)
    other.program =
        compileGrammar(replaced(text, "rule Chamber(r) {", "// tall\n\nrule  Chamber( r )\n{"), "other.sgm").program;
  REQUIRE(other.program);
  CHECK(!changes(other));
  other = settings;
  other.cache_bytes = 1;
  other.on_notes = [](const GrammarChunk&) {};
  CHECK(!changes(other));

  // Changes the request.
  const auto asks = [&](int part, const std::function<void(ChunkRequest&)>& change) {
    ChunkRequest changed = request;
    change(changed);
    return isNew(inputsOf(world, changed, part));
  };
  for (const int part : {0, 3}) {
    CHECK(asks(part, [](ChunkRequest& r) { r.key.level = 1; }));
    CHECK(asks(part, [](ChunkRequest& r) { ++r.key.at.x; }));
    CHECK(asks(part, [](ChunkRequest& r) { ++r.key.at.y; }));
    CHECK(asks(part, [](ChunkRequest& r) { ++r.key.at.z; }));
    CHECK(!asks(part, [](ChunkRequest& r) { r.seams = 63; }));
    CHECK(!asks(part, [](ChunkRequest& r) { r.coarser = 77; }));
    CHECK(asks(part, [](ChunkRequest& r) { r.signs = false; }) == (part == 0));
    CHECK(asks(part, [](ChunkRequest& r) { r.anchors = false; }) == (part == 0));
    CHECK(asks(part, [](ChunkRequest& r) { r.outermost = true; }) == (part != 0));
  }

  // A world that is made from a derived cell has no key, because its settings do not determine its contents.
  const auto alone = std::make_shared<const DerivedCell>(GrammarChunk(), std::pmr::get_default_resource());
  CHECK(!ChunkPartInputs::of(WorldField(settings, alone, std::pmr::get_default_resource()), request, nullptr));
}

TEST_CASE("the brushes that show around a part are in its key, and no others", "[stream][disk]") {
  const Excerpt& scene = scenes()[0];
  const WorldField world(scene.settings(), std::pmr::get_default_resource());
  const ChunkRequest request = caveRequest();
  const IntBox box = chunkBox(*chunkGrid(world, request.key));
  const auto inputs = [&](int part, const std::vector<Brush>& brushes, uint64_t first = 1, bool outermost = false) {
    EditSnapshot edits;
    for (const Brush& brush : brushes) {
      edits = edits.with({first, {first, first}}, brush);
      ++first;
    }
    ChunkRequest asked = request;
    asked.outermost = outermost;
    return inputsOf(world, asked, part, &edits);
  };
  Brush ball;
  ball.from = box.lo;
  ball.radius = 2000;
  const std::vector<std::byte> none = inputsOf(world, request, 0), seam_none = inputsOf(world, request, 1);
  CHECK(inputs(0, {}) == none);
  CHECK(inputs(0, {ball}) != none);
  CHECK(inputs(1, {ball}) != seam_none);
  CHECK(inputs(0, {ball}) == inputs(0, {ball}, 9));  // an edit's author and time do not matter

  std::vector<std::vector<std::byte>> seen{none};
  const auto isNew = [&](const std::function<void(Brush&)>& change) {
    Brush changed = ball;
    change(changed);
    const auto bytes = inputs(0, {changed});
    const bool found = std::find(seen.begin(), seen.end(), bytes) != seen.end();
    seen.push_back(bytes);
    return !found;
  };
  CHECK(isNew([](Brush&) {}));
  CHECK(isNew([](Brush& b) { b.cut = true; }));
  CHECK(isNew([](Brush& b) { b.shape = Brush::Shape::capsule; }));
  CHECK(isNew([](Brush& b) { ++b.radius; }));
  CHECK(isNew([](Brush& b) { ++b.smooth; }));
  CHECK(isNew([](Brush& b) { ++b.material; }));
  CHECK(isNew([](Brush& b) { ++b.tag; }));
  CHECK(isNew([](Brush& b) { ++b.from.x; }));
  CHECK(!isNew([](Brush& b) { ++b.to.x; }));  // a ball does not use the second point of its brush
  Brush cut = ball;
  cut.cut = true;
  CHECK(inputs(0, {ball, cut}) != inputs(0, {cut, ball}));

  // A body depends on edits within two cells of its own level, and a seam on edits within two cells of the next coarser
  // level.
  Brush near = ball;
  near.from.x = box.lo.x - ball.radius - 3 * world.cellAt(0);
  CHECK(inputs(0, {near}) == none);
  CHECK(inputs(1, {near}) != seam_none);
  CHECK(inputs(1, {near}, 1, true) == inputs(1, {}, 1, true));
  // The coarser level omits a brush that is too thin for it.
  Brush thin = near;
  thin.radius = world.cellAt(0) * 3 / 4;
  thin.from.x = box.lo.x - thin.radius - 3 * world.cellAt(0);
  CHECK(inputs(1, {thin}) == seam_none);
  thin.from = box.lo;
  CHECK(inputs(1, {thin}) != seam_none);
}
