// What the row Marson of the paper's Table 4 claims, of the sample that stands for it: labelled rooms of given areas,
// each of which one can walk into. What is reached is asked of the field itself; of the plan: test_treemap.cpp.

#include <cmath>
#include <random>
#include <set>

#include "rounds.h"
#include "seed.h"
#include "walked_void.h"
#include "world_support.h"

using namespace sgm;

namespace {

/// Samples in a grid of an eighth of a metre over a house, floor to ceiling; a walker half a metre wide, over what
/// stands there.
WalkedVoid walkedHouse(const WorldField& world) {
  constexpr int32_t kStep = 128;
  constexpr Int3 kSize{170, 15, 130};
  return {world, {-kSize.x * kStep / 2 + 13, -1400, -kSize.z * kStep / 2 + 21}, kSize, kStep, {5, 4, 5}};
}

constexpr IntBox kHouse{{-40 * 1024, -40 * 1024, -40 * 1024}, {40 * 1024, 40 * 1024, 40 * 1024}};

}  // namespace

TEST_CASE("Marson: every room of a house can be walked into from outside", "[table4]") {
  const unsigned seed = testSeed();
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
    // A link of rooms that do not meet in this house is told, and nothing else.
    for (const auto& note : *notes) CHECK(note.message.find("share no wall wide enough") != std::string::npos);
    std::set<uint16_t> names;
    for (const Anchor& anchor : rooms) names.insert(anchor.name);
    REQUIRE(names.size() >= 7);  // and the corridor, where there is one
    const WalkedVoid walked = walkedHouse(world);
    for (const Anchor& anchor : rooms) {
      CAPTURE(round, settings.seed, std::string_view(settings.program->names[anchor.name]));
      // Half the height of the room: nothing that stands in it is so high.
      CHECK(walked.reaches(anchor.frame.origin));
    }
    // Shut the doors, and no room can be reached.
    const WorldFieldSettings shut = settingsOf(replaced(blind, "height 2.1m", "height 10cm"), 128, settings.seed);
    const WalkedVoid outside = walkedHouse(WorldField{shut, std::pmr::get_default_resource()});
    for (const Anchor& anchor : rooms) CHECK(!outside.reaches(anchor.frame.origin));
  }
}
