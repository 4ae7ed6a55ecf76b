#include "tools/survey/contour.h"

#include <cmath>

#include "catch.h"

using namespace sgm::survey;

namespace {

Grid cone(int size, double radius) {
  Grid grid(size, size, 0);
  for (int y = 0; y < size; ++y)
    for (int x = 0; x < size; ++x)
      grid.at(x, y) = static_cast<float>(radius - std::hypot(x - size / 2.0 + 0.5, y - size / 2.0 + 0.5));
  return grid;
}

/// Twice the area of a ring; positive if the ring is clockwise on paper.
double turned(const Line& ring) {
  double sum = 0;
  for (size_t i = 1; i < ring.size(); ++i) sum += ring[i - 1].x * ring[i].y - ring[i].x * ring[i - 1].y;
  return sum;
}

}  // namespace

TEST_CASE("a contour of a cone is a circle that ends where it began", "[survey]") {
  const Grid grid = cone(40, 12);
  const std::vector<Line> lines = contours(grid, 0);
  REQUIRE(lines.size() == 1);
  CHECK(lines[0].front() == lines[0].back());
  for (const Point& p : lines[0]) CHECK(std::hypot(p.x - 19.5, p.y - 19.5) == Approx(12).margin(0.1));
  CHECK(lengthOf(lines[0]) == Approx(2 * 3.14159 * 12).epsilon(0.01));
  // Seen along the line, larger values are on its right.
  CHECK(turned(lines[0]) > 0);
  CHECK(lengthOf(smoothed(lines[0])) == Approx(lengthOf(lines[0])).epsilon(0.01));
  CHECK(smoothed(lines[0]).front() == smoothed(lines[0]).back());
}

TEST_CASE("contours end at the border and beside what is unknown", "[survey]") {
  Grid slope(5, 4, 0);
  for (int y = 0; y < 4; ++y)
    for (int x = 0; x < 5; ++x) slope.at(x, y) = static_cast<float>(x);
  std::vector<Line> lines = contours(slope, 1.5f);
  REQUIRE(lines.size() == 1);
  CHECK(lines[0].size() == 4);
  for (const Point& p : lines[0]) CHECK(p.x == Approx(1.5));
  slope.at(1, 1) = kUnknown;
  lines = contours(slope, 1.5f);
  REQUIRE(lines.size() == 1);
  CHECK(lines[0].size() == 2);
  spread(slope, 1);
  CHECK_FALSE(std::isnan(slope.at(1, 1)));
}

TEST_CASE("areas are closed along the border, and holes are rings too", "[survey]") {
  Grid grid(6, 6, 1);
  grid.at(2, 3) = -1;
  const std::vector<Line> rings = areasAbove(grid, 0);
  REQUIRE(rings.size() == 2);
  for (const Line& ring : rings) CHECK(ring.front() == ring.back());
  CHECK((turned(rings[0]) > 0) != (turned(rings[1]) > 0));
}

TEST_CASE("of four corners by turns the mean says which hang together", "[survey]") {
  Grid grid(2, 2, -1);
  grid.at(0, 0) = grid.at(1, 1) = 3;
  const std::vector<Line> together = contours(grid, 0);
  REQUIRE(together.size() == 2);
  // The lines cut off the two low corners separately.
  CHECK(together[0].front().x + together[0].front().y != Approx(together[1].front().x + together[1].front().y));
  grid.at(0, 0) = grid.at(1, 1) = 0.5f;
  CHECK(contours(grid, 0).size() == 2);
}

TEST_CASE("only wanted parts of a line are left", "[survey]") {
  const Line line{{0, 0}, {1, 0}, {2, 0}, {3, 0}, {4, 0}, {5, 0}};
  const std::vector<Line> parts = partsOf(line, [](const Point& p) { return p.x != 2; });
  REQUIRE(parts.size() == 2);
  CHECK(parts[0].size() == 2);
  CHECK(parts[1].size() == 3);
}
