// Tests branching skeletons: the turtle's commands, and that no part of a tree depends on how the rest grows.

#include "derive/layout/skeleton.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <random>

#include "base/math.h"
#include "derive_fixture.h"
#include "rounds.h"

using namespace sgm;

namespace {

bool same(Vec3 a, Vec3 b) { return a.x == b.x && a.y == b.y && a.z == b.z; }

/// The angle between two vectors in radians, accurate also near 0.
double angleBetween(Vec3 a, Vec3 b) { return std::atan2(length(cross(a, b)), dot(a, b)); }

Vec3 headingOf(const Segment& s) { return s.to - s.from; }

int stepOf(const Segment& s, const Turtle& turtle) { return static_cast<int>(std::lround(s.along * turtle.steps)); }

/// The segments of a tree by key; checks that no two segments have the same key.
std::map<PathKey, Segment> byKey(const Skeleton& skeleton) {
  std::map<PathKey, Segment> all;
  for (const Segment& s : skeleton.segments) all.emplace(s.key, s);
  CHECK(all.size() == skeleton.segments.size());
  return all;
}

Turtle randomTurtle(std::mt19937& random) {
  std::uniform_real_distribution<double> unit(0, 1);
  const double turn = unit(random) < 0.1 ? kPi / 2 : unit(random) * kPi / 2;
  return {1 + std::floor(10 * unit(random)), std::exp(6 * unit(random) - 3), turn, 0.6 * unit(random)};
}

/// Checks that a tree satisfies the contract in skeleton.h. Returns the number of forks in the tree.
int checkTree(const Skeleton& skeleton, const Turtle& turtle) {
  constexpr double kSlack = 1e-7;
  int forks = 0;
  const std::vector<Segment>& all = skeleton.segments;
  REQUIRE(all.size() >= static_cast<size_t>(turtle.steps));
  CHECK(same(all[0].from, {}));
  CHECK(headingOf(all[0]).y == turtle.length);
  for (size_t i = 0; i < all.size(); ++i) {
    const Segment& s = all[i];
    CAPTURE(i, s.along, s.depth);
    REQUIRE(std::fabs(length(headingOf(s)) - turtle.length) <= 1e-12 * turtle.length * turtle.steps);
    REQUIRE(length(s.from) <= turtle.length * stepOf(s, turtle) * (1 + 1e-9));
    REQUIRE(length(s.to) <= turtle.length * turtle.steps * (1 + 1e-9));
    REQUIRE((s.along >= 0 && s.along < 1));
    REQUIRE(s.depth <= static_cast<uint32_t>(stepOf(s, turtle)));
    if (stepOf(s, turtle) == 0) continue;
    if (same(all[i - 1].to, s.from) && all[i - 1].depth == s.depth) {
      REQUIRE(stepOf(all[i - 1], turtle) + 1 == stepOf(s, turtle));
      REQUIRE(angleBetween(headingOf(all[i - 1]), headingOf(s)) <= turtle.turn + kSlack);
      continue;
    }
    ++forks;
    REQUIRE(s.depth > 0);
    const auto parent = std::find_if(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(i), [&](const Segment& p) {
      return same(p.to, s.from) && p.depth + 1 == s.depth && stepOf(p, turtle) + 1 == stepOf(s, turtle);
    });
    REQUIRE(parent != all.begin() + static_cast<std::ptrdiff_t>(i));
    const double off = angleBetween(headingOf(*parent), headingOf(s));
    REQUIRE(off >= turtle.turn - kSlack);
    REQUIRE(off <= std::min(2 * turtle.turn, kPi / 2) + kSlack);
    // The parent's branch has a next segment, because no side branch starts at a branch's end.
    const Segment& onward = *(parent + 1);
    REQUIRE(same(onward.from, s.from));
    REQUIRE(angleBetween(headingOf(onward), headingOf(s)) >= turtle.turn - kSlack);
  }
  return forks;
}

/// The capsules of a tree that a grammar makes: their ends and radii, exactly.
std::vector<std::array<double, 7>> capsules(const GrammarChunk& chunk, Int3 about = {}) {
  std::vector<std::array<double, 7>> out;
  for (const Shape& s : chunk.shapes) {
    if (s.kind != ShapeKind::capsule) continue;
    const Int3 at = saturatingSub(s.frame.origin, about);
    out.push_back({static_cast<double>(at.x), static_cast<double>(at.y), static_cast<double>(at.z),
                   static_cast<double>(s.size[0]), static_cast<double>(s.size[1]), static_cast<double>(s.size[2]),
                   static_cast<double>(s.size[3])});
  }
  std::sort(out.begin(), out.end());
  return out;
}

std::string treeOf(const std::string& arguments) {
  return "for s in branch(" + arguments + ") { capsule(s.from, s.to, rand(s, 0.1m, 0.4m)); }";
}

}  // namespace

