// Tests ear clipping: polygons of any shape become triangles that do not overlap.

#include "asset/read/ear_clipping.h"

#include <algorithm>
#include <cmath>
#include <random>

#include "asset/exact_sign.h"
#include "catch.h"
#include "rounds.h"

using namespace sgm;
using namespace sgm::asset;

namespace {

using Polygon = std::vector<Point>;
using Cut = std::vector<std::array<uint32_t, 3>>;

double areaOf(const Polygon& p, const Cut& cut) {
  double sum = 0;
  for (const auto& [a, b, c] : cut) sum += length(cross(p[b] - p[a], p[c] - p[a])) / 2;
  return sum;
}
/// Area of a polygon in the plane z = 0, by the shoelace formula.
double shoelace(const Polygon& p) {
  double sum = 0;
  for (size_t i = 0; i < p.size(); ++i) {
    const Point &a = p[i], &b = p[(i + 1) % p.size()];
    sum += a.x * b.y - a.y * b.x;
  }
  return sum / 2;
}

/// Triangulates a polygon, and checks the result: the triangles use every edge of the polygon once and every other edge
/// in both directions, have the same orientation, and fill the polygon's area. Together, these checks prove that the
/// result is a triangulation.
Cut checkedCut(const Polygon& polygon, double area, bool flat_allowed = false) {
  EarClipping clipping;
  Cut cut;
  REQUIRE(clipping.run(polygon, cut) == Clipped::done);
  REQUIRE(cut.size() == polygon.size() - 2);
  const auto count = static_cast<uint32_t>(polygon.size());
  std::vector<std::pair<uint32_t, uint32_t>> edges, borders;
  for (const auto& t : cut)
    for (size_t k = 0; k < 3; ++k) edges.emplace_back(t[k], t[(k + 1) % 3]);
  std::sort(edges.begin(), edges.end());
  CHECK(std::adjacent_find(edges.begin(), edges.end()) == edges.end());
  for (const auto& [from, to] : edges)
    if (!std::binary_search(edges.begin(), edges.end(), std::pair{to, from})) borders.emplace_back(from, to);
  CHECK(borders.size() == count);
  for (const auto& [from, to] : borders) CHECK(to == (from + 1) % count);
  if (!flat_allowed) {
    double least = 1;
    for (const auto& [a, b, c] : cut)
      least = std::min(least, length(cross(polygon[b] - polygon[a], polygon[c] - polygon[a])));
    CHECK(least > 0);
  }
  CHECK(areaOf(polygon, cut) == Approx(area));
  return cut;
}

Clipped outcome(const Polygon& polygon) {
  EarClipping clipping;
  Cut cut;
  return clipping.run(polygon, cut);
}

/// Rotates the polygon out of the plane z = 0 by a matrix of rational numbers, and moves it.
Polygon tilted(Polygon polygon) {
  for (Point& p : polygon) {
    const Point one{p.x, 0.6 * p.y - 0.8 * p.z, 0.8 * p.y + 0.6 * p.z};
    p = Point{0.28 * one.x - 0.96 * one.z, one.y, 0.96 * one.x + 0.28 * one.z} + Point{100, -50, 7};
  }
  return polygon;
}

const Polygon kL = {{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 1, 0}, {1, 2, 0}, {0, 2, 0}};
const Polygon kC = {{0, 0, 0}, {3, 0, 0}, {3, 1, 0}, {1, 1, 0}, {1, 2, 0}, {3, 2, 0}, {3, 3, 0}, {0, 3, 0}};

}  // namespace

TEST_CASE("concave polygons are cut, from whichever corner they begin and whichever way they look",
          "[asset][polygon]") {
  for (const auto& [shape, area] : {std::pair{kL, 3.0}, std::pair{kC, 7.0}}) {
    for (size_t first = 0; first < shape.size(); ++first) {
      Polygon turned = shape;
      std::rotate(turned.begin(), turned.begin() + static_cast<std::ptrdiff_t>(first), turned.end());
      checkedCut(turned, area);
      checkedCut(tilted(turned), area);
      std::reverse(turned.begin(), turned.end());
      checkedCut(turned, area);
      checkedCut(tilted(turned), area);
    }
  }
}

