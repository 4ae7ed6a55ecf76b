// Proves that no cell of marching cubes intersects itself, wherever the surface crosses its edges.
//
// A vertex lies at the parameter t of its edge, 1 <= t <= 255. The orientation of four vertices is a polynomial that is
// linear in each t, so over a box of parameters its extremes lie at the box's corners: if the signs at all corners are
// equal, the sign is the same in the whole box. Such signs prove that a pair of triangles is disjoint in a box;
// otherwise the box is halved.

#include <algorithm>
#include <array>
#include <random>
#include <set>

#include "catch.h"
#include "mesh/case_rule.h"
#include "mesh/chunk.h"
#include "mesh/triangulate.h"
#include "rounds.h"
#include "seed.h"

using namespace sgm;

namespace {

using Vector = std::array<int64_t, 3>;
using Corners = std::array<int, 3>;  ///< numbers of the cube's edges on which the corners of a triangle lie

constexpr int kLeast = 1, kMost = 255;

Vector minus(const Vector& a, const Vector& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
Vector cross(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
int64_t dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/// Number of points through which planes are laid: the vertices on the edges 0 to 11, followed by the cube's corners.
constexpr int kPlaces = kCubeEdges + 8;

Vector placeAt(int edge, int t) {
  if (edge >= kCubeEdges) {
    const int64_t corner = edge - kCubeEdges;
    return {(corner & 1) * kSubcell, (corner >> 1 & 1) * kSubcell, (corner >> 2) * kSubcell};
  }
  const int axis = edge / 4;
  Vector at{};
  at[axis == 0 ? 1 : 0] = (edge & 1) * kSubcell;
  at[axis == 2 ? 1 : 2] = (edge >> 1 & 1) * kSubcell;
  at[static_cast<size_t>(axis)] = t;
  return at;
}

/// A box of parameters: for each edge of the cube, a range of the vertex's position t along this edge. (The last
/// entries stand for the cube's corners, for which t has no effect.)
struct Box {
  std::array<int, kPlaces> lo, hi;
  Box() { lo.fill(kLeast), hi.fill(kMost); }
};

/// The sign of a multilinear function of the vertices on `edges`, if it is the same at all corners of a box; 0 if signs
/// differ or a value is 0.
template <size_t N, class Function>
int signIn(const Box& box, const std::array<int, N>& edges, const Function& value) {
  int sign = 0;
  for (unsigned corner = 0; corner < 1u << N; ++corner) {
    std::array<Vector, N> at;
    for (size_t i = 0; i < N; ++i) {
      const auto e = static_cast<size_t>(edges[i]);
      at[i] = placeAt(edges[i], corner >> i & 1 ? box.hi[e] : box.lo[e]);
    }
    const int64_t here = value(at);
    const int own = here > 0 ? 1 : here < 0 ? -1 : 0;
    if (own == 0 || (sign != 0 && own != sign)) return 0;
    sign = own;
  }
  return sign;
}

int orientationIn(const Box& box, int a, int b, int c, int d) {
  return signIn(box, std::array<int, 4>{a, b, c, d}, [](const std::array<Vector, 4>& p) {
    return dot(cross(minus(p[1], p[0]), minus(p[2], p[0])), minus(p[3], p[0]));
  });
}

/// Whether the segment misses the triangle for all positions t of the vertices in the box.
bool segmentMisses(const Box& box, int from, int to, const Corners& t) {
  const int from_side = orientationIn(box, t[0], t[1], t[2], from), to_side = orientationIn(box, t[0], t[1], t[2], to);
  if (from_side * to_side > 0) return true;
  std::array<int, 3> turns;
  for (size_t k = 0; k < 3; ++k) turns[k] = orientationIn(box, from, to, t[k], t[(k + 1) % 3]);
  return turns[0] * turns[1] < 0 || turns[1] * turns[2] < 0 || turns[2] * turns[0] < 0;
}

/// Moves the common corners to the front, in the same order in both triangles; returns their number.
size_t alignCorners(Corners& a, Corners& b) {
  size_t common = 0;
  for (size_t i = 0; i < 3; ++i) {
    for (size_t j = common; j < 3; ++j) {
      if (a[i] != b[j]) continue;
      std::swap(b[common], b[j]);
      std::swap(a[common], a[i]);
      ++common;
      break;
    }
  }
  return common;
}

/// Whether two triangles with a common side do not fold onto each other for any t in the box. They fold if they lie in
/// one plane and on the same side of the common side: their normals, both computed along the common side, then point
/// the same way.
bool neverFolds(const Box& box, const Corners& a, const Corners& b) {
  if (orientationIn(box, a[0], a[1], a[2], b[2]) != 0) return true;
  for (size_t axis = 0; axis < 3; ++axis) {
    const auto turn = [&](int apex) {
      return signIn(box, std::array<int, 3>{a[0], a[1], apex}, [axis](const std::array<Vector, 3>& p) {
        return cross(minus(p[1], p[0]), minus(p[2], p[0]))[axis];
      });
    };
    if (turn(a[2]) * turn(b[2]) < 0) return true;
  }
  return false;
}

/// Whether the plane through three points separates the triangles: the corners of `a` lie on one side, the corners of
/// `b` on the other. The plane may contain their common corners, and further corners of at most one of the triangles.
bool separates(const Box& box, const Corners& plane, const Corners& a, const Corners& b) {
  const auto isInPlane = [&](int corner) { return std::find(plane.begin(), plane.end(), corner) != plane.end(); };
  const auto isShared = [&](int corner) { return std::find(b.begin(), b.end(), corner) != b.end(); };
  // If each triangle also has a corner of its own in the plane, the triangles may meet there.
  const bool a_touches = std::any_of(a.begin(), a.end(), [&](int c) { return isInPlane(c) && !isShared(c); });
  const bool b_touches = std::any_of(
      b.begin(), b.end(), [&](int c) { return isInPlane(c) && std::find(a.begin(), a.end(), c) == a.end(); });
  if (a_touches && b_touches) return false;
  int side = 0;
  for (const int sign : {1, -1}) {
    for (const int corner : sign > 0 ? a : b) {
      if (isInPlane(corner)) continue;
      const int own = sign * orientationIn(box, plane[0], plane[1], plane[2], corner);
      if (own == 0 || (side != 0 && own != side)) return false;
      side = own;
    }
  }
  return true;
}

/// Whether some plane separates the triangles. Tries the planes through any three points: corners of the triangles and
/// of the cell. If the triangles have one common corner, tries only planes through it.
bool anyPlaneSeparates(const Box& box, const Corners& a, const Corners& b, size_t common) {
  std::vector<int> places{a.begin(), a.end()};
  places.insert(places.end(), b.begin() + static_cast<std::ptrdiff_t>(common), b.end());
  for (int corner = kCubeEdges; corner < kPlaces; ++corner) places.push_back(corner);
  const size_t first_end = common == 1 ? 1 : places.size();
  for (size_t i = 0; i < first_end; ++i)
    for (size_t j = i + 1; j < places.size(); ++j)
      for (size_t k = j + 1; k < places.size(); ++k)
        if (separates(box, {places[i], places[j], places[k]}, a, b)) return true;
  return false;
}

bool apartIn(const Box& box, const Corners& a, const Corners& b, size_t common) {
  if (common == 2) return neverFolds(box, a, b);
  if (anyPlaneSeparates(box, a, b, common)) return true;
  if (common == 1) return segmentMisses(box, b[1], b[2], a) && segmentMisses(box, a[1], a[2], b);
  for (size_t k = 0; k < 3; ++k) {
    if (!segmentMisses(box, a[k], a[(k + 1) % 3], b) || !segmentMisses(box, b[k], b[(k + 1) % 3], a)) return false;
  }
  return true;
}

/// Whether two triangles of a cell meet only in their common corners, for all t. budget: number of boxes that may still
/// be examined; it is 0 at the end if no proof was found.
bool provenApart(const Box& box, const Corners& a, const Corners& b, size_t common, int& budget) {
  if (budget == 0) return false;
  --budget;
  if (apartIn(box, a, b, common)) return true;
  size_t widest = 0;
  int width = 0;
  for (const Corners& t : {a, b}) {
    for (const int edge : t) {
      const auto e = static_cast<size_t>(edge);
      if (box.hi[e] - box.lo[e] > width) width = box.hi[e] - box.lo[e], widest = e;
    }
  }
  if (width == 0) return false;
  Box low = box, high = box;
  const int middle = (box.lo[widest] + box.hi[widest]) / 2;
  low.hi[widest] = middle;
  high.lo[widest] = width == 1 ? box.hi[widest] : middle;
  return provenApart(low, a, b, common, budget) && provenApart(high, a, b, common, budget);
}

using Triangulation = std::vector<Corners>;

/// Returns all triangulations of the part i..j of a loop that use only those diagonals for which `allowed` returns
/// true.
template <class Allowed>
std::vector<Triangulation> triangulations(const std::vector<int>& loop, size_t i, size_t j, const Allowed& allowed) {
  if (j - i < 2) return {{}};
  std::vector<Triangulation> all;
  for (size_t k = i + 1; k < j; ++k) {
    if (!allowed(i, k) || !allowed(k, j)) continue;
    for (const Triangulation& left : triangulations(loop, i, k, allowed)) {
      for (const Triangulation& right : triangulations(loop, k, j, allowed)) {
        Triangulation& whole = all.emplace_back(Triangulation{{loop[i], loop[k], loop[j]}});
        whole.insert(whole.end(), left.begin(), left.end());
        whole.insert(whole.end(), right.begin(), right.end());
      }
    }
  }
  return all;
}

/// The triangulations from which the runtime chooses. all_chords: returns all triangulations without a diagonal in a
/// face of the cell.
std::vector<Triangulation> triangulationsOf(const std::vector<int>& loop, bool all_chords = false) {
  const auto n = static_cast<int>(loop.size());
  return triangulations(loop, 0, loop.size() - 1, [&](size_t i, size_t k) {
    const auto mask = [&](size_t at) {
      const auto e = static_cast<uint32_t>(loop[at]);
      return all_chords ? uint32_t{kCubeEdgeFaces[e]} : chordMask(kCubeEdgeFaces[e], e, n);
    };
    return k - i < 2 || (mask(i) & mask(k)) == 0;
  });
}

using Pair = std::pair<Corners, Corners>;

/// All pairs of triangles that occur together if a triangulation is chosen for each of a case's loops.
std::set<Pair> pairsOf(const std::vector<std::vector<int>>& loops) {
  std::set<Pair> pairs;
  std::vector<std::set<Corners>> triangles;
  for (const std::vector<int>& loop : loops) {
    std::set<Corners>& own = triangles.emplace_back();
    for (const Triangulation& t : triangulationsOf(loop)) {
      own.insert(t.begin(), t.end());
      for (size_t i = 0; i < t.size(); ++i)
        for (size_t j = i + 1; j < t.size(); ++j) pairs.insert(std::minmax(t[i], t[j]));
    }
  }
  for (size_t a = 0; a < loops.size(); ++a)
    for (size_t b = a + 1; b < loops.size(); ++b)
      for (const Corners& of_a : triangles[a])
        for (const Corners& of_b : triangles[b]) pairs.insert({of_a, of_b});
  return pairs;
}

constexpr int kBudget = 1000;

bool proven(const Pair& pair) {
  Corners a = pair.first, b = pair.second;
  const size_t common = alignCorners(a, b);
  int budget = kBudget;
  return provenApart(Box{}, a, b, common, budget);
}

}  // namespace

TEST_CASE("no triangulation that a cube's case may get cuts itself, for any places of its vertices", "[mesh][tables]") {
  const Cell cell = cubeCell();
  size_t pairs = 0, unproven = 0;
  std::set<Pair> known;
  for (uint32_t solid = 0; solid < 256; ++solid) {
    for (const Pair& pair : pairsOf(loopsOfCase(cell, solid))) {
      if (!known.insert(pair).second) continue;
      ++pairs;
      if (proven(pair)) continue;
      ++unproven;
      UNSCOPED_INFO("case " << solid);
    }
  }
  CHECK(unproven == 0);
  CHECK(pairs > 1000);
}

TEST_CASE("of a loop of seven, the triangulations that chordMask forbids are half, and hold all that can cut",
          "[mesh][tables][costly]") {
  const Cell cell = cubeCell();
  size_t loops = 0;
  for (uint32_t solid = 0; solid < 256; ++solid) {
    for (const std::vector<int>& loop : loopsOfCase(cell, solid)) {
      if (loop.size() != 7) continue;
      ++loops;
      const std::vector<Triangulation> all = triangulationsOf(loop, true);
      size_t can_cut = 0;
      for (const Triangulation& t : all) {
        bool cuts = false;
        for (size_t i = 0; i < t.size(); ++i)
          for (size_t j = i + 1; j < t.size(); ++j) cuts |= !proven({t[i], t[j]});
        can_cut += cuts;
      }
      CHECK(all.size() == 16);
      CHECK(triangulationsOf(loop).size() == 8);
      CHECK(can_cut == 4);
    }
  }
  CHECK(loops == 24);
}

TEST_CASE("seams overlap no more than their loops make them", "[mesh][tables]") {
  // A loop's triangles overlap in projection if their areas add up to more than the smallest total area of any
  // triangulation.
  const Cell cell = seamCell();
  const uint64_t seed = testSeed();
  CAPTURE(seed);
  std::mt19937_64 random(seed);
  const auto placeOn = [&](int edge, int t) -> std::array<int, 2> {
    const auto cornerPlace = [](int corner) -> std::array<int, 2> {
      if (corner < 9) return {corner % 3 * 256, corner / 3 * 256};
      return {(corner - 9) % 2 * 512, (corner - 9) / 2 * 512};
    };
    const auto [from, to] = cell.edges[static_cast<size_t>(edge)];
    const auto a = cornerPlace(from), b = cornerPlace(to);
    return {a[0] + (b[0] - a[0]) * t / 256, a[1] + (b[1] - a[1]) * t / 256};
  };
  size_t loops = 0, worse = 0, free_missed = 0, simple = 0;
  for (uint32_t solid = static_cast<uint32_t>(random() % 4); solid < 1u << 13; solid += 4) {
    for (const std::vector<int>& loop : loopsOfCase(cell, solid)) {
      if (loop.size() > 8) continue;  // trying all triangulations of longer loops is slow
      std::vector<LoopPoint> points;
      for (const int e : loop) {
        const auto at = placeOn(e, static_cast<int>(random() % 2 ? 1 + random() % 255 : random() % 2 ? 1 : 255));
        points.push_back({at[0], at[1], 0, kSeamEdgeFaces[e], static_cast<uint32_t>(points.size())});
      }
      const size_t n = loop.size();
      std::vector<uint32_t> chosen(3 * (n - 2));
      triangulateFlatLoop(points.data(), static_cast<int>(n), chosen.data());
      const auto areaOf = [&](size_t a, size_t b, size_t c) {
        return (points[b].x - points[a].x) * (points[c].y - points[a].y) -
               (points[b].y - points[a].y) * (points[c].x - points[a].x);
      };
      int total = 0, sum = 0;
      for (size_t t = 0; t < chosen.size(); t += 3) {
        const int area = areaOf(chosen[t], chosen[t + 1], chosen[t + 2]);
        total += std::abs(area);
        sum += area;
      }
      std::vector<int> order(n);
      for (size_t i = 0; i < n; ++i) order[i] = static_cast<int>(i);
      int least = std::numeric_limits<int>::max();
      for (const Triangulation& t : triangulations(order, 0, n - 1, [&](size_t i, size_t k) {
             return k - i < 2 || (points[i].faces & points[k].faces) == 0;
           })) {
        int own = 0;
        for (const Corners& c : t)
          own += std::abs(areaOf(static_cast<size_t>(c[0]), static_cast<size_t>(c[1]), static_cast<size_t>(c[2])));
        least = std::min(least, own);
      }
      ++loops;
      worse += total != least;
      simple += least == std::abs(sum);
      free_missed += least == std::abs(sum) && total != least;
    }
  }
  CHECK(worse == 0);
  CHECK(free_missed == 0);
  CHECK(simple > loops / 4);
  CHECK(loops > 1000);
}
