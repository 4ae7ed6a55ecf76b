// Tests what std/cave.sgm promises about water and flowstone, in worlds with flat grammar cells and with cubes.

#include <algorithm>
#include <random>

#include "field/evaluate.h"
#include "rounds.h"
#include "seed.h"
#include "world_support.h"

using namespace sgm;

namespace {

const char* const kLake = "layer lake cell 32m reach 1m { start Lake; }\n";

/// Halls and a lake in a world that is divided into cubic grammar cells.
const char* const kSunkenHalls =
    "sgm 1; import \"std/cave.sgm\" as cave; units m; param level = -3m in -200m..200m;\n"
    "domain infinite solid limestone;\n"
    "layer net cell 48m reach 24m { start Node; }\n"
    "layer lake cell 32m reach 1m { start Lake; }\n"
    "rule Node { cut { at(cell.point(jitter 0.4)) cave.Hall(rand(8m, 18m)); } }\n"
    "rule Lake { cave.Water(level); }\n";

/// For each point, whether a program is solid there.
std::vector<bool> solidAt(const FieldProgram& program, const std::vector<Int3>& points) {
  std::vector<int32_t> x, y, z, q(points.size());
  for (const Int3& p : points) {
    x.push_back(p.x);
    y.push_back(p.y);
    z.push_back(p.z);
  }
  EvalScratch scratch;
  scalarKernels().samples(program.view(), {x.data(), y.data(), z.data(), x.size()}, scratch, q.data());
  std::vector<bool> solid;
  for (const int32_t value : q) solid.push_back(value < 0);
  return solid;
}

}  // namespace

TEST_CASE("water fills all that is open below its level, and nothing above", "[std][costly]") {
  const unsigned seed = testSeed();
  CAPTURE(seed);
  std::mt19937 random(seed);
  for (const bool flat : {true, false}) {
    CAPTURE(flat);
    size_t filled = 0, open = 0;
    for (unsigned round = 0; round < 40 && (round < rounds(4) || filled <= 100 || open <= 100); ++round) {
      const std::string text = flat ? yardstick("lake.sgm") : kSunkenHalls;
      const uint64_t world_seed = random();
      const double level = flat ? -1.0 - static_cast<double>(random() % 10)
                                : static_cast<double>(random() % 300) - 150 + static_cast<double>(random() % 8) / 8;
      CAPTURE(level);
      const auto worldOf = [&](const std::string& of) {
        WorldFieldSettings settings = settingsOf(of, 512, world_seed);
        REQUIRE(settings.parameters.set(*settings.program, "level", level));
        return std::make_unique<WorldField>(std::move(settings), std::pmr::get_default_resource());
      };
      const auto surface = static_cast<int32_t>(level * kUnitsPerMetre);
      // The boxes lie around the water's surface, across the borders of cells, and far from the origin.
      const Int3 low{static_cast<int32_t>(random() % 4000) * 512 - 1'000'000, surface - 20 * 1024,
                     static_cast<int32_t>(random() % 4000) * 512 - 1'000'000};
      const IntBox box{low, {low.x + 64 * 1024, low.y + 40 * 1024, low.z + 64 * 1024}};
      std::vector<Int3> points;
      for (int i = 0; i < 20'000; ++i) {
        Int3 p;
        for (int axis = 0; axis < 3; ++axis) {
          p[axis] = box.lo[axis] + static_cast<int32_t>(random() % static_cast<uint32_t>(box.hi[axis] - box.lo[axis]));
        }
        if (i % 4 == 0) p.y = surface + static_cast<int32_t>(random() % 9) - 4;
        if (p.y != surface) points.push_back(p);
      }
      // Some points lie in the corners and on the faces of cells.
      for (int i = 0; i < 500; ++i) {
        const int32_t cell = 32 * 1024;
        Int3 p = points[static_cast<size_t>(random() % points.size())];
        for (int axis = 0; axis < 3; axis += 1 + static_cast<int>(random() % 2)) {
          if (axis != 1) p[axis] = static_cast<int32_t>(floorDiv(p[axis], cell) * cell);
        }
        points.push_back(p);
      }
      const auto world = worldOf(text), without = worldOf(replaced(text, kLake, ""));
      const auto dry = without->compile(box, 0), wet = world->compile(box, 0);
      REQUIRE(dry);
      REQUIRE(wet);
      const std::vector<bool> before = solidAt(**dry, points), after = solidAt(**wet, points);
      size_t leaks = 0, spills = 0;
      for (size_t i = 0; i < points.size(); ++i) {
        const bool below = points[i].y < surface;
        leaks += below && !after[i];
        spills += !below && after[i] != before[i];
        filled += below && !before[i];
        open += !below && !before[i];
      }
      CHECK(leaks == 0);
      CHECK(spills == 0);
    }
    CHECK(filled > 100);
    CHECK(open > 100);
  }
}

