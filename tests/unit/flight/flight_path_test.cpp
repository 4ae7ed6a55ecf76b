// Tests that planned flights stay in the void, never end, and are reproducible.

#include "tools/flight/flight_path.h"

#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>
#include <set>

#include "drawn_world.h"
#include "fixture.h"
#include "rounds.h"
#include "world/world_support.h"

using namespace sgm;
using cli::AutoFlight;
using cli::FlightPath;
using cli::FlightPlace;
using cli::Metres3;
using cli::PathPoints;

namespace {

struct FlownWorld {
  RuntimeOwner runtime = makeRuntime();
  GrammarOwner grammar;
  FieldOwner field;

  FlownWorld(const std::string& text, int32_t cell)
      : grammar(compile(runtime.get(), text.c_str())), field(makeField(runtime.get(), grammar.get(), cell)) {}

  FlightPath fly(const AutoFlight& settings = {}) const {
    Result<FlightPath> path = FlightPath::automatic(field.get(), grammar.get(), settings);
    INFO((path ? "" : path.error().message));
    REQUIRE(path);
    return std::move(*path);
  }
};

FlightPlace placeAt(FlightPath& path, double s) {
  const Result<FlightPlace> place = path.at(s);
  INFO((place ? "" : place.error().message));
  REQUIRE(place);
  return *place;
}

Int3 unitsAt(const Metres3& p, int axis = 0, double by = 0) {
  Int3 units{static_cast<int32_t>(p[0] * 1024), static_cast<int32_t>(p[1] * 1024), static_cast<int32_t>(p[2] * 1024)};
  units[axis] += static_cast<int32_t>(by * 1024);
  return units;
}

/// Counts the faults of a flight: places with less than `room` metres of void along an axis, uneven steps, and
/// directions that do not point along the path.
struct Flown {
  size_t tight = 0, uneven = 0, astray = 0, turns = 0;
  std::set<std::array<int, 3>> regions;
};
Flown fly(const FlownWorld& world, FlightPath& path, double length, double step, double room, double region) {
  Flown flown;
  std::vector<Int3> points;
  FlightPlace last = placeAt(path, 0);
  for (double s = 0; s < length; s += step) {
    const FlightPlace here = placeAt(path, s);
    for (int axis = 0; axis < 3; ++axis)
      for (const double by : {-room, room}) points.push_back(unitsAt(here.position, axis, by));
    if (s > 0) {
      const Metres3 way = here.position - last.position;
      flown.uneven += glm::length(way) > 1.0001 * step;
      flown.turns += glm::length(way) < 0.8 * step;
      const Metres3 middle = 0.5 * (here.direction + last.direction);
      flown.astray += glm::dot(middle, way) < 0;
      CHECK(glm::length(here.direction) == Approx(1));
    }
    std::array<int, 3> in{};
    for (int axis = 0; axis < 3; ++axis)
      in[static_cast<size_t>(axis)] = static_cast<int>(std::floor(here.position[axis] / region));
    flown.regions.insert(in);
    last = here;
  }
  const Result<std::vector<bool>> solid = cli::solidAt(world.field.get(), points);
  REQUIRE(solid);
  for (const bool is_solid : *solid) flown.tight += is_solid;
  return flown;
}

std::string messageOf(const std::string& text) {
  const Result<PathPoints> path = cli::readPathPoints(text);
  REQUIRE_FALSE(path);
  CHECK(path.error().message.find('\n') == std::string::npos);
  return path.error().message;
}

}  // namespace

TEST_CASE("a flight through an endless cave keeps to the void and goes to new places") {
  const FlownWorld world(yardstick("cave.sgm"), 512);
  AutoFlight settings;
  settings.seed = 5;
  FlightPath path = world.fly(settings);
  CHECK_FALSE(path.length());
  const double length = 150.0 * rounds(2);
  const Flown flown = fly(world, path, length, 0.25, 0.4, 16);
  CHECK(flown.tight == 0);
  CHECK(flown.uneven == 0);
  CHECK(flown.astray == 0);
  CHECK(static_cast<double>(flown.turns) < 0.02 * length / 0.25);
  CHECK(static_cast<double>(flown.regions.size()) > length / 40);
}

