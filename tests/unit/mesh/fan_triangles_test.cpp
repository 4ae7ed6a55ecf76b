// Tests fans over planar patches whose points need not all be visible from the fan's centre: every patch must be
// covered exactly once.

#include "mesh/fan_triangles.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <random>
#include <vector>

#include "catch.h"
#include "rounds.h"

using namespace sgm;

namespace {

int between(std::mt19937& random, int low, int high) {
  return low + static_cast<int>(random() % static_cast<uint32_t>(high - low + 1));
}

struct Place {
  int x, y;
};

int64_t cross(const Place& a, const Place& b, const Place& c) {
  return int64_t{b.x - a.x} * (c.y - a.y) - int64_t{b.y - a.y} * (c.x - a.x);
}

/// A simple polygon above the segment of the x axis from (left, 0) to (right, 0), listed from the right end to the left
/// end. It is star-shaped around a point above the segment, which is not necessarily the fan's centre.
std::vector<Place> randomPatch(std::mt19937& random, int left, int right) {
  const Place eye{between(random, left + 20, right - 20), between(random, 30, 80)};
  const double from = std::atan2(-eye.y, right - eye.x), to = std::atan2(-eye.y, left - eye.x) + 2 * 3.14159265358979;
  const int count = between(random, 1, 5);
  std::vector<Place> patch;
  for (int i = 1; i <= count; ++i) {
    const double angle = from + (to - from) * i / (count + 1), reach = between(random, 15, 150);
    const Place p{eye.x + static_cast<int>(reach * std::cos(angle)), eye.y + static_cast<int>(reach * std::sin(angle))};
    if (p.y > 2) patch.push_back(p);
  }
  return patch;
}

bool isSimple(const std::vector<Place>& polygon) {
  const size_t n = polygon.size();
  for (size_t i = 0; i < n; ++i) {
    for (size_t j = i + 1; j < n; ++j) {
      const Place &a = polygon[i], &b = polygon[(i + 1) % n], &c = polygon[j], &d = polygon[(j + 1) % n];
      if ((i + 1) % n == j || (j + 1) % n == i) {
        const Place &end = (i + 1) % n == j ? a : c, &middle = (i + 1) % n == j ? b : d,
                    &other = (i + 1) % n == j ? d : b;
        if (cross(end, middle, other) == 0) return false;
        continue;
      }
      const auto sign = [](int64_t v) { return v > 0 ? 1 : v < 0 ? -1 : 0; };
      if (sign(cross(a, b, c)) * sign(cross(a, b, d)) <= 0 && sign(cross(c, d, a)) * sign(cross(c, d, b)) <= 0)
        return false;
    }
  }
  return true;
}

/// Two patches that meet at a crease roughly along x: the first in the plane of x and y, the second roughly in that of
/// x and z.
struct TwoPatches {
  FanPoint centre;
  std::vector<FanPoint> ring;
  std::array<int64_t, 2> areas{};  ///< twice the area of each patch
  bool is_simple = false;

  explicit TwoPatches(std::mt19937& random) {
    const int left = -between(random, 40, 120), right = between(random, 40, 120);
    // The fan's centre lies off the line between the two face vertices, or on it.
    const Place middle{between(random, left + 10, right - 10), random() % 2 == 0 ? 0 : -between(random, 1, 9)};
    centre = {{middle.x, middle.y, 0}, kCellVertices, true};
    const FanPoint first{{right, 0, 0}, kFaceVertices, true}, second{{left, 0, 0}, kFaceVertices + 1, true};
    const std::vector<Place> upper = randomPatch(random, left, right), lower = randomPatch(random, left, right);
    ring.push_back(first);
    uint32_t name = 0;
    for (const Place& p : upper) ring.push_back({{p.x, p.y, 0}, name++});
    ring.push_back(second);
    for (auto p = lower.rbegin(); p != lower.rend(); ++p) ring.push_back({{p->x, 0, p->y}, name++});
    is_simple = !upper.empty() && !lower.empty();
    for (const std::vector<Place>* patch : {&upper, &lower}) {
      std::vector<Place> polygon{{right, 0}};
      polygon.insert(polygon.end(), patch->begin(), patch->end());
      polygon.push_back({left, 0});
      if (patch == &upper && middle.y != 0) polygon.push_back(middle);
      is_simple = is_simple && isSimple(polygon);
      int64_t area = 0;
      for (size_t i = 0; i < polygon.size(); ++i) {
        const Place &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
        area += int64_t{a.x} * b.y - int64_t{a.y} * b.x;
      }
      areas[patch == &lower] = area;
    }
  }
};

bool isOfFirst(const NamedTriangle& t) {
  return std::all_of(t.at.begin(), t.at.end(), [](const Int3& p) { return p.z == 0; });
}

}  // namespace

