// Tests the choice of sun or lamp, in worlds for which a photographer's choice is evident.

#include "tools/flight/daylight.h"

#include <algorithm>
#include <cmath>
#include <random>

#include "catch.h"

using namespace sgm;
using cli::CameraPlace;
using cli::LitWorld;
using cli::Metres3;
using cli::Outlook;
using cli::RayEnd;

namespace {

struct Box {
  Metres3 low, high;
  uint32_t material = 0;
};

/// The place at which a ray enters the box; nullopt if it misses the box.
std::optional<RayEnd> entry(const Box& box, const Metres3& from, const Metres3& direction, double metres) {
  double enter = 0, leave = metres;
  int side = -1;
  for (int axis = 0; axis < 3; ++axis) {
    if (direction[axis] == 0) {
      if (from[axis] < box.low[axis] || from[axis] > box.high[axis]) return {};
      continue;
    }
    double a = (box.low[axis] - from[axis]) / direction[axis], b = (box.high[axis] - from[axis]) / direction[axis];
    if (a > b) std::swap(a, b);
    if (a > enter) {
      enter = a;
      side = axis;
    }
    leave = std::min(leave, b);
  }
  if (enter > leave) return {};
  RayEnd end{enter, Metres3(0), box.material, side < 0};
  if (side >= 0) end.normal[side] = direction[side] > 0 ? -1 : 1;
  return end;
}

LitWorld worldOf(std::vector<Box> boxes) {
  LitWorld world = LitWorld::of(false, false);
  world.translucent = {false, true};
  world.cast = [boxes](const Metres3& from, const Metres3& direction, double metres) -> Result<std::optional<RayEnd>> {
    std::optional<RayEnd> nearest;
    for (const Box& box : boxes) {
      const std::optional<RayEnd> end = entry(box, from, direction, metres);
      if (end && (!nearest || end->distance < nearest->distance)) nearest = end;
    }
    return nearest;
  };
  return world;
}

Outlook look(const LitWorld& world, const Metres3& position, const Metres3& direction) {
  CameraPlace camera;
  camera.position = position;
  camera.direction = direction;
  const Result<Outlook> outlook = lookOut(world, camera);
  REQUIRE(outlook);
  return *outlook;
}

const Box kGround{{-500, -1, -500}, {500, 0, 500}};

/// A room with inner dimensions of 2 x, h and 2 z metres; its walls, floor and ceiling are boxes with a thickness of
/// one metre.
std::vector<Box> room(double x, double h, double z, uint32_t ceiling = 0) {
  return {{{-x - 1, -1, -z - 1}, {x + 1, 0, z + 1}},  {{-x - 1, h, -z - 1}, {x + 1, h + 1, z + 1}, ceiling},
          {{-x - 1, -1, -z - 1}, {-x, h + 1, z + 1}}, {{x, -1, -z - 1}, {x + 1, h + 1, z + 1}},
          {{-x - 1, -1, -z - 1}, {x + 1, h + 1, -z}}, {{-x - 1, -1, z}, {x + 1, h + 1, z + 1}}};
}

}  // namespace

TEST_CASE("streets have daylight and closed rooms have none, whatever their size and the way one looks") {
  std::mt19937 random(20261127);
  const auto between = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  for (int round = 0; round < 200; ++round) {
    const double wide = between(3, 30), high = wide * between(0.3, 3.5), turn = between(0, 6.28),
                 tilt = between(-0.6, 0.6);
    const Metres3 way{std::cos(turn), tilt, std::sin(turn)};
    INFO("round " << round << ": " << wide << " m wide, " << high << " m high, turned by " << turn << ", " << tilt);
    const LitWorld street =
        worldOf({kGround, {{-500, 0, -500}, {-wide / 2, high, 500}}, {{wide / 2, 0, -500}, {500, high, 500}}});
    CHECK(cli::lightAt(look(street, {between(-0.4, 0.4) * wide, 1.7, 0}, way).daylight) == Light::sun);
    const LitWorld closed = worldOf(room(wide, high + 2, between(3, 100)));
    const Outlook inside = look(closed, {0, 1.7, 0}, way);
    CHECK(inside.daylight == 0);
    CHECK(inside.depth < 150);
  }
}

