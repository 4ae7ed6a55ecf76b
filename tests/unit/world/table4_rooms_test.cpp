// Tests rooms of random floors in the field itself: a walker of the size of a person can go from outside into each
// room.

#include <algorithm>
#include <random>
#include <set>
#include <string>

#include "rounds.h"
#include "seed.h"
#include "walked_void.h"
#include "world_support.h"

using namespace sgm;

namespace {

/// A random floor plan below a ceiling, so that only its doors lead in.
std::string drawnFloor(std::mt19937& random, double x, double z, const std::string& doors) {
  std::uniform_real_distribution<double> unit(0, 1);
  const auto metresIn = [&](double low, double high) {
    return std::to_string(low + (high - low) * unit(random)) + "m";
  };
  const size_t rooms = 1 + random() % 9;
  std::string text = "sgm 1; start House;\nrule House { size(" + std::to_string(x) + "m, 3m, " + std::to_string(z) +
                     "m) {\nbox(scope); cut treemap(wall " + metresIn(0.15, 0.35) + ", door " + metresIn(0.8, 1.1) +
                     ", corridor " + metresIn(0.9, 1.6) + doors + ") {\n";
  for (size_t i = 0; i < rooms; ++i) {
    const std::string name = "room" + std::to_string(i);
    text += name + " " + std::to_string(6 + 34 * unit(random)) + ": anchor room \"" + name + "\";\n";
  }
  std::set<std::pair<size_t, size_t>> linked;
  for (size_t i = 0; i < random() % 3 && rooms > 1; ++i) {
    const size_t a = random() % rooms, b = (a + 1 + random() % (rooms - 1)) % rooms;
    if (linked.insert(std::minmax(a, b)).second)
      text += "link room" + std::to_string(a) + " room" + std::to_string(b) + " by door;\n";
  }
  return text + "corridor: anchor room \"corridor\";\n}\nat(y = -1.6m) size(y 0.4m) box(scope);\n" +
         "at(y 1.6m) size(y 0.4m) box(scope);\n} }\n";
}

constexpr IntBox kHome{{-16 * 1024, -4 * 1024, -16 * 1024}, {16 * 1024, 4 * 1024, 16 * 1024}};

/// Walks through the floor, sampled at 8 samples per metre; the walker is 0.5 m wide and deep, and 1.5 m high.
WalkedVoid walkedIn(const WorldField& world, double x, double z) {
  const auto samples = [](double metres) { return static_cast<int32_t>(metres * 8) + 16; };
  const Int3 size{samples(x), 30, samples(z)};
  return {world, {-size.x * 64 + 13, -1900, -size.z * 64 + 21}, size, 128, {5, 12, 5}};
}

}  // namespace

TEST_CASE("rooms: a person walks from outside into every room of a random floor, and only by doors", "[table4]") {
  const unsigned seed = testSeed();
  CAPTURE(seed);
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(0, 1);
  size_t walked = 0, all = 0, corridors = 0, narrow = 0, floors = 0;
  // Not every floor has a corridor, so rounds continue until one floor had a corridor.
  for (unsigned round = 0; round < rounds(30) || (corridors == 0 && round < 60); ++round) {
    const double x = 8 + 10 * unit(random), z = 8 + 8 * unit(random);
    const auto drawn = random();
    std::mt19937 open(drawn), shut(drawn);
    const std::string text = drawnFloor(open, x, z, "");
    CAPTURE(round, text);
    const WorldField world{settingsOf(text, 128), std::pmr::get_default_resource()};
    const auto notes = world.notes(kHome, 128);
    REQUIRE(notes);
    std::string told;
    for (const auto& note : *notes) told += std::string(note.message) + "\n";
    CAPTURE(told);
    const auto rooms = world.anchors(kHome);
    REQUIRE(rooms);
    const WalkedVoid inside = walkedIn(world, x, z);
    ++floors;
    // A floor may have a room narrower than the walker; then the rooms behind it cannot be reached either.
    if (!std::ranges::all_of(*rooms, [&](const Anchor& room) { return inside.fits(room.frame.origin); })) {
      ++narrow;
      continue;
    }
    const WorldField closed{settingsOf(drawnFloor(shut, x, z, ", height 1m"), 128), std::pmr::get_default_resource()};
    const WalkedVoid outside = walkedIn(closed, x, z);
    for (const Anchor& room : *rooms) {
      const std::string name(world.settings().program->names[room.name]);
      CAPTURE(name, room.frame.origin.x, room.frame.origin.z);
      CHECK(inside.reaches(room.frame.origin) == (told.find("no wall of `" + name + "`") == std::string::npos));
      CHECK(!outside.reaches(room.frame.origin));
      walked += inside.reaches(room.frame.origin);
      ++all;
      corridors += name == "corridor";
    }
  }
  CHECK(2 * walked > all);
  CHECK(2 * narrow < floors + 4);
  CHECK(corridors > 0);
}