TEST_CASE("convex polygons stay fans", "[asset][polygon]") {
  Polygon round;
  for (int i = 0; i < 40; ++i) round.push_back({std::cos(i * 0.157), std::sin(i * 0.157), 0});
  const Cut cut = checkedCut(round, shoelace(round));
  for (uint32_t i = 0; i < cut.size(); ++i) CHECK(cut[i] == std::array<uint32_t, 3>{0, i + 1, i + 2});
}

TEST_CASE("corners on straight edges stay corners of triangles with area", "[asset][polygon]") {
  checkedCut({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 2, 0}}, 2);
  checkedCut({{1, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 0, 0}}, 2);
  checkedCut({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}, {3, 3, 0}, {2, 2, 0}, {1, 1, 0}}, 4.5);
  Polygon square;
  for (int i = 0; i < 10; ++i) square.push_back({static_cast<double>(i), 0, 0});
  for (int i = 0; i < 10; ++i) square.push_back({10, static_cast<double>(i), 0});
  for (int i = 0; i < 10; ++i) square.push_back({static_cast<double>(10 - i), 10, 0});
  for (int i = 0; i < 10; ++i) square.push_back({0, static_cast<double>(10 - i), 0});
  checkedCut(square, 100);
  checkedCut(tilted(square), 100, true);
}

TEST_CASE("a hole that a bridge joins to the border stays a hole", "[asset][polygon]") {
  // A square frame with an outer edge of 4 and a hole with an edge of 2: a bridge edge, used in both directions, joins
  // the two outlines.
  const Polygon frame = {{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}, {0, 0, 0},
                         {1, 1, 0}, {1, 3, 0}, {3, 3, 0}, {3, 1, 0}, {1, 1, 0}};
  checkedCut(frame, 12);
  checkedCut(tilted(frame), 12);
}

TEST_CASE("polygons that are not plane are cut as they are seen along their normal", "[asset][polygon]") {
  Polygon bent = kC;
  for (size_t i = 0; i < bent.size(); ++i) bent[i].z = i % 2 == 0 ? 0.1 : -0.1;
  EarClipping clipping;
  Cut cut;
  REQUIRE(clipping.run(bent, cut) == Clipped::done);
  Polygon flat = bent;
  for (Point& p : flat) p.z = 0;
  double sum = 0;
  for (const auto& [a, b, c] : cut) {
    const double z = cross(flat[b] - flat[a], flat[c] - flat[a]).z;
    CHECK(z > 0);
    sum += z / 2;
  }
  CHECK(sum == Approx(7));
}

TEST_CASE("polygons that cross themselves, and those without area, are told", "[asset][polygon]") {
  CHECK(outcome({{0, 0, 0}, {2, 2, 0}, {2, 0, 0}, {0, 1, 0}}) == Clipped::crossed);
  CHECK(outcome({{0, 0, 0}, {2, 2, 0}, {2, 0, 0}, {0, 2, 0}}) == Clipped::crossed);
  CHECK(outcome({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}}) == Clipped::crossed);
  CHECK(outcome({{0, 0, 0}, {0, 0, 0}, {0, 0, 0}, {0, 0, 0}}) == Clipped::crossed);
  // A five-pointed star, whose outline winds twice around its middle.
  Polygon star;
  for (int i = 0; i < 5; ++i) star.push_back({std::cos(i * 2.5132741), std::sin(i * 2.5132741), 0});
  CHECK(outcome(star) == Clipped::crossed);
  // A corner lies on another edge, and the outline crosses there.
  CHECK(outcome({{0, 0, 0}, {4, 0, 0}, {4, 2, 0}, {2, 0, 0}, {1, -2, 0}}) == Clipped::crossed);
  // The outline of a closed band that overlaps itself.
  CHECK(outcome({{0, 0, 0},
                 {6, 0, 0},
                 {6, 5, 0},
                 {2, 5, 0},
                 {2, -2, 0},
                 {3, -2, 0},
                 {3, 4, 0},
                 {5, 4, 0},
                 {5, 1, 0},
                 {0, 1, 0}}) == Clipped::crossed);
}