TEST_CASE("light comes through glass, windows and the mouth of a cave, and not to the end of a tunnel") {
  CHECK(look(worldOf(room(8, 4, 8, 1)), {0, 1.7, 0}, {1, 0, 0}).daylight > 0.5);

  // A tunnel in a hill, open at one end: sunlight near its mouth, a lamp deep inside, looking inwards or outwards.
  std::vector<Box> tunnel{kGround,
                          {{-50, 4, 0}, {50, 50, 400}},
                          {{-50, 0, 0}, {-2, 50, 400}},
                          {{2, 0, 0}, {50, 50, 400}},
                          {{-50, 0, 390}, {50, 50, 400}}};
  const LitWorld hill = worldOf(tunnel);
  CHECK(cli::lightAt(look(hill, {0, 1.7, -20}, {0, 0, 1}).daylight) == Light::sun);
  CHECK(cli::lightAt(look(hill, {0, 1.7, 4}, {0, 0, -1}).daylight) == Light::sun);
  CHECK(cli::lightAt(look(hill, {0, 1.7, 60}, {0, 0, 1}).daylight) == Light::lamp);
  CHECK(cli::lightAt(look(hill, {0, 1.7, 200}, {0, 0, -1}).daylight) == Light::lamp);
}

TEST_CASE("rock without an end has no sky, however far a ray goes") {
  const auto nothing = [](const Metres3&, const Metres3&, double) -> Result<std::optional<RayEnd>> {
    return std::optional<RayEnd>();
  };
  for (const bool solid : {false, true}) {
    for (const bool endless : {false, true}) {
      LitWorld world = LitWorld::of(solid, endless);
      world.cast = nothing;
      CHECK((look(world, {0, 0, 0}, {1, 0, 0}).daylight == 0) == (solid && endless));
    }
  }
  // In an endless void world of stacked islands, a shorter distance suffices for a ray to count as reaching the sky.
  CHECK(LitWorld::of(false, true).sky_metres < LitWorld::of(false, false).sky_metres);
  LitWorld broken = LitWorld::of(false, false);
  broken.cast = [](const Metres3&, const Metres3&, double) -> Result<std::optional<RayEnd>> {
    return Error{Code::limit, "too far"};
  };
  CHECK(!lookOut(broken, {}));
  CHECK(look(worldOf({kGround}), {0, -0.5, 0}, {1, 0, 0}).buried);
  CHECK(!look(worldOf({kGround}), {0, 0.5, 0}, {1, 0, 0}).buried);
}

TEST_CASE("the light of a flight does not flicker") {
  cli::SteadyLight light;
  const double enough = cli::kEnoughDaylight;
  CHECK(light.next(2 * enough, false) == Light::sun);
  // Values around the threshold do not change the light, and neither does a single value far from it.
  for (int i = 0; i < 20; ++i) CHECK(light.next(enough * (i % 2 == 0 ? 0.7 : 1.3), false) == Light::sun);
  CHECK(light.next(0, false) == Light::sun);
  CHECK(light.next(enough, false) == Light::sun);
  CHECK(light.next(0, false) == Light::sun);
  CHECK(light.next(0, false) == Light::lamp);
  for (int i = 0; i < 20; ++i) CHECK(light.next(enough * (i % 2 == 0 ? 0.7 : 1.3), false) == Light::lamp);
  CHECK(light.next(1, false) == Light::lamp);
  CHECK(light.next(1, false) == Light::sun);
  // After a teleport, only what the camera sees at the new place counts.
  CHECK(light.next(0, true) == Light::lamp);
  CHECK(light.next(enough, true) == Light::sun);

  for (const Light each : {Light::sun, Light::lamp, Light::none}) CHECK(cli::lightNamed(cli::lightName(each)) == each);
  CHECK(!cli::lightNamed("auto"));
  CHECK(cli::isTranslucent("glass"));
  CHECK(cli::isTranslucent("glass_yellow"));
  CHECK(cli::isTranslucent("cloud"));
  CHECK(!cli::isTranslucent("limestone"));
  CHECK(!cli::isTranslucent(""));
}