TEST_CASE("a turtle keeps its step, its cone and its joints") {
  const uint32_t seed = 4101;
  CAPTURE(seed);
  std::mt19937 random(seed);
  int forks = 0;
  const unsigned trees = rounds(400);
  for (unsigned i = 0; i < trees; ++i) {
    const Turtle turtle = randomTurtle(random);
    CAPTURE(i, turtle.steps, turtle.length, turtle.turn, turtle.fork);
    const Skeleton skeleton = grownSkeleton(PathKey{i}, turtle);
    if (skeleton.whole) forks += checkTree(skeleton, turtle);
    byKey(skeleton);
  }
  CHECK(forks > static_cast<int>(2 * trees));
}

TEST_CASE("a turtle turns evenly within its cone, to all sides") {
  const Turtle turtle{2, 1, 1.0, 0};
  Vec3 sum;
  double share = 0;
  const int trees = 4000;
  for (int i = 0; i < trees; ++i) {
    const Vec3 heading = headingOf(grownSkeleton(PathKey{static_cast<uint64_t>(i)}, turtle).segments[1]);
    sum = sum + heading;
    share += (1 - heading.y) / (1 - std::cos(turtle.turn));
  }
  CHECK(share / trees == Approx(0.5).margin(0.02));
  CHECK(sum.x / trees == Approx(0).margin(0.03));
  CHECK(sum.z / trees == Approx(0).margin(0.03));
}

TEST_CASE("as many side branches as `fork` says") {
  // At each step, every branch continues, and a share of 0.2 of the branches gets a side branch.
  const Turtle turtle{8, 1, 0.4, 0.2};
  const double expected = (std::pow(1.2, 8) - 1) / 0.2;
  double segments = 0;
  const int trees = 4000;
  for (int i = 0; i < trees; ++i)
    segments += static_cast<double>(grownSkeleton(PathKey{static_cast<uint64_t>(i)}, turtle).segments.size());
  CHECK(segments / trees == Approx(expected).epsilon(0.03));
  CHECK(grownSkeleton(PathKey{1}, {9, 1, 0.4, 0}).segments.size() == 9);
  CHECK(grownSkeleton(PathKey{1}, {9, 1, 0.4, 1}).segments.size() == 511);
  // With an angle of 0, side branches would lie on the stem, so the tree has none.
  CHECK(grownSkeleton(PathKey{1}, {9, 1, 0, 1}).segments.size() == 9);
}

TEST_CASE("less fork leaves branches out, fewer steps cut them short; what is left stays") {
  const uint32_t seed = 4102;
  CAPTURE(seed);
  std::mt19937 random(seed);
  size_t left_out = 0;
  const unsigned trees = rounds(200);
  for (unsigned i = 0; i < trees; ++i) {
    Turtle turtle = randomTurtle(random);
    CAPTURE(i, turtle.steps, turtle.turn, turtle.fork);
    const Skeleton tree = grownSkeleton(PathKey{i}, turtle);
    if (!tree.whole) continue;
    const std::map<PathKey, Segment> all = byKey(tree);
    Turtle sparse = turtle, brief = turtle;
    sparse.fork = 0.4 * turtle.fork;
    brief.steps = 1 + std::floor(0.6 * turtle.steps);
    for (const Turtle& less : {sparse, brief}) {
      const Skeleton part = grownSkeleton(PathKey{i}, less);
      REQUIRE(part.segments.size() <= all.size());
      left_out += all.size() - part.segments.size();
      for (const Segment& s : part.segments) {
        const auto found = all.find(s.key);
        REQUIRE(found != all.end());
        REQUIRE(same(found->second.from, s.from));
        REQUIRE(same(found->second.to, s.to));
        REQUIRE(found->second.depth == s.depth);
        REQUIRE(stepOf(found->second, turtle) == stepOf(s, less));
      }
    }
  }
  CHECK(left_out > 5 * trees);
}

TEST_CASE("a tree that is too large lacks twigs, not its stem and boughs") {
  const Turtle turtle{13, 1, 0.4, 1};
  const Skeleton skeleton = grownSkeleton(PathKey{5}, turtle);
  CHECK_FALSE(skeleton.whole);
  CHECK(skeleton.segments.size() <= kMaxSegments);
  checkTree(skeleton, turtle);
  // If every joint forks, there are binomial(13, d + 1) segments of depth d.
  std::map<uint32_t, int> of_depth;
  for (const Segment& s : skeleton.segments) ++of_depth[s.depth];
  const int expected[] = {13, 78, 286, 715, 1287, 1716};
  for (uint32_t depth = 0; depth < 6; ++depth) CHECK(of_depth[depth] == expected[depth]);
  CHECK(grownSkeleton(PathKey{5}, {12, 1, 0.4, 1}).whole);
}

