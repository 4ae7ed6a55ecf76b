// Tests intersections of triangles: hand-made cases, random ones against exact rational clipping, and meshes against
// testing all pairs.

#include "measure/self_intersection.h"

#include <memory>
#include <utility>

#include "../catch.h"
#include "../rounds.h"
#include "measure/triangle_pair.h"
#include "shapes.h"

namespace sgm::measure {
namespace {

std::unique_ptr<JobSystem> workers(unsigned n) { return std::move(*makeThreadPool(n)); }

SelfIntersections found(const Mesh& mesh, uint64_t tests = uint64_t{1} << 40) {
  const auto jobs = workers(2);
  return selfIntersections(mesh, Bvh(mesh, *jobs), tests, *jobs);
}

uint64_t allPairs(const Mesh& mesh) {
  uint64_t pairs = 0;
  for (size_t a = 0; a < mesh.triangles.size(); ++a)
    for (size_t b = a + 1; b < mesh.triangles.size(); ++b)
      pairs += meetWrongly(mesh.points, mesh.triangles[a], mesh.triangles[b]);
  return pairs;
}

__extension__ using Int128 = __int128;

/// A point with integer coordinates over a common positive denominator.
struct Ratio3 {
  Int128 x, y, z, w;
};

Int128 commonDivisor(Int128 a, Int128 b) {
  while (b != 0) a = std::exchange(b, a % b);
  return a < 0 ? -a : a;
}

Int128 planeAt(const std::array<Int128, 4>& plane, const Ratio3& p) {
  return plane[0] * p.x + plane[1] * p.y + plane[2] * p.z + plane[3] * p.w;
}

/// Clips a polygon exactly: keeps the part in which the plane's value is at least 0.
std::vector<Ratio3> clipped(const std::vector<Ratio3>& polygon, const std::array<Int128, 4>& plane) {
  std::vector<Ratio3> kept;
  for (size_t i = 0; i < polygon.size(); ++i) {
    const Ratio3 &p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
    const Int128 a = planeAt(plane, p), b = planeAt(plane, q);
    if (a >= 0) kept.push_back(p);
    if ((a < 0 && b > 0) || (a > 0 && b < 0)) {
      // The intersection in homogeneous coordinates; a and b are the plane's values at p and q, times p.w and q.w.
      const Ratio3 cut{b * p.x - a * q.x, b * p.y - a * q.y, b * p.z - a * q.z, b * p.w - a * q.w};
      Int128 divisor = commonDivisor(commonDivisor(cut.x, cut.y), commonDivisor(cut.z, cut.w));
      if (cut.w < 0) divisor = -divisor;
      kept.push_back({cut.x / divisor, cut.y / divisor, cut.z / divisor, cut.w / divisor});
    }
  }
  return kept;
}

/// Whether two triangles with small integer coordinates and positive areas have a common point: clips one triangle by
/// the other's plane, from both sides, and by the three planes through the other's edges.
bool meetExactly(const std::array<Point, 3>& a, const std::array<Point, 3>& b) {
  const auto whole = [](double v) { return static_cast<Int128>(static_cast<int64_t>(v)); };
  std::vector<Ratio3> polygon;
  for (const Point p : a) polygon.push_back({whole(p.x), whole(p.y), whole(p.z), 1});
  const Point normal = cross(b[1] - b[0], b[2] - b[0]);
  const auto plane = [&](Point n, Point through, double side) {
    std::array<Int128, 4> result{whole(side * n.x), whole(side * n.y), whole(side * n.z),
                                 whole(-side * dot(n, through))};
    const Int128 divisor = commonDivisor(commonDivisor(result[0], result[1]), commonDivisor(result[2], result[3]));
    for (Int128& part : result) part /= divisor;
    return result;
  };
  polygon = clipped(polygon, plane(normal, b[0], 1));
  polygon = clipped(polygon, plane(normal, b[0], -1));
  for (size_t k = 0; k < 3; ++k) polygon = clipped(polygon, plane(cross(normal, b[(k + 1) % 3] - b[k]), b[k], 1));
  return !polygon.empty();
}

}  // namespace

TEST_CASE("pairs of triangles, one by one", "[self_intersection]") {
  const std::vector<Point> p{{0, 0, 0},  {4, 0, 0}, {0, 4, 0},   // points 0 to 2: in the plane z = 0
                             {1, 1, -1}, {1, 1, 1}, {5, 5, 0},   // points 3 to 5: triangle 3 4 5 crosses 0 1 2
                             {1, 1, 0},  {2, 1, 0}, {1, 2, 0},   // points 6 to 8: inside triangle 0 1 2
                             {0, 0, 4},  {4, 4, 0}, {8, 0, 0}};  // points 9 to 11
  const Triangle flat{0, 1, 2};
  CHECK(meetWrongly(p, flat, {3, 4, 5}));
  CHECK(meetWrongly(p, {3, 4, 5}, flat));
  CHECK(meetWrongly(p, flat, {6, 7, 8}));
  CHECK(meetWrongly(p, flat, {6, 9, 4}));         // a corner of one triangle touches the other triangle
  CHECK_FALSE(meetWrongly(p, flat, {0, 9, 4}));   // the triangles share only a corner
  CHECK(meetWrongly(p, flat, {0, 3, 4}));         // the triangles share a corner, and cross elsewhere
  CHECK(meetWrongly(p, flat, {0, 6, 9}));         // share a corner; an edge of one triangle lies in the other's plane
  CHECK_FALSE(meetWrongly(p, flat, {0, 1, 9}));   // a common edge
  CHECK_FALSE(meetWrongly(p, flat, {1, 2, 10}));  // in one plane, on different sides of their common edge
  CHECK(meetWrongly(p, flat, {0, 1, 6}));         // in one plane, on the same side of their common edge
  CHECK_FALSE(meetWrongly(p, flat, {2, 1, 0}));   // the same triangle, facing the other way
  CHECK_FALSE(meetWrongly(p, flat, {0, 1, 11}));  // without area
  CHECK(isFlat(p, {0, 1, 11}));
  CHECK(isFlat(p, {0, 0, 11}));
  CHECK_FALSE(isFlat(p, flat));
}

TEST_CASE("triangles on a small lattice meet where exact clipping says", "[self_intersection]") {
  int met = 0, apart = 0;
  for (unsigned seed = 0; seed < std::max(rounds(30000), 30000u); ++seed) {
    std::mt19937 random(seed);
    // There are so few positions that corners on edges, edges on edges and common planes are frequent.
    const auto n = 2 + static_cast<uint32_t>(random() % 4);
    std::vector<Point> points;
    for (int i = 0; i < 6; ++i) {
      points.push_back(
          {static_cast<double>(random() % n), static_cast<double>(random() % n), static_cast<double>(random() % n)});
    }
    const Triangle a{0, 1, 2}, b{3, 4, 5};
    if (isFlat(points, a) || isFlat(points, b)) {
      CHECK_FALSE(meetWrongly(points, a, b));
      continue;
    }
    CAPTURE(seed, n);
    const bool expected = meetExactly({points[0], points[1], points[2]}, {points[3], points[4], points[5]});
    CHECK(meetWrongly(points, a, b) == expected);
    CHECK(meetWrongly(points, b, a) == expected);
    met += expected;
    apart += !expected;

    // Triangles with a common corner meet elsewhere if and only if they still meet after this corner is cut off.
    std::vector<Point> common = points;
    common[3] = common[0];
    const Triangle c{0, 4, 5};
    if (isFlat(points, c)) continue;
    // Cuts the common corner off both triangles, parallel to the opposite side. Coordinates are scaled by k, so that
    // they stay integers.
    const double k = 16;
    const auto scaled = [&](Point q) { return k * q; };
    const auto inward = [&](Point from, Point to) { return (k - 1) * from + to; };
    const Point o = common[0];
    bool meet = false;
    // Cuts off the corner o of the triangle o q r, and divides the remaining quadrilateral into two triangles. k is so
    // large that the part that is cut off contains no intersection except the corner itself.
    const auto rest = [&](Point q, Point r) {
      return std::array<std::array<Point, 3>, 2>{
          {{inward(o, q), scaled(q), scaled(r)}, {inward(o, q), scaled(r), inward(o, r)}}};
    };
    for (const auto& first : rest(points[1], points[2]))
      for (const auto& second : {std::array<Point, 3>{scaled(o), scaled(points[4]), scaled(points[5])}})
        meet = meet || meetExactly(first, second);
    for (const auto& second : rest(points[4], points[5]))
      for (const auto& first : {std::array<Point, 3>{scaled(o), scaled(points[1]), scaled(points[2])}})
        meet = meet || meetExactly(first, second);
    CHECK(meetWrongly(points, a, c) == meet);
  }
  CHECK(met > 2000);
  CHECK(apart > 2000);
}

TEST_CASE("the tree finds all pairs that meet", "[self_intersection]") {
  uint64_t pairs = 0;
  for (unsigned seed = 0; seed < rounds(40); ++seed) {
    CAPTURE(seed);
    std::mt19937 random(seed);
    Mesh mesh;
    const auto place = [&](double reach) {
      return Point{between(random, -reach, reach), between(random, -reach, reach), between(random, -reach, reach)};
    };
    const auto count = static_cast<uint32_t>(random() % 200);
    for (uint32_t i = 0; i < count; ++i) {
      const Point at = place(10);
      const double size = random() % 10 == 0 ? 10 : 1.5;
      for (int k = 0; k < 3; ++k) mesh.points.push_back(at + place(size));
      mesh.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
    }
    const SelfIntersections here = found(mesh);
    CHECK(here.pairs == allPairs(mesh));
    CHECK(here.complete);
    CHECK(here.folded == 0);  // no two triangles of the mesh share an edge
    CHECK(here.examples.size() == std::min<size_t>(here.pairs, kMaxExamples));
    for (const auto& [a, b] : here.examples) {
      CHECK(a < b);
      CHECK(meetWrongly(mesh.points, mesh.triangles[a], mesh.triangles[b]));
    }
    pairs += here.pairs;
  }
  CHECK(pairs > 50);
}

TEST_CASE("surfaces of a field do not cut themselves; two balls do", "[self_intersection]") {
  for (unsigned seed = 0; seed < rounds(20); ++seed) {
    CAPTURE(seed);
    std::mt19937 random(seed);
    CHECK(found(placed(randomSurface(random, 7), random, 1, 10)).pairs == 0);
  }
  CHECK(found(ball(3)).pairs == 0);
  CHECK(found(torus(40)).pairs == 0);
  CHECK(found(box({1, 2, 3}, 5)).pairs == 0);
  Mesh two = ball(2);
  two.add(ball(2).at({1, 0, 0}));
  CHECK(found(two).pairs == allPairs(two));
  CHECK(found(two).pairs > 20);
}

TEST_CASE("a mesh with more pairs than may be tested says so, and the same for any number of threads",
          "[self_intersection]") {
  Mesh mesh;
  for (uint32_t i = 0; i < 400; ++i) {
    const double u = 2 * std::numbers::pi * i / 400;
    mesh.points.insert(mesh.points.end(),
                       {{std::cos(u), std::sin(u), -1}, {-std::cos(u), -std::sin(u), 0.1}, {0, 0, 1}});
    mesh.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  }
  const SelfIntersections whole = found(mesh);
  CHECK(whole.complete);
  {
    const auto jobs = workers(2);
    uint64_t told = 0, all = 0;
    const auto progress = [&](uint64_t done, uint64_t total) {
      CHECK(done == told + 1);
      told = done;
      all = total;
    };
    CHECK(selfIntersections(mesh, Bvh(mesh, *jobs), uint64_t{1} << 40, *jobs, progress).pairs == whole.pairs);
    CHECK(told == all);
    CHECK(all > 1);
  }
  std::optional<uint64_t> pairs;
  for (const unsigned n : {1u, 2u, 5u}) {
    const auto jobs = workers(n);
    const SelfIntersections some = selfIntersections(mesh, Bvh(mesh, *jobs), 5000, *jobs);
    CHECK_FALSE(some.complete);
    CHECK(some.pairs > 0);
    CHECK(some.pairs < whole.pairs);
    CHECK(pairs.value_or(some.pairs) == some.pairs);
    pairs = some.pairs;
  }
  CHECK(found({}).pairs == 0);
}

}  // namespace sgm::measure
