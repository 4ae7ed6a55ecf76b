// Tests the results of queries of lower layers against the field.

#include <cmath>
#include <random>

#include "backend/cpu/instruction_sets.h"
#include "derive/random_rules.h"
#include "rounds.h"
#include "seed.h"
#include "world/layers_below.h"
#include "world_support.h"

using namespace sgm;

namespace {

Int3 near(std::mt19937& random, Int3 p, int32_t most) {
  std::uniform_int_distribution<int32_t> by(-most, most);
  return saturatingAdd(p, {by(random), by(random), by(random)});
}

bool holds(const Ball& ball, Int3 p) {
  int64_t square = 0;
  for (int axis = 0; axis < 3; ++axis) square += int64_t{p[axis] - ball.centre[axis]} * (p[axis] - ball.centre[axis]);
  return square <= int64_t{ball.radius} * ball.radius;
}

/// Positions in the ball: a lattice of them, and as many random ones.
std::vector<Int3> positionsIn(std::mt19937& random, const Ball& ball) {
  std::vector<Int3> found{ball.centre};
  for (int k = 0; k < 1000; ++k) {
    const auto at = [&](int i) { return static_cast<int32_t>(int64_t{ball.radius} * (2 * i - 9) / 9); };
    const Int3 on = saturatingAdd(ball.centre, {at(k % 10), at(k / 10 % 10), at(k / 100)});
    for (const Int3 p : {on, near(random, ball.centre, ball.radius)}) {
      if (holds(ball, p)) found.push_back(p);
    }
  }
  return found;
}

struct Sampled {
  std::vector<int32_t> q;
  float centre = 0;  ///< the field's value at the ball's centre, in units
};

Sampled sampled(const WorldField& world, uint32_t layer, const std::vector<Int3>& at) {
  IntBox box;
  std::vector<int32_t> x, y, z;
  for (const Int3 p : at) {
    box = box.joined({p, p});
    x.push_back(p.x);
    y.push_back(p.y);
    z.push_back(p.z);
  }
  const auto program = world.compileBelow(layer, box);
  REQUIRE(program);
  Sampled out;
  out.q.resize(at.size());
  EvalScratch scratch;
  const Points points{x.data(), y.data(), z.data(), x.size()};
  scalarKernels().samples((*program)->view(), points, scratch, out.q.data());
  Attributes value;
  value.value = &out.centre;
  scalarKernels().attributes((*program)->view(), {x.data(), y.data(), z.data(), 1}, scratch, value);
  return out;
}

/// A hall in rock whose walls are displaced by `amp` metres of noise, and a layer that queries the hall's layer
/// everywhere.
std::string hall(const std::string& amp, const std::string& condition) {
  return "sgm 1; import \"std/rock.sgm\" as rock; domain infinite solid;\n"
         "param width = 9m in 6m..12m; param other = 1 in 0..2;\n"
         "layer net cell 64m reach 8m { start Net; }\nlayer drip cell 16m reach 8m uses net { start Drips; }\n"
         "rule Net { cut { at(cell.center) { displace rock.fbm(period 16m, amp " +
         amp +
         ", octaves 1) { sphere(width); } } } }\n"
         "rule Drips { scatter poisson(2m) when " +
         condition + " { anchor spawn; box(0.5m); } }\n";
}

std::vector<Anchor> anchorsIn(const WorldField& world, const std::vector<Int3>& cells) {
  std::vector<Anchor> found;
  for (const Int3 at : cells) {
    const auto cell = world.cell(1, at);
    REQUIRE(cell);
    found.insert(found.end(), (*cell)->chunk.anchors.begin(), (*cell)->chunk.anchors.end());
  }
  std::sort(found.begin(), found.end(),
            [](const Anchor& a, const Anchor& b) { return a.frame.origin < b.frame.origin; });
  return found;
}

std::vector<Int3> cellsOfHall() {
  std::vector<Int3> cells;
  for (int32_t k = 0; k < 64; ++k) cells.push_back({k % 4, k / 4 % 4, k / 16});
  return cells;
}

}  // namespace