TEST_CASE("the tree of a grammar is where its scope is, and what stands at a segment knows that segment alone") {
  const uint32_t seed = 4103;
  CAPTURE(seed);
  std::mt19937 random(seed);
  for (unsigned i = 0; i < rounds(40); ++i) {
    const uint64_t world = random();
    const Int3 cell{static_cast<int32_t>(random() % 2001) - 1000, static_cast<int32_t>(random() % 21) - 10,
                    static_cast<int32_t>(random() % 2001) - 1000};
    CAPTURE(i, world, cell.x, cell.y, cell.z);
    const std::string grown = treeOf("7, step 3m, turn 30deg, fork 40%");
    const auto all = capsules(derivedRules("rule Main { " + grown + " }", cell, world));
    CHECK(all == capsules(derivedRules("rule Main { " + grown + " }", cell, world)));
    CHECK(all != capsules(derivedRules("rule Main { " + grown + " }", cell, world + 1)));
    // Moving the scope by whole units moves the branches by exactly as much.
    const auto moved = capsules(derivedRules("rule Main { at(4m, -8m, 16m) " + grown + " }", cell, world),
                                {4 * 1024, -8 * 1024, 16 * 1024});
    CHECK(all == moved);
    // The stem is the same as that of a tree without side branches.
    const std::string bare = treeOf("7, step 3m, turn 30deg");
    const auto stem = capsules(derivedRules("rule Main { " + bare + " }", cell, world));
    REQUIRE(stem.size() == 7);
    CHECK(std::includes(all.begin(), all.end(), stem.begin(), stem.end()));
    // Two trees in one rule draw different random numbers.
    const auto two = capsules(derivedRules("rule Main { " + bare + " " + bare + " }", cell, world));
    REQUIRE(two.size() == 14);
    CHECK(std::adjacent_find(two.begin(), two.end()) == two.end());
  }
}

TEST_CASE("segments go through lets and rules, and know how far and how deep they are") {
  const GrammarChunk chunk = derivedRules(
      "rule Main { let tree = branch(6, step 2m, turn 40deg, fork 50%); for s in tree { Limb(s); } }\n"
      "rule Limb(s) when s.depth == 0 { capsule(s.from, s.to, 1m - 0.6m*s.along); }\n"
      "rule Limb(s) else { sphere(0.1m*s.depth); }");
  CHECK(chunk.notes.empty());
  const auto stem = capsules(chunk);
  REQUIRE(stem.size() == 6);
  std::vector<double> radii;
  for (const auto& limb : stem) radii.push_back(limb[3] / 1024);
  std::sort(radii.begin(), radii.end(), std::greater<>());
  for (size_t i = 0; i < 6; ++i) CHECK(radii[i] == Approx(1 - 0.1 * static_cast<double>(i)));
  CHECK(chunk.groups.size() > 6);
}

TEST_CASE("what a branch cannot be is said, and the rest of the cell is whole") {
  const auto noteOf = [](const std::string& arguments, size_t segments) {
    const auto program = compiled(
        "sgm 1; param step = 0m in -1m..1m; param turn = 100deg in 0deg..200deg; param fork = 2 in 0..3;\n"
        "param steps = 5000 in 0..9000; domain infinite; layer l cell 4km reach 9km { start Main; }\n"
        "rule Main { sphere(1m); Coral; }\nrule Coral { for s in branch(" +
        arguments + ") { at(s.from) sphere(1m); } }");
    const GrammarChunk chunk = derived(*program);
    CHECK(chunk.groups.size() == 1 + segments);
    REQUIRE(chunk.notes.size() == 1);
    CHECK(chunk.notes[0].path == "l(0, 0, 0)/Main/Coral[0]");
    CHECK(chunk.notes[0].line == 4);
    return chunk.notes[0].message;
  };
  CHECK(noteOf("5, step step, turn 10deg", 0) ==
        "the `step` of a branch is a length above 0, such as step 6m; this one is left out");
  CHECK(noteOf("5, step 1m, turn turn", 0) ==
        "the `turn` of a branch is 0deg to 90deg, such as turn 25deg; this one is left out");
  CHECK(noteOf("5, step 1m, turn 10deg, fork fork", 0) ==
        "the `fork` of a branch is 0% to 100%, such as fork 20%; this one is left out");
  CHECK(noteOf("steps, step 1m, turn 10deg", 0) ==
        "a branch takes 0 to 4096 steps, raise `step` instead; this one is left out");
  CHECK(noteOf("13, step 1m, turn 10deg, fork 100%", 4096) ==
        "this branch has more than 4096 segments; side branches are left out: take fewer steps, or lower `fork`");
}

TEST_CASE("segments are steps and memory of the cell that grows them") {
  const auto program = compiled(
      "sgm 1; domain infinite; layer l cell 64m reach 64m { start Main; }\n"
      "rule Main { for i in 0..9 { let tree = branch(12, step 1m, turn 10deg, fork 100%); } }");
  const auto errorWith = [&](DeriveLimits limits) {
    const Result<GrammarChunk> chunk =
        deriveCell(*program, ParameterValues::defaults(*program), 1, 0, {}, Ceiling(0), limits);
    return chunk ? std::string() : chunk.error().message;
  };
  CHECK(errorWith({}).empty());
  DeriveLimits limits;
  limits.steps = 9 * 4095;
  CHECK(errorWith(limits) ==
        "deriving one cell takes more than 36855 steps (derive less, or make the cells smaller), in l(0, 0, 0)/Main");
  limits = {};
  limits.bytes = size_t{1} << 20;
  CHECK(errorWith(limits) ==
        "one cell takes more than 1 MiB (derive less, or make the cells smaller), in l(0, 0, 0)/Main");
}
