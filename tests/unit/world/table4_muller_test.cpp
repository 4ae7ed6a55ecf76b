// Tests the claims of the row Mueller in the paper's Table 4, with the sample that represents it: splits, repeats and
// parts of boxes, with rules that see their scope, and solids that are cut. The sample's own `expect` statements test
// that it is closed and connected.

#include <algorithm>
#include <cmath>
#include <random>
#include <set>

#include "field/evaluate.h"
#include "rounds.h"
#include "seed.h"
#include "world_support.h"

using namespace sgm;

namespace {

constexpr double kFloor = 3.2, kGround = 5, kTop = 1.6, kBlind = 0.8;

struct Plan {
  double floors = 8, wide = 20, deep = 14, bay = 2.6, balconies = 0.3;
  double height() const { return kGround + kFloor * floors + kTop; }
  /// The number of repeats that fits best, rounded to the nearest whole number.
  int bays(double width) const { return static_cast<int>(std::floor((width - 2 * kBlind) / bay + 0.5)); }
};

WorldField worldOf(const Plan& plan, uint64_t seed) {
  WorldFieldSettings settings = settingsOf(sample("table4/muller.sgm"), 128, seed);
  for (const auto& [name, value] : {std::pair{"floors", plan.floors},
                                    {"wide", plan.wide},
                                    {"deep", plan.deep},
                                    {"bay", plan.bay},
                                    {"balconies", plan.balconies}})
    REQUIRE(settings.parameters.set(*settings.program, name, value));
  return {std::move(settings), std::pmr::get_default_resource()};
}

constexpr IntBox kAll{{-40 * 1024, -80 * 1024, -40 * 1024}, {40 * 1024, 80 * 1024, 40 * 1024}};

std::pmr::vector<RuleInstance> usesOf(const WorldField& world, const char* rule) {
  auto found = world.instances(ruleNamed(*world.settings().program, rule), kAll, 100'000);
  REQUIRE(found);
  std::pmr::vector<RuleInstance> uses;
  for (RuleInstance& one : *found) uses.push_back(std::move(one));
  return uses;
}

bool solidAt(const WorldField& world, double x, double y, double z) {
  const auto units = [](double metres) { return static_cast<int32_t>(std::lround(metres * kUnitsPerMetre)); };
  const Int3 p{units(x), units(y), units(z)};
  const auto program = world.compile({p, p}, 0);
  REQUIRE(program);
  int32_t q = 0;
  EvalScratch scratch;
  scalarKernels().samples((*program)->view(), {&p.x, &p.y, &p.z, 1}, scratch, &q);
  return q < 0;
}

}  // namespace

TEST_CASE("Mueller: a tower of any size has the floors and bays that its rules give it", "[table4]") {
  const unsigned seed = testSeed();
  CAPTURE(seed);
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(0, 1);
  for (unsigned round = 0; round < rounds(6); ++round) {
    Plan plan{2 + std::floor(14 * unit(random)), 10 + 20 * unit(random), 10 + 20 * unit(random), 2 + 2 * unit(random),
              unit(random)};
    CAPTURE(plan.floors, plan.wide, plan.deep, plan.bay, plan.balconies);
    const WorldField world = worldOf(plan, random());
    const int front = plan.bays(plan.wide), side = plan.bays(plan.deep);
    const size_t floors = static_cast<size_t>(plan.floors), bays = static_cast<size_t>(2 * (front + side));
    CHECK(usesOf(world, "Floor").size() == floors);
    CHECK(usesOf(world, "Facade").size() == 4 * floors);
    CHECK(usesOf(world, "Window").size() == floors * bays);
    CHECK(usesOf(world, "Balcony").size() + usesOf(world, "Sill").size() == floors * bays);
    CHECK(usesOf(world, "Pillar").size() == 4 * (floors + 1));
    // Windows are cut into the walls down to their glass, and the wall between them is solid. Checks each bay of each
    // floor and side.
    const double bottom = -0.5 * plan.height();
    size_t blind = 0, open = 0, glazed = 0, all = 0;
    for (size_t floor = 0; floor < floors; ++floor) {
      const double y = bottom + kGround + kFloor * (static_cast<double>(floor) + 0.5) + 0.15;
      for (int face = 0; face < 4; ++face) {
        const bool along_x = face % 2 == 0;
        const double width = along_x ? plan.wide : plan.deep, out = 0.5 * (along_x ? plan.deep : plan.wide);
        const int count = along_x ? front : side;
        const double one = (width - 2 * kBlind) / count, sign = face < 2 ? 1 : -1;
        const auto solid = [&](double along, double depth) {
          const double a = -0.5 * width + along, d = sign * (out + depth);
          return along_x ? solidAt(world, a, y, d) : solidAt(world, d, y, a);
        };
        for (int i = 0; i < count; ++i) {
          ++all;
          const double light = kBlind + (i + 0.36) * one;  // this place is beside the middle bar of the window frame
          open += !solid(light, -0.05);
          glazed += solid(light, -0.33);
          blind += solid(kBlind + (i + 0.95) * one, -0.05);
        }
      }
    }
    CHECK(all == floors * bays);
    CHECK(open == all);
    CHECK(glazed == all);
    CHECK(blind == all);
  }
}

TEST_CASE("Mueller: one bay is changed by its path", "[table4]") {
  const Plan plan;
  WorldFieldSettings settings =
      settingsOf(sample("table4/muller.sgm") + "override \"Lot/Tower/Floor[2]/Facade[0]/Bay[3]\" { Balcony; }\n", 128);
  REQUIRE(settings.parameters.set(*settings.program, "balconies", 0));
  const WorldField world{std::move(settings), std::pmr::get_default_resource()};
  const auto balconies = usesOf(world, "Balcony");
  REQUIRE(balconies.size() == 1);
  // The first facade is the front; its bays are counted from the left.
  const double bay = (plan.wide - 2 * kBlind) / plan.bays(plan.wide);
  const Int3 at = balconies[0].origin;
  CHECK(metres(at.x) == Approx(-0.5 * plan.wide + kBlind + 3.5 * bay).margin(0.002));
  CHECK(metres(at.y) == Approx(-0.5 * plan.height() + kGround + 2.5 * kFloor).margin(0.002));
  CHECK(metres(at.z) == Approx(0.5 * plan.deep).margin(0.002));
}

TEST_CASE("Mueller: balconies stand where they are drawn, and only there", "[table4]") {
  const unsigned seed = testSeed();
  CAPTURE(seed);
  Plan plan;
  plan.floors = 15;  // many windows, so that shares stay within the bounds below (six standard deviations)
  plan.balconies = 0;
  CHECK(usesOf(worldOf(plan, seed), "Balcony").empty());
  plan.balconies = 1;
  const size_t all = usesOf(worldOf(plan, seed), "Balcony").size();
  CHECK(all == static_cast<size_t>(plan.floors) * 2 * static_cast<size_t>(plan.bays(plan.wide) + plan.bays(plan.deep)));
  plan.balconies = 0.3;
  const WorldField world = worldOf(plan, seed);
  const auto some = usesOf(world, "Balcony");
  CHECK(static_cast<double>(some.size()) > 0.15 * static_cast<double>(all));
  CHECK(static_cast<double>(some.size()) < 0.45 * static_cast<double>(all));
  // The floors of balconies extend 1.2 m from the walls, on all four sides.
  std::set<int> sides;
  for (const RuleInstance& one : some) {
    const double x = metres(one.origin.x), z = metres(one.origin.z);
    const bool front = std::fabs(std::fabs(z) - 0.5 * plan.deep) < 0.01;
    const double out = front ? (z > 0 ? 1 : -1) : (x > 0 ? 1 : -1);
    sides.insert((front ? 0 : 2) + (out > 0));
    const double y = metres(one.origin.y) - 0.5 * kFloor + 0.02;
    CHECK(solidAt(world, x + (front ? 0 : 0.9 * out), y, z + (front ? 0.9 * out : 0)));
    CHECK(!solidAt(world, x + (front ? 0 : 1.6 * out), y, z + (front ? 1.6 * out : 0)));
  }
  CHECK(sides.size() == 4);
}

TEST_CASE("Mueller: windows open where no neighbour stands, and nowhere else", "[table4]") {
  const unsigned seed = testSeed();
  CAPTURE(seed);
  std::mt19937 random(seed);
  size_t open = 0, walled = 0;
  // Several terraces are tested, because one alone may have too few open or blocked windows.
  for (unsigned round = 0; round < std::max(rounds(4), 4u); ++round) {
    const WorldField world{settingsOf(sample("terrace.sgm"), 128, random()), std::pmr::get_default_resource()};
    for (const RuleInstance& light : usesOf(world, "Light")) {
      const double x = metres(light.origin.x), y = metres(light.origin.y), z = metres(light.origin.z);
      CAPTURE(round, light.path, x, y, z);
      // Tall houses are in the right half of a cell. A window's glass lies 18 cm behind the wall's face.
      const double side = x - 24 * std::floor(x / 24) < 18 ? -1 : 1;
      const bool opens = !solidAt(world, x - 0.1 * side, y, z);
      const bool beside = solidAt(world, x + 0.3 * side, y, z);
      CHECK(!(opens && beside));
      // A house that blocks a window is at most 1.1 m in front of it.
      bool near = opens || beside;
      for (int i = 0; i < 6 * 13 * 13 && !near; ++i)
        near = solidAt(world, x + 0.2 * side * (i % 6 + 0.1), y + 0.18 * (i / 6 % 13 - 6), z + 0.18 * (i / 78 - 6));
      CHECK(near);
      ++(opens ? open : walled);
    }
  }
  CHECK(open > 20);
  CHECK(walled > 20);
}

TEST_CASE("Mueller: solids that fill the parts of a scope are one body, where samples lie in their faces as well",
          "[table4]") {
  const unsigned seed = testSeed();
  CAPTURE(seed);
  std::mt19937 random(seed);
  const WorldField world{settingsOf("sgm 1; start Lot; rule Lot { size(8m, 4m, 4m) split x { 3m: Half; ~1m: Half; } }\n"
                                    "rule Half { split y { 1m: Block; 1m: Block; 2m: Thirds; } }\n"
                                    "rule Thirds { split z { { ~1.3m: Block; }* } } rule Block { box(scope); }\n",
                                    128),
                         std::pmr::get_default_resource()};
  std::uniform_real_distribution<double> unit(-1, 1);
  for (unsigned round = 0; round < rounds(200); ++round) {
    const double x = 3.99 * unit(random), y = 1.99 * unit(random), z = 1.99 * unit(random);
    CAPTURE(x, y, z);
    CHECK(solidAt(world, -1, y, z));
    CHECK(solidAt(world, x, -1, z));
    CHECK(solidAt(world, x, 0, z));
    CHECK(solidAt(world, x, 1, -2.0 / 3));
  }
  CHECK(solidAt(world, -1, 0, 0));
  CHECK(!solidAt(world, 4.01, 0, 0));
  CHECK(!solidAt(world, 0, 2.01, 0));
}