TEST_CASE("what a query proves of a ball holds at every position in it, in any world and whoever asks") {
  const unsigned seed = testSeed();
  CAPTURE(seed);
  std::mt19937 random(seed);
  size_t open = 0, solid = 0;
  // Rounds continue until both an open and a solid ball were proven.
  for (unsigned round = 0; round < rounds(60) || ((open == 0 || solid == 0) && round < 600); ++round) {
    const uint64_t rules = random();
    std::string text = RandomRules(rules).program(false);
    if (round % 2 == 0) text = replaced(text, "domain infinite;", "domain infinite solid;");
    if (round % 2 == 0) text = replaced(text, "{ start ", "{ start Cuts; } rule Cuts { cut { ");
    if (round % 2 == 0) text = replaced(text, "(2m); }", "(2m); } }");
    const CompileResult compiled = compileGrammar(text, "test.sgm");
    if (!compiled.program) continue;
    const WorldField world(settingsOf(text, 512, rules), std::pmr::get_default_resource());
    CAPTURE(round, text);
    const IntBox cell{{0, 0, 0}, {1024, 1024, 1024}};
    const LayersBelow below(world, cell.grown(16 * 1024)), other(world, cell.grown(9 * 1024)), none(world, cell);
    for (int k = 0; k < 40; ++k) {
      const Ball ball{near(random, {}, 6 * 1024), static_cast<int32_t>(random() % 2048)};
      const bool clear = below.prove(0, ball, BoxContent::open).holds;
      const bool inside = below.prove(0, ball, BoxContent::solid).holds;
      for (const LayersBelow* same : {&other, &none}) {
        CHECK(same->prove(0, ball, BoxContent::open).holds == clear);
        CHECK(same->prove(0, ball, BoxContent::solid).holds == inside);
      }
      CHECK_FALSE((clear && inside));
      const bool rock = below.solid(0, ball.centre);
      CHECK(below.prove(0, {ball.centre, 0}, BoxContent::solid).holds == rock);
      CHECK(below.prove(0, {ball.centre, 0}, BoxContent::open).holds == !rock);
      if (!clear && !inside) continue;
      (clear ? open : solid) += 1;
      const Sampled field = sampled(world, 0, positionsIn(random, ball));
      CHECK(std::all_of(field.q.begin(), field.q.end(), [&](int32_t q) { return (q < 0) == inside; }));
    }
    REQUIRE_FALSE(below.error());
  }
  CHECK(open > 0);
  CHECK(solid > 0);
}

TEST_CASE("a ball is decided wherever the field's slope leaves no doubt, also between the crests of a noise") {
  const unsigned seed = testSeed();
  CAPTURE(seed);
  std::mt19937 random(seed);
  // kSlope: the largest slope of the displaced field. kPieces: 1 plus twice the diagonal of the proof's smallest
  // pieces, in radii of the ball. The edge of these pieces is 1/32 of the radius. One diagonal is for the extent of the
  // pieces, the other for the error of their bounds.
  constexpr double kSlope = 1 + 3.7501 * 1.5 / 16, kPieces = 1.12;
  size_t among_crests = 0;
  const WorldField world(settingsOf(hall("1.5m", "query clear of net"), 512, seed), std::pmr::get_default_resource());
  const Int3 middle{32 * 1024, 32 * 1024, 32 * 1024};
  const LayersBelow below(world, IntBox{middle, middle}.grown(16 * 1024));
  for (unsigned round = 0; round < rounds(600); ++round) {
    const Ball ball{near(random, middle, 7 * 1024), static_cast<int32_t>(random() % 700)};
    const double there = double{sampled(world, 0, {ball.centre}).centre};
    CAPTURE(ball.centre.x, ball.centre.y, ball.centre.z, ball.radius, there);
    if (std::abs(there) > 1e6) continue;
    if (std::abs(there) < kSlope * kPieces * ball.radius + 8) continue;
    among_crests += std::abs(there) < 1.5 * 1024;
    const BallProof proof = below.prove(0, ball, there < 0 ? BoxContent::solid : BoxContent::open);
    CHECK(proof.holds);
  }
  CHECK(among_crests > 0);
}