TEST_CASE("the same seed makes the same flight, another seed another one") {
  const FlownWorld world(yardstick("cave.sgm"), 512), again(yardstick("cave.sgm"), 512);
  AutoFlight settings;
  settings.seed = 3;
  FlightPath first = world.fly(settings), second = again.fly(settings);
  settings.seed = 4;
  FlightPath other = world.fly(settings);
  // Places do not depend on the order of the calls.
  const FlightPlace far = placeAt(second, 100);
  double apart = 0;
  for (double s = 0; s < 100; s += 5) {
    CHECK(placeAt(first, s).position == placeAt(second, s).position);
    apart = std::max(apart, glm::length(placeAt(first, s).position - placeAt(other, s).position));
  }
  CHECK(placeAt(first, 100).position == far.position);
  CHECK(apart > 10);
}

TEST_CASE("teleports lead to far places in the void, each its own, from which the flight goes on") {
  const FlownWorld world(yardstick("cave.sgm"), 512);
  FlightPath path = world.fly(), again = world.fly();
  const Metres3 home = placeAt(path, 0).position;
  std::set<double> places;
  for (uint64_t n = 0; n < 2; ++n) {
    CAPTURE(n);
    REQUIRE(path.teleport(n));
    const Metres3 place = placeAt(path, 0).position;
    const double away = glm::length(place - home);
    CHECK(away >= 500);
    CHECK(away <= 5000);
    places.insert(away);
    const Flown flown = fly(world, path, 30, 0.5, 0.4, 16);
    CHECK(flown.tight == 0);
  }
  CHECK(places.size() == 2);
  REQUIRE(again.teleport(1));
  CHECK(placeAt(again, 0).position == placeAt(path, 0).position);
  CHECK(placeAt(again, 20).position == placeAt(path, 20).position);
}

TEST_CASE("a cave with an end is flown for ever") {
  const FlownWorld world(kClosedWorlds[1], 256);
  FlightPath path = world.fly();
  const Flown flown = fly(world, path, 250, 0.5, 0.4, 8);
  CHECK(flown.tight == 0);
  CHECK(flown.uneven == 0);
  CHECK(flown.regions.size() > 10);
  REQUIRE(path.teleport(1));
  CHECK(fly(world, path, 30, 0.5, 0.4, 8).tight == 0);
}

TEST_CASE("in an open world the flight winds between the solids") {
  struct Open {
    const char* grammar;
    int32_t cell;
    double length, room, region;
  };
  for (const Open& open : {Open{"cloud.sgm", 4096, 1500, 0.9, 200}, Open{"choice.sgm", 256, 150, 0.1, 8},
                           Open{"terrain.sgm", 512, 200, 0.1, 8}, Open{"arches.sgm", 256, 400, 0.1, 8},
                           Open{"tree.sgm", 256, 300, 0.1, 8}}) {
    CAPTURE(open.grammar);
    const FlownWorld world(sample(open.grammar), open.cell);
    FlightPath path = world.fly();
    const Flown flown = fly(world, path, open.length, 0.5, open.room, open.region);
    CHECK(flown.tight == 0);
    CHECK(flown.uneven == 0);
    CHECK(flown.regions.size() > 6);
  }
}

TEST_CASE("a narrow passage is flown where no other is") {
  const FlownWorld world(
      "sgm 1;\nunits m;\ndomain finite box(120m, 64m, 64m) solid limestone;\nstart A;\n"
      "rule A { cut { tube((-50m, 0m, 0m), (50m, 0m, 0m), 1.3m, bend 8m); } }\n",
      256);
  FlightPath path = world.fly();
  const Flown flown = fly(world, path, 150, 0.1, 0.05, 8);
  CHECK(flown.tight == 0);
  CHECK(flown.regions.size() > 8);
}