TEST_CASE("patches of a fan are covered once, whatever the centre sees of them", "[mesh][sharpen]") {
  size_t seen = 0, whole_fans = 0, joined = 0;
  for (unsigned seed = 1; seed <= rounds(20000); ++seed) {
    std::mt19937 random(seed);
    const TwoPatches patches(random);
    if (!patches.is_simple) continue;
    CAPTURE(seed);
    const LoopTriangles fan =
        patchTriangles(patches.centre, patches.ring, true, [](uint32_t, uint32_t) { return true; });
    REQUIRE(fan.count() == patches.ring.size());
    // Each side of the ring must occur in one direction, every other edge in both directions, and no directed edge
    // twice.
    std::map<std::pair<uint32_t, uint32_t>, int> edges;
    std::array<int64_t, 2> areas{};
    bool all_forward = true;
    for (const NamedTriangle& t : fan.all()) {
      for (size_t k = 0; k < 3; ++k) ++edges[{t.name[k], t.name[(k + 1) % 3]}];
      const bool is_first = isOfFirst(t);
      const auto flat = [&](const Int3& p) { return Place{p.x, is_first ? p.y : p.z}; };
      const int64_t area = cross(flat(t.at[0]), flat(t.at[1]), flat(t.at[2])) * (is_first ? 1 : -1);
      if (is_first || patches.centre.at.y == 0) all_forward = all_forward && area > 0;
      areas[is_first ? 0 : 1] += area;
    }
    for (const auto& [edge, count] : edges) CHECK(count == 1);
    for (size_t i = 0; i < patches.ring.size(); ++i) {
      const uint32_t a = patches.ring[i].name, b = patches.ring[(i + 1) % patches.ring.size()].name;
      CHECK(edges.contains({a, b}));
      CHECK_FALSE(edges.contains({b, a}));
    }
    CHECK(areas == patches.areas);
    ++seen;
    const bool is_fan = std::all_of(fan.all().begin(), fan.all().end(),
                                    [&](const NamedTriangle& t) { return t.name[0] == patches.centre.name; });
    whole_fans += is_fan;
    joined += edges.contains({kFaceVertices, kFaceVertices + 1}) || edges.contains({kFaceVertices + 1, kFaceVertices});
    // A planar polygon always has a triangulation; if both patches need the diagonal between the face vertices, one of
    // them is triangulated without it.
    if (!all_forward) CHECK(edges.contains({kFaceVertices, kFaceVertices + 1}));
  }
  CHECK(seen * 10 > rounds(20000));
  CHECK(whole_fans * 10 > seen);
  CHECK(whole_fans < seen);
  CHECK(joined > 0);
}

TEST_CASE("diagonals that are not free are not taken", "[mesh][sharpen]") {
  size_t others = 0;
  for (unsigned seed = 1; seed <= rounds(5000); ++seed) {
    std::mt19937 random(seed);
    const TwoPatches patches(random);
    if (!patches.is_simple) continue;
    CAPTURE(seed);
    const auto isFree = [&](uint32_t a, uint32_t b) {
      return a >= kCellVertices || b >= kCellVertices || ((std::min(a, b) * 31 + std::max(a, b) + seed) % 3) != 0;
    };
    const LoopTriangles fan = patchTriangles(patches.centre, patches.ring, true, isFree);
    for (const NamedTriangle& t : fan.all()) {
      for (size_t k = 0; k < 3; ++k) {
        const uint32_t a = t.name[k], b = t.name[(k + 1) % 3];
        const auto at = [&](uint32_t name) {
          return std::find_if(patches.ring.begin(), patches.ring.end(),
                              [&](const FanPoint& p) { return p.name == name; }) -
                 patches.ring.begin();
        };
        if (a >= kCellVertices || b >= kCellVertices) continue;
        const auto apart = std::abs(at(a) - at(b)), count = static_cast<std::ptrdiff_t>(patches.ring.size());
        if (apart == 1 || apart == count - 1) continue;
        CHECK(isFree(a, b));
        ++others;
      }
    }
    // If the centre is itself a point of the ring, its spokes are diagonals, which the last argument allows or forbids.
    const FanPoint centre = patches.ring.front();
    const std::vector<FanPoint> rest(patches.ring.begin() + 1, patches.ring.end());
    const LoopTriangles none = patchTriangles(centre, rest, false, [](uint32_t, uint32_t) { return false; });
    // With no diagonal allowed, only patches of three corners can be triangulated.
    size_t corners = 1, most = 0;
    for (const FanPoint& point : rest) {
      most = std::max(most, ++corners);
      if (point.is_feature) corners = 2;
    }
    CHECK((none.count() == 0) == (most > 3));
  }
  CHECK(others > 0);
}