TEST_CASE("random polygons without crossings are cut into triangles that fill them", "[asset][polygon]") {
  for (unsigned seed = 0; seed < rounds(300); ++seed) {
    INFO("seed " << seed);
    std::mt19937 random(seed);
    const auto unit = [&] { return static_cast<double>(random()) / 4294967296.0; };
    // Corners sorted by angle around a centre; every other polygon has integer coordinates, so that corners often lie
    // on lines through other corners.
    const size_t corners = 4 + random() % 60;
    Polygon polygon;
    for (size_t i = 0; i < corners; ++i) {
      const double angle = 6.283185307179586 * static_cast<double>(i) / static_cast<double>(corners);
      const double radius = 1 + 20 * unit();
      polygon.push_back({radius * std::cos(angle), radius * std::sin(angle), 0});
    }
    std::rotate(polygon.begin(), polygon.begin() + static_cast<std::ptrdiff_t>(random() % corners), polygon.end());
    const double area = shoelace(polygon);
    checkedCut(polygon, area);
    checkedCut(tilted(polygon), area);
    // The outline of a staircase with integer coordinates.
    Polygon stairs{{0, 0, 0}};
    double x = 0;
    const size_t steps = 2 + random() % 20;
    for (size_t i = 0; i < steps; ++i) {
      const double rise = (i % 2 == 0 ? 1 : 4) + static_cast<double>(random() % 3);
      stairs.push_back({x, -rise, 0});
      x += 1 + static_cast<double>(random() % 3);
      stairs.push_back({x, -rise, 0});
    }
    stairs.push_back({x, 3, 0});
    stairs.push_back({0, 3, 0});
    stairs.erase(stairs.begin());
    checkedCut(stairs, shoelace(stairs));
  }
}

TEST_CASE("polygons of many corners take n log n steps, not n squared", "[asset][polygon][costly]") {
  constexpr int kCorners = 100000;
  Polygon gear, comb, spiral;
  for (int i = 0; i < kCorners; ++i) {
    const double angle = 6.283185307179586 * i / kCorners, radius = i % 2 == 0 ? 10 : 4;
    gear.push_back({radius * std::cos(angle), radius * std::sin(angle), 0});
  }
  for (int i = 0; i < kCorners / 4; ++i)
    for (const Point p :
         {Point{4.0 * i, 1, 0}, Point{4.0 * i, 1000, 0}, Point{4.0 * i + 2, 1000, 0}, Point{4.0 * i + 2, 1, 0}})
      comb.push_back(p);
  comb.push_back({kCorners, 0, 0});
  comb.push_back({0, 0, 0});
  std::reverse(comb.begin(), comb.end());
  Polygon slanted = comb;
  for (Point& p : slanted) p.x += 3 * p.y;
  // The outline follows a spiral outwards, and returns along a second spiral parallel to it.
  for (int i = 0; i < kCorners; ++i) {
    const int step = i < kCorners / 2 ? i : kCorners - 1 - i;
    const double angle = 0.01 * step, radius = 1 + 0.1 * angle + (i < kCorners / 2 ? 0 : 0.2);
    spiral.push_back({radius * std::cos(angle), radius * std::sin(angle), 0});
  }
  for (const Polygon& polygon : {gear, comb, slanted, spiral}) {
    EarClipping clipping;
    Cut cut;
    REQUIRE(clipping.run(polygon, cut) == Clipped::done);
    CHECK(areaOf(polygon, cut) == Approx(std::fabs(shoelace(polygon))));
  }
}
