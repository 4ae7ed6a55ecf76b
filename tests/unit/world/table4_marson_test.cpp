// Tests the claims of the row Marson in the paper's Table 4, with the sample that represents it: labelled rooms with
// given areas, each of which can be entered. Walking is tested in the field itself; the floor plan in test_treemap.cpp.

#include <cmath>
#include <random>
#include <set>

#include "rounds.h"
#include "seed.h"
#include "walked_void.h"
#include "world_support.h"

using namespace sgm;

namespace {

/// Walks through a house, sampled on a grid of 1/8 m from floor to ceiling, with a walker 0.5 m wide, above low
/// objects.
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
  // The house without windows, through which a walker could climb.
  const std::string blind = replaced(sample("table4/marson.sgm"), "facade: Windows;", "facade: { }");
  for (unsigned round = 0; round < rounds(8); ++round) {
    const WorldFieldSettings settings = settingsOf(blind, 128, random());
    const WorldField world{settings, std::pmr::get_default_resource()};
    const auto found = world.anchors(kHouse);
    REQUIRE(found);
    const std::vector<Anchor>& rooms = *found;
    const auto notes = world.notes(kHouse, 128);
    REQUIRE(notes);
    // The only notes are about links between rooms that do not touch each other in this house.
    for (const auto& note : *notes) CHECK(note.message.find("share no wall wide enough") != std::string::npos);
    std::set<uint16_t> names;
    for (const Anchor& anchor : rooms) names.insert(anchor.name);
    REQUIRE(names.size() >= 7);  // the rooms, and the corridor if there is one
    const WalkedVoid walked = walkedHouse(world);
    for (const Anchor& anchor : rooms) {
      CAPTURE(round, settings.seed, std::string_view(settings.program->names[anchor.name]));
      // The anchor is at half the height of the room, above all furniture.
      CHECK(walked.reaches(anchor.frame.origin));
    }
    // If doors are too low for a walker, no room can be reached.
    const WorldFieldSettings shut = settingsOf(replaced(blind, "height 2.1m", "height 10cm"), 128, settings.seed);
    const WalkedVoid outside = walkedHouse(WorldField{shut, std::pmr::get_default_resource()});
    for (const Anchor& anchor : rooms) CHECK(!outside.reaches(anchor.frame.origin));
  }
}