TEST_CASE("strips between two creases are covered once, with the creases for edges", "[mesh][sharpen]") {
  // A floor with two walls, on its edges x = left and x = right. The ring runs along one wall, along an end of the
  // floor, along the other wall, and along the other end of the floor.
  size_t seen = 0;
  for (unsigned seed = 1; seed <= rounds(3000); ++seed) {
    std::mt19937 random(seed);
    CAPTURE(seed);
    const int left = -between(random, 20, 100), right = between(random, 20, 100), depth = between(random, 60, 200);
    std::vector<FanPoint> ring;
    uint32_t name = 0;
    const auto addWall = [&](int x, int from, int to) {
      const int count = between(random, 1, 3);
      for (int i = 1; i <= count; ++i)
        ring.push_back({{x, from + (to - from) * i / (count + 1), between(random, 20, 90)}, name++});
    };
    const auto addEnd = [&](int from, int to, int y) {
      const int count = between(random, 1, 3);
      for (int i = 1; i <= count; ++i)
        ring.push_back(
            {{from + (to - from) * i / (count + 1), y + (y == 0 ? -1 : 1) * between(random, 5, 40), 0}, name++});
    };
    ring.push_back({{right, 0, 0}, kFaceVertices, true});
    addWall(right, 0, depth);
    ring.push_back({{right, depth, 0}, kFaceVertices + 1, true});
    addEnd(right, left, depth);
    ring.push_back({{left, depth, 0}, kFaceVertices + 2, true});
    addWall(left, depth, 0);
    ring.push_back({{left, 0, 0}, kFaceVertices + 3, true});
    addEnd(left, right, 0);
    const auto start = static_cast<std::ptrdiff_t>(random() % ring.size());
    std::rotate(ring.begin(), ring.begin() + start, ring.end());
    // If `from_second`, the patches that are cut off begin at the second face vertex of the ring, otherwise at the
    // first one. The value is chosen so that the walls are cut off, and not the floor.
    const auto first = std::find_if(ring.begin(), ring.end(), [](const FanPoint& p) { return p.is_feature; });
    const bool from_second = first->name % 2 != 0;
    const auto isFree = [](uint32_t, uint32_t) { return true; };
    const LoopTriangles strip = stripTriangles(ring, from_second, isFree);
    // A wall whose top is not convex may have no triangulation whose triangles all face the same way. Then no triangles
    // are returned.
    if (strip.count() == 0) continue;
    ++seen;
    REQUIRE(strip.count() == ring.size() - 2);
    std::map<std::pair<uint32_t, uint32_t>, int> edges;
    for (const NamedTriangle& t : strip.all()) {
      for (size_t k = 0; k < 3; ++k) ++edges[{t.name[k], t.name[(k + 1) % 3]}];
      const auto all = [&](const auto& is) { return std::all_of(t.at.begin(), t.at.end(), is); };
      const bool is_flat = all([](const Int3& p) { return p.z == 0; }) ||
                           all([&](const Int3& p) { return p.x == left; }) ||
                           all([&](const Int3& p) { return p.x == right; });
      CHECK(is_flat);
    }
    for (const auto& [edge, count] : edges) CHECK(count == 1);
    for (const uint32_t f : {0U, 2U}) {
      CHECK(edges.contains({kFaceVertices + f, kFaceVertices + f + 1}));
      CHECK(edges.contains({kFaceVertices + f + 1, kFaceVertices + f}));
    }
    CHECK(stripTriangles(ring, from_second, [](uint32_t, uint32_t) { return false; }).count() == 0);
  }
  CHECK(seen * 2 > rounds(3000));
}

TEST_CASE("a ring needs an even number of face vertices to be a strip", "[mesh][sharpen]") {
  const auto isFree = [](uint32_t, uint32_t) { return true; };
  std::vector<FanPoint> ring{{{0, 0, 0}, 0}, {{100, 0, 0}, 1}, {{100, 100, 0}, 2}, {{0, 100, 0}, 3}};
  CHECK(stripTriangles(ring, false, isFree).count() == 0);
  ring.insert(ring.begin() + 1, {{50, 0, 0}, kFaceVertices, true});
  CHECK(stripTriangles(ring, false, isFree).count() == 0);
}
