// Tests distances between surfaces: known distances, distances of random meshes compared with a search of all
// triangles, and the bounds of distances.

#include "measure/hausdorff.h"

#include <memory>

#include "../catch.h"
#include "../rounds.h"
#include "measure/nearest.h"
#include "shapes.h"

namespace sgm::measure {
namespace {

std::unique_ptr<JobSystem> threadsFor(unsigned n) { return std::move(*makeThreadPool(n)); }

Hausdorff apartOf(const Mesh& first, const Mesh& second, const HausdorffSettings& settings = {}) {
  const auto jobs = threadsFor(2);
  const Result<Hausdorff> result = hausdorff(first, second, settings, *jobs);
  REQUIRE(result);
  return *result;
}

Point cornerOf(const Mesh& mesh, const Triangle& t, size_t k) { return mesh.points[t[k]]; }

/// Distance from `to` to the nearest point of a triangle, by repeated bisection: slow, and based only on convexity.
double bySearch(const std::array<Point, 3>& t, Point to) {
  const auto along = [&](double v) {
    const auto at = [&](double u) { return length(t[0] + u * (t[1] - t[0]) + v * (t[2] - t[0]) - to); };
    double low = 0, high = 1 - v;
    for (int i = 0; i < 100; ++i) {
      const double a = low + (high - low) / 3, b = high - (high - low) / 3;
      (at(a) < at(b) ? high : low) = at(a) < at(b) ? b : a;
    }
    return at(0.5 * (low + high));
  };
  double low = 0, high = 1;
  for (int i = 0; i < 100; ++i) {
    const double a = low + (high - low) / 3, b = high - (high - low) / 3;
    (along(a) < along(b) ? high : low) = along(a) < along(b) ? b : a;
  }
  return along(0.5 * (low + high));
}

double toEveryTriangle(const Mesh& mesh, Point to) {
  double least = HUGE_VAL;
  for (const Triangle& t : mesh.triangles) {
    least =
        std::min(least, length(nearestOn({cornerOf(mesh, t, 0), cornerOf(mesh, t, 1), cornerOf(mesh, t, 2)}, to) - to));
  }
  return least;
}

/// A mesh of random triangles anywhere.
Mesh scattered(std::mt19937& random, size_t triangles) {
  Mesh mesh;
  const auto place = [&](double size) {
    return Point{between(random, -size, size), between(random, -size, size), between(random, -size, size)};
  };
  for (uint32_t i = 0; i < triangles; ++i) {
    const Point at = place(2);
    for (int k = 0; k < 3; ++k) mesh.points.push_back(at + place(1));
    mesh.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  }
  return mesh;
}

}  // namespace

TEST_CASE("the nearest place of a triangle is the nearest of all its places") {
  const uint32_t seed = 5;
  CAPTURE(seed);
  std::mt19937 random(seed);
  for (unsigned round = 0; round < rounds(500); ++round) {
    std::array<Point, 3> t{};
    for (Point& p : t) {
      p = {between(random, -1, 1), between(random, -1, 1), between(random, -1, 1)};
    }
    // Some triangles are slivers, or degenerate to a segment or a point.
    if (round % 4 == 1) t[2] = t[0] + between(random, 0, 1) * (t[1] - t[0]) + 1e-9 * t[2];
    if (round % 16 == 2) t[2] = 0.5 * (t[0] + t[1]);
    if (round % 16 == 6) t[1] = t[2] = t[0];
    const Point to{between(random, -2, 2), between(random, -2, 2), between(random, -2, 2)};
    const double expected = bySearch(t, to), found = length(nearestOn(t, to) - to);
    CAPTURE(round, expected, found);
    CHECK(std::fabs(found - expected) < 1e-7);
  }
}

TEST_CASE("the tree finds what a look at every triangle finds") {
  const uint32_t seed = 6;
  CAPTURE(seed);
  std::mt19937 random(seed);
  const auto jobs = threadsFor(1);
  for (unsigned round = 0; round < rounds(60); ++round) {
    Mesh mesh = scattered(random, 1 + random() % 40);
    // Some meshes lie far from the origin, where single-precision boxes are coarse.
    if (round % 3 == 0) mesh = mesh.at({1e6, -1e6, 1e5});
    const Bvh tree(mesh, *jobs);
    for (int i = 0; i < 20; ++i) {
      const Point to = mesh.points[random() % mesh.points.size()] + Point{between(random, -3, 3), 1, 0};
      const auto guess = static_cast<uint32_t>(random() % mesh.triangles.size());
      const Nearest nearest = nearestOf(mesh, tree, to, guess);
      CHECK(nearest.distance == toEveryTriangle(mesh, to));
      CHECK(length(nearest.place - to) == nearest.distance);
      const Triangle& t = mesh.triangles[nearest.triangle];
      CHECK(length(nearestOn({cornerOf(mesh, t, 0), cornerOf(mesh, t, 1), cornerOf(mesh, t, 2)}, to) - to) ==
            nearest.distance);
    }
  }
}

TEST_CASE("a surface is at no distance from itself, and at its own from a copy that was moved") {
  const uint32_t seed = 7;
  CAPTURE(seed);
  std::mt19937 random(seed);
  for (unsigned round = 0; round < rounds(10); ++round) {
    const Mesh mesh = randomSurface(random, 6);
    const Hausdorff same = apartOf(mesh, mesh);
    CHECK(same.atMost() < 1e-12);
    CHECK(same.there.mean < 1e-12);
  }
  // A plate and its copy above it; a box and its copy, shifted along one axis.
  const Mesh plate{{{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}}, {{0, 1, 2}, {0, 2, 3}}};
  const Hausdorff above = apartOf(plate, plate.at({0, 0, 0.25}));
  CHECK(above.atLeast() == 0.25);
  CHECK(above.atMost() == 0.25);
  CHECK(above.there.mean == Approx(0.25).margin(1e-12));
  CHECK(above.there.rms == Approx(0.25).margin(1e-12));
  const Mesh cube = box({1, 1, 1}, 4);
  const Hausdorff beside = apartOf(cube, cube.at({0.2, 0, 0}));
  CHECK(beside.atLeast() == Approx(0.2).margin(1e-12));
  CHECK(beside.atMost() == Approx(0.2).margin(1e-12));
  CHECK(beside.there.mean == Approx(beside.back.mean).margin(1e-12));
  // Two of the cube's six sides are 0.2 away from the other cube. On the remaining four sides, only points near the
  // edges have a distance from it, which is less than 0.2.
  CHECK(beside.there.mean > 0.2 * 2 / 6);
  CHECK(beside.there.mean < 0.2 * 3 / 6);
}

TEST_CASE("concentric balls are apart by the difference of their radii, as far as their triangles are round") {
  double before = 0;
  for (int cuts = 2; cuts <= 4; ++cuts) {
    const Mesh inner = ball(cuts), outer = ball(cuts).moved([](Point p) { return 1.5 * p; });
    const Hausdorff apart = apartOf(inner, outer, {2, 1e-3, 100'000});
    // Largest distance between a triangle and the ball, which occurs in the middle of the largest triangle.
    double sagitta = 0;
    for (const Triangle& t : inner.triangles) {
      const Point middle = (1.0 / 3) * (inner.points[t[0]] + inner.points[t[1]] + inner.points[t[2]]);
      sagitta = std::max(sagitta, 1 - length(middle));
    }
    CAPTURE(cuts, sagitta, apart.atLeast(), apart.atMost());
    CHECK(apart.atLeast() <= apart.atMost());
    CHECK(apart.atMost() <= apart.atLeast() + 1e-3);
    CHECK(apart.atLeast() >= 0.5 - 1.5 * sagitta);
    CHECK(apart.atMost() <= 0.5 + 1.5 * sagitta + 1e-3);
    const double off = std::fabs(apart.there.mean - 0.5);
    if (cuts > 2) CHECK(orderOf(before, off) > 1.8);
    before = off;
  }
}

TEST_CASE("both sides count, each for itself") {
  // All of the small plate is near the large one, but not all of the large one is near the small plate.
  const Mesh large{{{0, 0, 0}, {8, 0, 0}, {8, 8, 0}, {0, 8, 0}}, {{0, 1, 2}, {0, 2, 3}}};
  const Mesh small{{{0, 0, 1}, {1, 0, 1}, {0, 1, 1}}, {{0, 1, 2}}};
  const Hausdorff apart = apartOf(small, large);
  CHECK(apart.there.at_least == 1);
  CHECK(apart.there.at_most == Approx(1).epsilon(1e-6));
  CHECK(apart.back.at_least == Approx(std::sqrt(7.5 * 7.5 * 2 + 1)));
  CHECK(apart.atLeast() == apart.back.at_least);
  CHECK(apart.atMost() == apart.back.at_most);
  CHECK(apart.back.farthest == Point{8, 8, 0});
  CHECK(apart.there.samples == 3 + 4);
  CHECK(apart.back.samples == 4 + 2 * 4);
  const Hausdorff turned = apartOf(large, small);
  CHECK(turned.there.at_least == apart.back.at_least);
  CHECK(turned.back.at_most == apart.there.at_most);
}

TEST_CASE("the bounds hold for random surfaces, whatever of them is sampled") {
  const uint32_t seed = 8;
  CAPTURE(seed);
  std::mt19937 random(seed);
  for (unsigned round = 0; round < rounds(25); ++round) {
    const Mesh from = scattered(random, 1 + random() % 8), to = scattered(random, 1 + random() % 8);
    HausdorffSettings settings;
    settings.cuts = 1 + static_cast<uint32_t>(random() % 3);
    settings.refinements = random() % 2 == 0 ? 0 : 20'000;
    settings.tolerance = 1e-3;
    const OneSided found = apartOf(from, to, settings).there;
    double farthest = 0;
    for (int i = 0; i < 4000; ++i) {
      const Triangle& t = from.triangles[random() % from.triangles.size()];
      double u = between(random, 0, 1), v = between(random, 0, 1);
      if (u + v > 1) u = 1 - u, v = 1 - v;
      const Point a = from.points[t[0]], b = from.points[t[1]], c = from.points[t[2]];
      farthest = std::max(farthest, toEveryTriangle(to, a + u * (b - a) + v * (c - a)));
    }
    CAPTURE(round, farthest, found.at_least, found.at_most);
    CHECK(farthest <= found.at_most + 1e-12);
    CHECK(found.at_least == toEveryTriangle(to, found.farthest));
    CHECK(found.mean <= found.rms);
    CHECK(found.rms <= found.at_least);
    if (settings.refinements > 0) {
      CHECK(found.at_most <= found.at_least + settings.tolerance);
      CHECK(farthest <= found.at_least + settings.tolerance);
    }
  }
}

TEST_CASE("distances are the same for any number of threads") {
  std::mt19937 random(9);
  const Mesh first = torus(60), second = torus(50).at({0.01, 0, 0});
  const auto one = threadsFor(1), four = threadsFor(4);
  const Result<Hausdorff> a = hausdorff(first, second, {}, *one), b = hausdorff(first, second, {}, *four);
  REQUIRE((a && b));
  CHECK(a->there.at_least == b->there.at_least);
  CHECK(a->there.at_most == b->there.at_most);
  CHECK(a->there.mean == b->there.mean);
  CHECK(a->back.rms == b->back.rms);
  CHECK(a->back.farthest == b->back.farthest);
}

TEST_CASE("what has no distance is refused") {
  const auto jobs = threadsFor(1);
  const Mesh nothing, something = ball(0);
  const Result<Hausdorff> both = hausdorff(nothing, nothing, {}, *jobs);
  REQUIRE(both);
  CHECK(both->atMost() == 0);
  CHECK(both->there.samples == 0);
  CHECK(hausdorff(something, nothing, {}, *jobs).error().code == Code::invalid_argument);
  CHECK(hausdorff(nothing, something, {}, *jobs).error().code == Code::invalid_argument);
  CHECK(hausdorff(something, something, {0, 0, 0}, *jobs).error().code == Code::invalid_argument);
  CHECK(hausdorff(something, something, {65, 0, 0}, *jobs).error().code == Code::invalid_argument);
  CHECK(hausdorff(something, something, {1, -1, 0}, *jobs).error().code == Code::invalid_argument);
  CHECK(hausdorff(something, something, {1, std::nan(""), 0}, *jobs).error().code == Code::invalid_argument);
}

}  // namespace sgm::measure
