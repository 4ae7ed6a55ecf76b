// What the row Marson of the paper's Table 4 claims, of the sample that stands for it: labelled rooms of given areas,
// each of which one can walk into. What is reached is asked of the field itself; of the plan: test_treemap.cpp.

#include <cmath>
#include <random>
#include <set>

#include "field/evaluate.h"
#include "rounds.h"
#include "world_support.h"

using namespace sgm;

namespace {

/// Samples in a grid of an eighth of a metre over a house, floor to ceiling.
struct Grid {
  static constexpr int32_t kStep = 128, kX = 170, kY = 15, kZ = 130;
  Int3 low{-kX * kStep / 2 + 13, -1400, -kZ* kStep / 2 + 21};
  std::vector<bool> solid;

  explicit Grid(const WorldField& world) : solid(size_t{kX} * kY * kZ) {
    const Int3 high{low.x + kX * kStep, low.y + kY * kStep, low.z + kZ * kStep};
    const auto program = world.compile({low, high}, 0);
    REQUIRE(program);
    EvalScratch scratch;
    std::vector<int32_t> x, y, z, q(solid.size());
    for (int32_t i = 0; i < static_cast<int32_t>(solid.size()); ++i) {
      const Int3 p = at(i);
      x.push_back(p.x);
      y.push_back(p.y);
      z.push_back(p.z);
    }
    scalarKernels().samples((*program)->view(), {x.data(), y.data(), z.data(), x.size()}, scratch, q.data());
    for (size_t i = 0; i < q.size(); ++i) solid[i] = q[i] < 0;
  }
  Int3 at(int32_t i) const {
    return {low.x + i % kX * kStep, low.y + i / kX % kY * kStep, low.z + i / (kX * kY) * kStep};
  }
  int32_t nearest(Int3 p) const {
    const auto cell = [](int32_t v, int32_t from) { return (v - from + kStep / 2) / kStep; };
    return cell(p.x, low.x) + kX * (cell(p.y, low.y) + kY * cell(p.z, low.z));
  }
  /// What can be reached from a corner outside, below the roof.
  std::vector<bool> walked() const {
    std::vector<bool> seen(solid.size(), false);
    std::vector<int32_t> open{0};
    while (!open.empty()) {
      const int32_t i = open.back();
      open.pop_back();
      if (seen[static_cast<size_t>(i)] || solid[static_cast<size_t>(i)]) continue;
      seen[static_cast<size_t>(i)] = true;
      const int32_t x = i % kX, y = i / kX % kY, z = i / (kX * kY);
      if (x > 0) open.push_back(i - 1);
      if (x + 1 < kX) open.push_back(i + 1);
      if (y > 0) open.push_back(i - kX);
      if (y + 1 < kY) open.push_back(i + kX);
      if (z > 0) open.push_back(i - kX * kY);
      if (z + 1 < kZ) open.push_back(i + kX * kY);
    }
    return seen;
  }
};

constexpr IntBox kHouse{{-40 * 1024, -40 * 1024, -40 * 1024}, {40 * 1024, 40 * 1024, 40 * 1024}};

}  // namespace

TEST_CASE("Marson: every room of a house can be walked into from outside", "[table4]") {
  const unsigned seed = std::random_device()();
  CAPTURE(seed);
  std::mt19937 random(seed);
  // Without its windows, through which one could climb.
  const std::string blind = replaced(sample("table4/marson.sgm"), "facade: Windows;", "facade: { }");
  for (unsigned round = 0; round < rounds(8); ++round) {
    const WorldFieldSettings settings = settingsOf(blind, 128, random());
    const WorldField world{settings, std::pmr::get_default_resource()};
    const auto found = world.anchors(kHouse);
    REQUIRE(found);
    const std::vector<Anchor>& rooms = *found;
    const auto notes = world.notes(kHouse, 128);
    REQUIRE(notes);
    CHECK(notes->empty());
    std::set<uint16_t> names;
    for (const Anchor& anchor : rooms) names.insert(anchor.name);
    REQUIRE(names.size() >= 7);  // and the corridor, where there is one
    const Grid grid{world};
    const std::vector<bool> walked = grid.walked();
    for (const Anchor& anchor : rooms) {
      CAPTURE(round, settings.seed, std::string_view(settings.program->names[anchor.name]));
      // Half the height of the room: nothing that stands in it is so high.
      CHECK(walked[static_cast<size_t>(grid.nearest(anchor.frame.origin))]);
    }
    // Shut the doors, and no room can be reached.
    const WorldFieldSettings shut = settingsOf(replaced(blind, "height 2.1m", "height 10cm"), 128, settings.seed);
    const std::vector<bool> outside = Grid{WorldField{shut, std::pmr::get_default_resource()}}.walked();
    for (const Anchor& anchor : rooms) CHECK(!outside[static_cast<size_t>(grid.nearest(anchor.frame.origin))]);
  }
}
