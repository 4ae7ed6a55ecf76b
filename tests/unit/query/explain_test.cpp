// Tests explain(): compares its values with the field, and overrides the paths that it returns.

#include <algorithm>
#include <cmath>
#include <random>

#include "derive/chunk_ops.h"
#include "derive/random_rules.h"
#include "query/explain.h"
#include "query/queries.h"
#include "rounds.h"
#include "seed.h"
#include "world/world_support.h"

using namespace sgm;

namespace {

std::array<double, 3> anyPlace(std::mt19937& random, double extent) {
  std::uniform_real_distribution<double> by(-extent * kUnitsPerMetre, extent * kUnitsPerMetre);
  return {by(random), by(random), by(random)};
}

/// The position in whole units that is nearest to a point on the surface.
Int3 nearestUnit(const std::array<double, 3>& p) {
  return {static_cast<int32_t>(std::lround(p[0])), static_cast<int32_t>(std::lround(p[1])),
          static_cast<int32_t>(std::lround(p[2]))};
}

/// True if every operation above the shape (unite, meet, subtract) either ignores the shape's value, or passes it on
/// unchanged or with the opposite sign.
bool isExact(const std::vector<ExplainedNode>& nodes, size_t leaf) {
  for (size_t i = 0; i < leaf; ++i) {
    const ShapeKind kind = nodes[i].kind;
    if (kind != ShapeKind::unite && kind != ShapeKind::meet && kind != ShapeKind::subtract) return false;
  }
  return true;
}

struct Count {
  size_t told = 0, exact = 0, edited = 0;
};

/// Explains random surface points of the world, and overrides the explained paths.
void checkWorld(const std::string& text, uint64_t seed, int32_t cell, double extent, std::mt19937& random,
                unsigned places, Count& count) {
  const WorldField world(settingsOf(text, cell, seed), std::pmr::get_default_resource());
  for (unsigned i = 0; i < places; ++i) {
    const auto surface = closestPoint(queryField(world), anyPlace(random, extent), 30.0 * kUnitsPerMetre);
    REQUIRE(surface);
    if (!*surface) continue;
    const Int3 p = nearestUnit((**surface).position);
    const Result<Explanation> found = explain(world, p);
    REQUIRE(found);
    CAPTURE(p.x, p.y, p.z);
    CHECK(found->solid == (found->value < 0));
    REQUIRE_FALSE(found->nodes.empty());
    const ExplainedNode& whole = found->nodes[0];
    const ExplainedNode& leaf = found->nodes[found->leaf];
    CAPTURE(leaf.path);
    ++count.told;
    // If two groups touch at the place, explain() may find either group: both have the world's field value there.
    CHECK((whole.cuts ? -whole.value : whole.value) == found->value);
    if (isExact(found->nodes, found->leaf)) {
      CHECK(std::fabs(leaf.value) == std::fabs(found->value));
      ++count.exact;
    }
    CHECK(leaf.path.find("override") == std::string::npos);
    const CompileResult edited = compileGrammar(text + "\noverride \"" + leaf.path + "\" { }\n", "test.sgm");
    INFO(renderDiagnostics(edited));
    // A use that already has an override cannot get a second one, unless the second one keeps the original (`inner`).
    if (!edited.program && edited.diagnostics[0].code == "duplicate") {
      CHECK(compileGrammar(text + "\noverride \"" + leaf.path + "\" { inner; }\n", "test.sgm").program);
      continue;
    }
    // A displaced sum must keep its largest shape, so some of the overrides do not compile.
    if (!edited.program && text.find("sum") != std::string::npos) continue;
    REQUIRE(edited.program);
    const WorldField without(settingsOf(text + "\noverride \"" + leaf.path + "\" { }\n", cell, seed),
                             std::pmr::get_default_resource());
    const Result<Explanation> after = explain(without, p);
    REQUIRE(after);
    count.edited += after->value != found->value;
  }
}

}  // namespace