TEST_CASE("where there is no room to fly, that is said") {
  const FlownWorld world(
      "sgm 1;\nunits m;\ndomain finite box(64m, 64m, 64m) solid limestone;\nstart A;\n"
      "rule A { cut { sphere(2m); } }\n",
      256);
  const Result<FlightPath> path = FlightPath::automatic(world.field.get(), world.grammar.get(), {});
  REQUIRE_FALSE(path);
  CHECK(path.error().code == Code::limit);
  CHECK(path.error().message.find("void") != std::string::npos);
}

TEST_CASE("a path of points goes through them, evenly") {
  PathPoints points;
  points.points = {{0, 0, 0}, {10, 0, 0}, {10, 5, 12}, {-3, 5, 40}};
  for (const bool loop : {false, true}) {
    CAPTURE(loop);
    points.loop = loop;
    FlightPath path = FlightPath::through(points);
    CHECK(path.length().has_value() == !loop);
    double last = 0;
    for (const Metres3& point : points.points) {
      // The path passes each point, in the given order.
      double nearest = 1e9, at = 0;
      for (double s = last; s < last + 60; s += 0.05) {
        const double distance = glm::length(placeAt(path, s).position - point);
        if (distance < nearest) nearest = distance, at = s;
      }
      CHECK(nearest < 0.05);
      last = at;
    }
    for (double s = 0; s < 150; s += 0.1) {
      const double step = glm::length(placeAt(path, s + 0.1).position - placeAt(path, s).position);
      if (loop || s + 0.1 < *path.length()) {
        CHECK(step > 0.09);  // the chord of the curve is slightly shorter than 0.1 m
        CHECK(step < 0.1001);
      } else if (s > *path.length()) {
        CHECK(step == 0);
      }
    }
    CHECK_FALSE(path.teleport(0));
  }
}

TEST_CASE("a file that is no path is refused in one line that says where") {
  CHECK(cli::readPathPoints(R"({"points": [[0, 0, 0], [1, 2.5, -3e2]]})"));
  CHECK(cli::readPathPoints(R"({"points": [[0, 0, 0], [1, 2, 3]], "loop": true})")->loop);
  const Result<PathPoints> broken = cli::readPathPoints("{\"points\": [[0, 0, 0],\n  [1, 2, NaN]]}");
  REQUIRE_FALSE(broken);
  CHECK(broken.error().code == Code::bad_input);
  CHECK(broken.error().line == 2);
  CHECK(broken.error().column > 8);
  CHECK(messageOf("") == "this is not JSON");
  CHECK(messageOf("[]").find("object") != std::string::npos);
  CHECK(messageOf("{}").find("points") != std::string::npos);
  CHECK(messageOf(R"({"points": 3})").find("points") != std::string::npos);
  CHECK(messageOf(R"({"points": []})").find("two") != std::string::npos);
  CHECK(messageOf(R"({"points": [[0, 0, 0]]})").find("two") != std::string::npos);
  CHECK(messageOf(R"({"points": [[1, 1, 1], [1, 1, 1]]})").find("two") != std::string::npos);
  CHECK(messageOf(R"({"points": [[0, 0, 0], [1, 2]]})").find("points[1]") != std::string::npos);
  CHECK(messageOf(R"({"points": [[0, 0, 0], [1, 2, "3"]]})").find("points[1]") != std::string::npos);
  CHECK(messageOf(R"({"points": [[0, 0, 0], [1, 2, null]]})").find("points[1]") != std::string::npos);
  CHECK(messageOf(R"({"points": [[0, 0, 0], [1, 2, 2000001]]})").find("2,000 km") != std::string::npos);
  CHECK(messageOf(R"({"points": [[0, 0, 0], [1, 2, 1e999]]})").find("too large") != std::string::npos);
  CHECK(messageOf(R"({"points": [[0, 0, 0], [1, 2, 3]], "loop": 1})").find("loop") != std::string::npos);
  CHECK(messageOf(R"({"points": [[0, 0, 0], [1, 2, 3]], "lop": true})").find("lop") != std::string::npos);
  const Result<FlightPath> missing = FlightPath::ofFile("no such file.json");
  REQUIRE_FALSE(missing);
  CHECK(missing.error().code == Code::io);
  CHECK(missing.error().message.find("no such file.json") != std::string::npos);
}
