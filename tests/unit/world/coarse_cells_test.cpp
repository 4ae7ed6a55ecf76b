// Tests that coarse levels, for which only the visible part of a cell is derived, have the same meshes as if everything
// was derived.

#include <algorithm>
#include <array>
#include <cstring>
#include <random>

#include "backend/open/open_backend.h"
#include "catch.h"
#include "chunk/mesh_chunks.h"
#include "derive/interpret/derive.h"
#include "derive/random_rules.h"
#include "field/compile.h"
#include "rounds.h"
#include "seed.h"
#include "world/layers_below.h"
#include "world_support.h"

using namespace sgm;

namespace {

constexpr int32_t kFinest = 128;

/// The program of a chunk from completely derived cells, without a cache.
FieldProgram fromWholeCells(const WorldField& world, const IntBox& box, int level) {
  const WorldFieldSettings& s = world.settings();
  const int32_t cell_edge = world.cellAt(level);
  std::vector<std::unique_ptr<GrammarChunk>> chunks;
  std::vector<std::unique_ptr<GroupIndex>> indices;
  std::vector<IndexedCell> cells;
  const Result<void> visited =
      world.cellsAround(0, box.grown(influenceMargin(cell_edge)), [&](Int3 at) -> Result<void> {
        const LayersBelow none(world, box);
        Result<GrammarChunk> chunk = deriveCell(*s.program, s.parameters, s.seed, 0, at, none);
        if (!chunk) return chunk.error();
        chunks.push_back(std::make_unique<GrammarChunk>(std::move(*chunk)));
        indices.push_back(std::make_unique<GroupIndex>(*chunks.back()));
        cells.push_back({chunks.back().get(), indices.back().get()});
        return {};
      });
  REQUIRE(visited);
  const Domain& domain = s.program->domain;
  Result<FieldProgram> program =
      compileField(cells, box, {s.finest_cell, cell_edge, domain.solid, makeLabel(domain.material, 0), nullptr});
  REQUIRE(program);
  return *std::move(program);
}

/// Puts `detail` in front of many of the rules' shapes, also inside of blends, meets, sums and cuts.
std::string withDetails(const std::string& text, std::mt19937& random) {
  std::string out;
  for (size_t at = 0; at < text.size(); ++at) {
    for (const char* shape : {"{ sphere(", "{ box(", "{ capsule(", "{ ellipsoid(", "; sphere(", "; box("}) {
      if (text.compare(at, std::strlen(shape), shape) != 0 || random() % 2 == 0) continue;
      out += text.substr(at, 2) + std::array{"detail 30cm ", "detail 1m ", "detail 4m "}[random() % 3];
      at += 2;
      break;
    }
    out += text[at];
  }
  return out;
}

bool sameMesh(const ChunkMesh& a, const ChunkMesh& b) {
  // Signs are omitted if all are proven to be equal. The two programs may have bounding boxes of different sizes, so
  // the proof may fail for one of the meshes.
  const bool uniform = a.signs.empty() || b.signs.empty();
  return a.body.hash == b.body.hash && a.solid_samples == b.solid_samples && (uniform || a.signs == b.signs) &&
         a.body.indices == b.body.indices;
}

}  // namespace

namespace {

std::string randomRules(std::mt19937& random, unsigned round) {
  RandomRules made(static_cast<uint32_t>(random()));
  const std::string text = withDetails(made.program(false), random);
  return round % 3 == 0 ? text + made.edits() : text;
}

/// A random combined shape; most of its parts are visible only at some levels. It lies up to 20 m outside of the
/// grammar cell.
std::string partedShape(std::mt19937& random, int depth) {
  const auto any = [&](int below) { return static_cast<int>(random() % static_cast<unsigned>(below)); };
  const auto leaf = [&] {
    return "at(" + std::to_string(-any(20)) + "m, " + std::to_string(any(6)) + "m, 0m) " +
           (any(2) == 0 ? "sphere(" : "box(") + std::to_string(1 + any(4)) + "m);";
  };
  std::string out = any(3) == 0 ? "union smooth 1m { " : any(4) == 0 ? "displace 0.3m*fractal(2m) { " : "{ ";
  for (int i = 2 + any(3); i > 0; --i) {
    if (any(4) > 0) out += std::array{"detail 30cm ", "detail 1m ", "detail 4m "}[random() % 3];
    out += depth > 0 && any(2) == 0   ? partedShape(random, depth - 1)
           : depth > 0 && any(3) == 0 ? "Near(" + std::to_string(any(20)) + "m);"
                                      : leaf();
    out += ' ';
  }
  if (any(2) == 0) out += "cut " + leaf();
  return out + " }";
}

std::string partedShapes(std::mt19937& random, unsigned) {
  std::string out =
      "sgm 1; domain infinite; layer l cell 256m reach 150m { start R; }\n"
      "rule Near(d) { at(-1*d, 0m, 0m) sphere(2m); }\nrule Near(d) lod 2m { box(3m); }\nrule R { Parted; }\nrule "
      "Parted { ";
  for (int i = 0; i < 3; ++i) out += partedShape(random, 2) + " ";
  return out + "}\n";
}

/// Numbers of shapes that were left out: because the level does not show them, and because they exceed the reach.
struct LeftOut {
  size_t by_level = 0, by_reach = 0;
};

/// Compares the levels of random grammars. reach: 0 for the declared and proven reach; otherwise the distance in units
/// beyond which shapes are left out.
LeftOut compareLevels(unsigned seed, std::string (*rules)(std::mt19937&, unsigned), int32_t reach, unsigned tries) {
  std::mt19937 random(seed);
  const auto jobs = *makeThreadPool(1);
  const auto backend = *makeBackend({}, *jobs, std::pmr::get_default_resource());
  size_t surfaces = 0;
  LeftOut out;
  // Only in few random grammars do coarse levels omit any shape. So there are more rounds, at most 1000, until this has
  // happened once.
  for (unsigned round = 0; round < tries || (reach == 0 && out.by_level == 0 && round < 1000); ++round) {
    const std::string text = rules(random, round);
    const CompileResult compiled = compileGrammar(text, "test.sgm");
    if (!compiled.program) continue;
    CAPTURE(round, text);
    WorldFieldSettings settings = settingsOf(text, kFinest, random());
    if (reach > 0) {
      Program tight = *settings.program;
      tight.layers[0].reach = reach;
      settings.program = std::make_shared<const Program>(std::move(tight));
      settings.on_notes = [&](const GrammarChunk& chunk) {
        for (const DeriveNote& note : chunk.notes)
          out.by_reach += note.message.starts_with("this shape may pass the r");
      };
    }
    const WorldField world(settings, std::pmr::get_default_resource());
    std::vector<int> levels{0, 1, 2, 3, 4, 5, 6};
    std::shuffle(levels.begin(), levels.end(), random);
    for (const int level : levels) {
      const ChunkKey key{level, {static_cast<int32_t>(random() % 2) - 1, 0, static_cast<int32_t>(random() % 2) - 1}};
      const ChunkGrid grid = *chunkGrid(world, key);
      const IntBox box = chunkBox(grid);
      const auto whole = std::make_shared<const FieldProgram>(fromWholeCells(world, box, level));
      const auto coarse = *world.compile(box, level);
      out.by_level += coarse->instrs.size() < whole->instrs.size();
      std::vector<ChunkJob> pair(2);
      for (ChunkJob& job : pair) job.grid = grid, job.signs = true;
      pair[0].field = whole, pair[1].field = coarse;
      const auto batch = *backend->submit(std::move(pair), {});
      batch->wait();
      const std::vector<ChunkMesh> meshes = *batch->take();
      CAPTURE(level);
      CHECK(sameMesh(meshes[0], meshes[1]));
      surfaces += !meshes[0].body.indices.empty();
    }
  }
  CHECK(surfaces > 0);
  return out;
}

}  // namespace

