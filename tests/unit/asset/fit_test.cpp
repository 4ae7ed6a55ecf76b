// Tests assets in other sizes: their angles stay, their boxes have the requested size, and stiff parts are unchanged.

#include "asset/fit.h"

#include <algorithm>
#include <random>

#include "bodies.h"
#include "catch.h"
#include "rounds.h"

using namespace sgm;
using namespace sgm::asset;

namespace {

std::string refusal(const TriangleMesh& mesh, Point size, const std::vector<FitZone>& zones = {}) {
  const auto body = fitInto(solidOf(mesh), size, zones);
  return body ? "" : body.error().message;
}

/// Checks that every corner lies in the planes of its faces, and that the faces have the same orientation as in the
/// original asset.
void checkAngles(const Polyhedron& body, const Polyhedron& asset) {
  for (size_t t = 0; t < body.triangles.size(); ++t) {
    const Plane& plane = body.faces[body.face_of[t]].plane;
    for (const uint32_t corner : body.triangles[t])
      if (std::fabs(plane.distance(body.points[corner])) > 1e-9) FAIL("a corner has left its face");
  }
  for (const Face& face : body.faces)
    if (std::none_of(asset.faces.begin(), asset.faces.end(),
                     [&](const Face& other) { return length(other.plane.normal - face.plane.normal) < 1e-9; }))
      FAIL("an angle has changed");
}

void checkBox(const Polyhedron& body, Point size) {
  CHECK(length(body.low + 0.5 * size) < 1e-9);
  CHECK(length(body.high - 0.5 * size) < 1e-9);
}

/// The distinct coordinates of a body's corners along an axis, ascending.
std::vector<double> levels(const Polyhedron& body, int axis) {
  std::vector<double> out;
  for (const Point& p : body.points) out.push_back(p[axis] - body.low[axis]);
  std::sort(out.begin(), out.end());
  out.erase(std::unique(out.begin(), out.end(), [](double a, double b) { return b - a < 1e-9; }), out.end());
  return out;
}

void checkLevels(const Polyhedron& body, int axis, const std::vector<double>& wanted) {
  const std::vector<double> found = levels(body, axis);
  REQUIRE(found.size() == wanted.size());
  for (size_t i = 0; i < found.size(); ++i) CHECK(found[i] == Approx(wanted[i]).margin(1e-9));
}

}  // namespace

TEST_CASE("without zones all of an asset stretches alike", "[asset][fit]") {
  const Polyhedron wall = solidOf(windowedWall(2, 1));
  const auto body = fitInto(wall, {10, 7, 1}, {});
  REQUIRE(body);
  checkBox(*body, {10, 7, 1});
  checkAngles(*body, wall);
  checkLevels(*body, 0, {0, 2, 4, 6, 8, 10});
  checkLevels(*body, 1, {0, 2, 5, 7});
}

TEST_CASE("zones stretch in proportion to their lengths, and nothing else does", "[asset][fit]") {
  const Polyhedron wall = solidOf(windowedWall(2, 1));  // the windows span x = 1..2 m and 3..4 m of the wall's 5 m
  const auto body = fitInto(wall, {8, 3.5, 0.5}, std::vector<FitZone>{{0, false, 0.2, 0.6}, {0, false, 2.2, 3}});
  REQUIRE(body);
  // The wall gets 3 m longer. The zones that may stretch are 0.4 m and 0.8 m long, so the first gets 1 m of that and
  // the second 2 m. Parts of the wall outside of these zones only move.
  checkLevels(*body, 0, {0, 2, 3, 6, 7, 8});
  checkBox(*body, {8, 3.5, 0.5});
}

TEST_CASE("slanted faces keep their slope while what they join grows", "[asset][fit]") {
  const Polyhedron house = solidOf(gabledHouse());  // 6 m wide, with the eaves at 4 m and the ridge at 6 m
  for (const double wide : {3.0, 6.0, 8.0, 14.0}) {
    const auto body = fitInto(house, {wide, 8, 10}, {});
    REQUIRE(body);
    checkBox(*body, {wide, 8, 10});
    checkAngles(*body, house);
    // Because the roof keeps its slope, the ridge is a third of the width above the eaves.
    checkLevels(*body, 1, {0, 8 - wide / 3, 8});
    checkLevels(*body, 0, {0, wide / 2, wide});
  }
}

TEST_CASE("an arch with stiff chords is moved, and one that may stretch keeps its angles", "[asset][fit]") {
  const Polyhedron bay = solidOf(archedBay(8));
  const auto tall = fitInto(bay, {3, 6, 1}, std::vector<FitZone>{{1, false, 0.5, 2}});
  REQUIRE(tall);
  CHECK(tall->volume() == Approx(bay.volume() + 2.0 * 1.0));
  const auto wide = fitInto(bay, {5, 5.5, 2}, {});
  REQUIRE(wide);
  checkBox(*wide, {5, 5.5, 2});
  checkAngles(*wide, bay);
}