TEST_CASE("what is asked decides about shapes: the same in any order, and as the field says", "[costly]") {
  const std::vector<Int3> cells = cellsOfHall();
  const WorldField world(settingsOf(hall("0.7m", "query clear 1m of net"), 512), std::pmr::get_default_resource());
  const std::vector<Anchor> expected = anchorsIn(world, cells);
  REQUIRE(expected.size() > 50);
  size_t far = 0;
  std::mt19937 random(5);
  for (const Anchor& a : expected) {
    const Sampled field = sampled(world, 0, positionsIn(random, {a.frame.origin, 1024}));
    CHECK(std::all_of(field.q.begin(), field.q.end(), [](int32_t q) { return q >= 0; }));
  }
  // Every anchor that is a little farther from the walls than the query requires must exist.
  const WorldField all(settingsOf(hall("0.7m", "true"), 512), std::pmr::get_default_resource());
  for (const Anchor& a : anchorsIn(all, cells)) {
    const double there = double{sampled(world, 0, {a.frame.origin}).centre};
    if (there < 1.4 * 1024 || there > 1e6) continue;
    ++far;
    CHECK(std::any_of(expected.begin(), expected.end(),
                      [&](const Anchor& b) { return b.frame.origin == a.frame.origin; }));
  }
  CHECK(far > 50);
  for (unsigned round = 0; round < rounds(3); ++round) {
    std::vector<Int3> order = cells;
    std::shuffle(order.begin(), order.end(), random);
    WorldFieldSettings settings = settingsOf(hall("0.7m", "query clear 1m of net"), 512);
    settings.cache_bytes = 1;
    const std::vector<Anchor> found = anchorsIn(WorldField(settings, std::pmr::get_default_resource()), order);
    REQUIRE(found.size() == expected.size());
    for (size_t i = 0; i < found.size(); ++i) CHECK(found[i].frame.origin == expected[i].frame.origin);
  }
}

TEST_CASE("who asks depends on the parameters of what is asked about") {
  const auto deriving = [](const std::string& condition, double width) {
    WorldFieldSettings settings = settingsOf(hall("0.7m", condition), 512);
    REQUIRE(settings.parameters.set(*settings.program, "width", width));
    return settings;
  };
  const WorldFieldSettings narrow = deriving("query inside 0.5m of net", 7);
  const WorldField a(narrow, std::pmr::get_default_resource());
  const WorldField b(deriving("query inside 0.5m of net", 11), std::pmr::get_default_resource());
  const WorldField never(deriving("true", 7), std::pmr::get_default_resource());
  const Int3 wall{1, 1, 1};
  const uint64_t bit = parameterBit(narrow.program->findParam("width"));
  const auto asked = a.cell(1, wall), plain = never.cell(1, wall);
  REQUIRE(asked);
  REQUIRE(plain);
  CHECK(((*asked)->chunk.parameters & bit) != 0);
  CHECK(((*asked)->chunk.parameters & parameterBit(narrow.program->findParam("other"))) == 0);
  CHECK(((*plain)->chunk.parameters & bit) == 0);
  CHECK_FALSE(b.derivesAlike(a, (*asked)->chunk.parameters));
  CHECK(anchorsIn(a, {wall}).size() != anchorsIn(b, {wall}).size());
}

TEST_CASE("a world that is moved answers as at home") {
  const std::string probing =
      replaced(hall("0.7m", "true"), "poisson(2m) when true", "poisson(2m) probe down 3m of net");
  for (const std::string& text :
       {hall("0.7m", "query clear 1m of net"), hall("0.7m", "query inside of net"), probing}) {
    WorldFieldSettings settings = settingsOf(text, 512);
    const std::vector<Anchor> home = anchorsIn(WorldField(settings, std::pmr::get_default_resource()), cellsOfHall());
    settings.shift = {1'900'000'000, -1'900'000'000, 12'345};
    const std::vector<Anchor> there = anchorsIn(WorldField(settings, std::pmr::get_default_resource()), cellsOfHall());
    REQUIRE(there.size() == home.size());
    REQUIRE_FALSE(home.empty());
    for (size_t i = 0; i < home.size(); ++i)
      CHECK(there[i].frame.origin == saturatingAdd(home[i].frame.origin, settings.shift));
  }
}