TEST_CASE("what is said to make a surface makes it: without it the field is another there") {
  const unsigned seed = testSeed();
  CAPTURE(seed);
  std::mt19937 random(seed);
  Count count;
  for (const char* name :
       {"table4/lipp.sgm", "building.sgm", "table4/muller.sgm", "houses.sgm", "cave.sgm", "tunnels.sgm"}) {
    CAPTURE(name);
    checkWorld(sample(name), random(), 512, 14, random, std::max(rounds(8), 4u), count);
  }
  CHECK(count.told > 10);
  CHECK(count.exact > 0);
  // Removing a shape may leave the field unchanged, because another shape contains the shape or shares its face. So the
  // check requires only that half of the removals change the field.
  CHECK(count.edited * 2 > count.told);
}

TEST_CASE("of random grammars explain() finds the shape that decides") {
  const unsigned seed = testSeed();
  CAPTURE(seed);
  std::mt19937 random(seed);
  Count count;
  // A quarter of the random grammars does not compile, and others have no surface nearby, so rounds continue until
  // enough were explained.
  for (unsigned round = 0; round < rounds(40) || (count.told <= 20 && round < 400); ++round) {
    const uint64_t rules = random();
    const std::string text = RandomRules(rules).program(false);
    if (!compileGrammar(text, "test.sgm").program) continue;
    CAPTURE(round, text);
    checkWorld(text, rules, 256, 6, random, 4, count);
  }
  CHECK(count.told > 20);
  CHECK(count.edited * 2 > count.told);
}

TEST_CASE("what an override has made is told by the path that the override takes") {
  const std::string head =
      "sgm 1; units m; domain infinite; layer net cell 16m reach 8m { start N; }\n"
      "rule N { at(8m, 8m, 8m) M; }\nrule M { box(2m); tag \"m\"; }\nrule D { at(y 1m) E; }\nrule E { sphere(1m); }\n";
  for (const char* edit :
       {"override \"N/M[0]\" { D; }", "override tag \"m\" { inner; D; }", "override \"net(0, 0, 0)/N/M[0]\" { D; }"}) {
    CAPTURE(edit);
    std::mt19937 random(1);
    Count count;
    const std::string text = head + edit;
    const WorldField world(settingsOf(text, 512), std::pmr::get_default_resource());
    const Result<Explanation> found = explain(world, {8 * 1024, 9 * 1024 + 1020, 8 * 1024});
    REQUIRE(found);
    REQUIRE_FALSE(found->nodes.empty());
    CHECK(found->nodes[found->leaf].kind == ShapeKind::sphere);
    CHECK(found->nodes[found->leaf].path == "net(0, 0, 0)/N/M[0]");
    checkWorld(text, 0, 512, 14, random, 2, count);
  }
}

TEST_CASE("a trace is the cell, and each shape has a use of a rule and a place in the text") {
  for (const char* name : {"cave.sgm", "building.sgm", "edits.sgm"}) {
    const WorldField world(settingsOf(sample(name), 512), std::pmr::get_default_resource());
    for (uint32_t layer = 0; layer < world.settings().program->layers.size(); ++layer) {
      const Result<TracedCell> traced = world.trace(layer, {});
      REQUIRE(traced);
      CHECK(hashChunk(traced->chunk) == hashChunk((*world.cell(layer, {}))->chunk));
      REQUIRE(traced->origins.size() == traced->chunk.shapes.size());
      for (const ShapeOrigin& origin : traced->origins) {
        REQUIRE(origin.use < traced->uses.size());
        CHECK_FALSE(traced->uses[origin.use].empty());
        CHECK(origin.span.line > 0);
      }
    }
  }
}

TEST_CASE("far from every shape the domain decides") {
  const WorldField world(settingsOf(sample("building.sgm"), 512), std::pmr::get_default_resource());
  const Result<Explanation> found = explain(world, {0, 100 * 1024 * 1024, 0});
  REQUIRE(found);
  CHECK_FALSE(found->solid);
  CHECK(found->nodes.empty());
}