TEST_CASE("flowstone lies on floors, and is as high as it says", "[std][costly]") {
  const unsigned seed = testSeed();
  CAPTURE(seed);
  std::mt19937 random(seed);
  size_t mounds = 0;
  for (unsigned round = 0; round < 40 && (round < rounds(3) || mounds <= 20); ++round) {
    const WorldField world(settingsOf(yardstick("lake.sgm"), 512, random()), std::pmr::get_default_resource());
    const int32_t far = static_cast<int32_t>(random() % 2000) * 1024;
    const IntBox box{{far, -30 * 1024, -far}, {far + 128 * 1024, 30 * 1024, -far + 128 * 1024}};
    const auto found = world.instances(ruleNamed(*world.settings().program, "Flowstone"), box, 100'000);
    REQUIRE(found);
    mounds += found->size();
    IntBox around = box;
    for (int axis = 0; axis < 3; ++axis) around.lo[axis] -= 4096, around.hi[axis] += 4096;
    const auto rock = world.compileBelow(0, around), all = world.compileBelow(1, around);
    REQUIRE(rock);
    REQUIRE(all);
    std::vector<Int3> floor, above, inside;
    for (const RuleInstance& mound : *found) {
      const Int3 p = mound.origin;
      floor.push_back(p);
      above.push_back({p.x, p.y + 1, p.z});
      // 300 units are 0.29 m: inside the mound. Even the smallest mounds (r = 1 m in lake.sgm) are about 0.5 m high.
      inside.push_back({p.x, p.y + 300, p.z});
    }
    const auto isSolid = [](bool solid) { return solid; };
    const std::vector<bool> on_rock = solidAt(**rock, floor), in_void = solidAt(**rock, above),
                            filled = solidAt(**all, inside);
    CHECK(std::all_of(on_rock.begin(), on_rock.end(), isSolid));
    CHECK(std::none_of(in_void.begin(), in_void.end(), isSolid));
    CHECK(std::all_of(filled.begin(), filled.end(), isSolid));
  }
  CHECK(mounds > 20);
}

TEST_CASE("what stands in the cave with a lake has rock under it that does not fall away", "[std][costly]") {
  const unsigned seed = testSeed();
  CAPTURE(seed);
  std::mt19937 random(seed);
  const WorldField world(settingsOf(yardstick("lake.sgm"), 512, random()), std::pmr::get_default_resource());
  const IntBox box{{0, -30 * 1024, 0}, {256 * 1024, 30 * 1024, 256 * 1024}};
  const auto rock = world.compileBelow(0, box.grown(8 * 1024));
  REQUIRE(rock);
  // Checks that there is rock `below` units under a use of the rule. radius: two units less than the radius that the
  // rule's query requires, because positions are rounded.
  const auto bears = [&](const char* rule, int32_t below, int32_t radius) {
    const auto found = world.instances(ruleNamed(*world.settings().program, rule), box, 100'000);
    REQUIRE(found);
    std::vector<Int3> points;
    std::uniform_int_distribution<int32_t> by(-radius, radius);
    for (const RuleInstance& stands : *found) {
      for (int k = 0; k < 60; ++k) {
        const int32_t x = by(random), y = by(random), z = by(random);
        if (x * x + y * y + z * z <= radius * radius) points.push_back(saturatingAdd(stands.origin, {x, y - below, z}));
      }
    }
    const std::vector<bool> solid = solidAt(**rock, points);
    INFO(rule);
    CHECK(found->size() > 5);
    CHECK(std::all_of(solid.begin(), solid.end(), [](bool s) { return s; }));
  };
  bears("Flowstone", 1024, 819 - 2);
  bears("Stalagmite", 512, 409 - 2);
}