TEST_CASE("chunks of coarse levels are those of whole cells, in whatever order levels are asked for", "[costly]") {
  const unsigned seed = testSeed();
  CAPTURE(seed);
  CHECK(compareLevels(seed, randomRules, 0, rounds(120)).by_level > 0);
}

TEST_CASE("what passes its reach is left out of near levels and of far ones alike") {
  const unsigned seed = testSeed();
  CAPTURE(seed);
  const LeftOut out = compareLevels(seed, partedShapes, 12 * kUnitsPerMetre, rounds(120));
  CHECK(out.by_reach > 0);
}

TEST_CASE("of a city block far levels derive and keep a fraction") {
  const WorldFieldSettings s = settingsOf(sample("city.sgm"), 512);
  const WorldField world(s, std::pmr::get_default_resource());
  const LayersBelow none(world, {{0, 0, 0}, {1, 1, 1}});
  size_t whole = 0, far = 0;
  for (int32_t x = 0; x < 4; ++x) {
    whole += deriveCell(*s.program, s.parameters, s.seed, 1, {x, 0, 0}, none)->shapes.size();
    far += deriveCoarseCell(*s.program, s.parameters, s.seed, 1, {x, 0, 0}, 16 * 1024, none)->shapes.size();
  }
  CHECK(far > 0);
  CHECK(far * 20 < whole);
}

TEST_CASE("of an apartment house the finest level derives what its cells show alone") {
  constexpr const char* kHouses = R"(sgm 1;
import "std/facade.sgm" as facade;
units m;
domain infinite axes xz empty;
layer houses cell 32m reach 8m { start Plot; }
rule Plot { at(16m, 9m, 16m) size(14m, 17m, 12m) facade.Flats(corner true); }
)";
  const WorldField world(settingsOf(kHouses, 512), std::pmr::get_default_resource());
  size_t whole = 0, shown = 0;
  for (int32_t x = 0; x < 4; ++x) {
    const auto all = world.cell(0, {x, 0, 0});
    const auto finest = world.cellFor(0, {x, 0, 0}, 512);
    REQUIRE(all);
    REQUIRE(finest);
    whole += (*all)->chunk.shapes.size();
    shown += (*finest)->chunk.shapes.size();
  }
  CHECK(shown > 100);
  CHECK(shown * 4 < whole);
}

TEST_CASE("what stands upon a lower layer sees more of it than the finest level shows") {
  constexpr const char* kProbed = R"(sgm 1;
units m;
domain infinite axes xz solid limestone;
layer net cell 32m reach 4m { start Node; }
layer balls cell 32m reach 4m uses net { start Balls; }
rule Node { cut at(16m, 0m, 16m) Hall; }
rule Hall { box(24m, 8m, 24m); }
rule Hall lod 40cm { box(24.1m, 8.1m, 24.1m); }
rule Balls { scatter 40 on disc(10m) at(16m, 0m, 16m) sphere(0.5m); at(16m, 0m, 16m) scatter 40 on disc(10m) probe up 8m of net sphere(0.5m); }
)";
  const WorldField world(settingsOf(kProbed, 512), std::pmr::get_default_resource());
  const auto balls = world.cellFor(1, {0, 0, 0}, 512);
  REQUIRE(balls);
  CHECK((*balls)->chunk.shapes.size() == 80);
}