TEST_CASE("zones are copied as often as comes nearest to the size", "[asset][fit]") {
  const Polyhedron wall = solidOf(windowedWall(1, 1));  // the window spans x = 1..2 m of the wall's 3 m
  const std::vector<FitZone> alone{{0, true, 0.5, 2.5}};
  // If the wall has no zone that stretches, the copies of the repeated zone stretch until they fill the size.
  const auto three = fitInto(wall, {7.6, 3.5, 0.5}, alone);
  REQUIRE(three);
  checkLevels(*three, 0, {0, 0.5, 1.05, 2.15, 2.7, 3.25, 4.35, 4.9, 5.45, 6.55, 7.1, 7.6});
  CHECK(three->volume() == Approx(0.5 * (7.6 * 3.5 - 3 * 1.1 * 1.5)));
  // If the wall also has a zone that stretches, the copies of the repeated zone keep their length.
  const auto stiff = fitInto(wall, {7.6, 3.5, 0.5}, std::vector<FitZone>{{0, true, 0.5, 2.5}, {0, false, 0.1, 0.4}});
  REQUIRE(stiff);
  CHECK(stiff->volume() == Approx(0.5 * (7.6 * 3.5 - 3 * 1.0 * 1.5)));
  // If the size is small, a repeated zone is left out: it has no copy at all.
  const auto none = fitInto(wall, {1.5, 3.5, 0.5}, std::vector<FitZone>{{0, true, 0.5, 2.5}, {0, false, 0.1, 0.4}});
  REQUIRE(none);
  CHECK(none->volume() == Approx(0.5 * 1.5 * 3.5));
  // Zones along two axes are fitted independently.
  const auto both = fitInto(wall, {7, 12.5, 0.5}, std::vector<FitZone>{{0, true, 0.5, 2.5}, {1, true, 0.25, 3.25}});
  REQUIRE(both);
  CHECK(both->volume() == Approx(0.5 * (7 * 12.5 - 3 * 4 * 1.5)));
}

TEST_CASE("copies of what is slanted join, too", "[asset][fit]") {
  const Polyhedron bay = solidOf(archedBay(8));
  for (const double wide : {2.2, 3.0, 5.9, 10.4, 22.0}) {
    const auto row = fitInto(bay, {wide, 4.6, 1.5}, std::vector<FitZone>{{0, true, 0.25, 2.75}});
    REQUIRE(row);
    checkBox(*row, {wide, 4.6, 1.5});
    checkAngles(*row, bay);
  }
}

TEST_CASE("sizes that an asset cannot have are told with those that it could", "[asset][fit]") {
  CHECK(refusal(gabledHouse(), {14, 3, 8}) ==
        "impossible fit: with its angles kept, and stiff where it has no zone to stretch, this asset cannot be 14m x "
        "3m x "
        "8m; it could be at most 8.879m along x, or at least 4.707m along y");
  CHECK(
      refusal(gabledHouse(), {6, 6, 1}, {{2, false, 2, 4}}) ==
      "impossible fit: with its angles kept, and stiff where it has no zone to stretch, this asset cannot be 6m x 6m x "
      "1m; it could be at least 6.021m along z");
  // This fit is impossible, because the roof has no zone in which its height could change.
  CHECK(
      refusal(gabledHouse(), {8, 9, 8}, {{0, false, 1, 5}, {1, false, 1, 2}}) ==
      "impossible fit: with its angles kept, and stiff where it has no zone to stretch, this asset cannot be 8m x 9m x "
      "8m; it could be at most 6m along x");
  CHECK(
      refusal(gabledHouse(), {1, 1, 1}, {{0, false, 1, 2}, {1, false, 1, 2}, {2, false, 1, 2}}) ==
      "impossible fit: with its angles kept, and stiff where it has no zone to stretch, this asset cannot be 1m x 1m x "
      "1m; its own size is 6m x 6m x 8m");
}

TEST_CASE("zones that cannot be meant are told", "[asset][fit]") {
  CHECK(refusal(gabledHouse(), {6, 6, 8}, {{0, false, 5, 7}}) ==
        "the zone 5m..7m along x is not a part of this asset, which goes from 0m to 6m there");
  CHECK(refusal(gabledHouse(), {6, 6, 8}, {{1, true, 3, 2}}) ==
        "the zone 3m..2m along y is not a part of this asset, which goes from 0m to 6m there");
  CHECK(refusal(gabledHouse(), {6, 6, 8}, {{2, true, 1, 3}, {2, false, 2, 4}}) ==
        "the zone 2m..4m along z overlaps another one");
  CHECK(refusal(windowedWall(1, 1), {9, 3.5, 0.5}, {{0, true, 1.5, 2.5}}) ==
        "a repeated zone along x does not join: its sections at both ends differ");
}

TEST_CASE("copies are not without number", "[asset][fit]") {
  CHECK(refusal(archedBay(40), {2500, 4, 1}, {{0, true, 0.25, 2.75}}) == "its copies have more than 65536 triangles");
}

TEST_CASE("random sizes keep angles and boxes, or are refused", "[asset][fit]") {
  for (unsigned seed = 0; seed < rounds(200); ++seed) {
    INFO("seed " << seed);
    std::mt19937 random(seed);
    const auto between = [&](double low, double high) {
      return low + (high - low) * static_cast<double>(random() % 10001) / 10000;
    };
    const TriangleMesh mesh = seed % 3 == 0   ? archedBay(3 + random() % 10)
                              : seed % 3 == 1 ? gabledHouse()
                                              : windowedWall(1 + random() % 3, 1 + random() % 3);
    const Polyhedron asset = solidOf(mesh);
    const Point size{between(0.5, 20), between(0.5, 20), between(0.2, 20)};
    std::vector<FitZone> zones;
    for (int axis = 0; axis < 3; ++axis) {
      if (random() % 2 == 0) continue;
      const double from = between(0, 0.5) * asset.high[axis],
                   to = from + between(0.05, 0.5) * (asset.high[axis] - from);
      zones.push_back({axis, random() % 4 == 0, from, to});
    }
    const auto body = fitInto(asset, size, zones);
    if (!body) {
      CHECK_FALSE(body.error().message.empty());
      continue;
    }
    checkBox(*body, size);
    checkAngles(*body, asset);
    const auto again = fitInto(asset, size, zones);
    CHECK(again->points == body->points);
  }
}
