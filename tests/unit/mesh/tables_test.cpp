// Tests the generated tables and the triangulation of loops, for every case.

#include <map>
#include <set>

#include "catch.h"
#include "fields.h"
#include "mesh/case_rule.h"
#include "mesh/triangulate.h"

using namespace sgm;

namespace {

/// A table, and the kind of cell for which it was generated.
struct Table {
  const char* name;
  Cell cell;
  std::function<std::vector<std::vector<int>>(uint32_t)> loops;
  std::function<int(uint32_t)> triangles;
  const uint16_t* edge_faces;
  bool flat;

  /// Triangulates a loop as the runtime does.
  uint32_t* triangulate(const std::vector<LoopPoint>& points, uint32_t* out) const {
    const auto n = static_cast<int>(points.size());
    if (flat) return triangulateFlatLoop(points.data(), n, out);
    return triangulateLoop(n, out, [&](size_t i, int) { return points[i]; });
  }
};

template <class Start>
std::vector<std::vector<int>> decode(const uint8_t* bytes, const Start* start, uint32_t solid) {
  std::vector<std::vector<int>> loops;
  for (size_t i = start[solid]; i < start[solid + 1];) {
    const size_t n = bytes[i++];
    loops.emplace_back(bytes + i, bytes + i + n);
    i += n;
  }
  return loops;
}

std::vector<Table> tables() {
  return {{"cube", cubeCell(), [](uint32_t s) { return decode(kCubeLoops, kCubeLoopStart, s); },
           [](uint32_t s) { return int{kCubeTriangles[s]}; }, kCubeEdgeFaces, false},
          {"seam cell", seamCell(), [](uint32_t s) { return decode(kSeamLoops, kSeamLoopStart, s); },
           [](uint32_t s) { return int{kSeamTriangles[s]}; }, kSeamEdgeFaces, true}};
}

bool crossed(const Cell& cell, int edge, uint32_t solid) {
  const auto [a, b] = cell.edges[static_cast<size_t>(edge)];
  return ((solid >> a ^ solid >> b) & 1) != 0;
}

/// Gives the points of a loop random positions: coordinates from 0 to 511, as in the cell of a seam, which is two cells
/// wide.
std::vector<LoopPoint> randomPoints(const std::vector<int>& loop, const uint16_t* edge_faces, uint64_t seed) {
  std::vector<LoopPoint> points;
  for (size_t i = 0; i < loop.size(); ++i) {
    const uint64_t h = hashCombine(seed, i);
    const auto coordinate = [&](int shift) { return static_cast<int32_t>(h >> shift & 511); };
    points.push_back({coordinate(0), coordinate(16), coordinate(32), edge_faces[loop[i]], static_cast<uint32_t>(i)});
  }
  return points;
}

/// Considers all allowed triangulations of the points i..j of a loop. Compares them by the area of their smallest
/// triangle; returns the largest such area, or -1 if no triangulation is allowed.
int32_t bestByTrying(const std::vector<LoopPoint>& p, size_t i, size_t j) {
  if (j - i < 2) return std::numeric_limits<int32_t>::max();
  const bool outer = i == 0 && j + 1 == p.size();
  if (!outer && (p[i].faces & p[j].faces) != 0) return -1;
  int32_t best = -1;
  for (size_t k = i + 1; k < j; ++k) {
    best = std::max(best, std::min({triangleMeasure(p[i], p[k], p[j]), bestByTrying(p, i, k), bestByTrying(p, k, j)}));
  }
  return best;
}

}  // namespace

TEST_CASE("every case closes into simple loops of its crossed edges", "[mesh][tables]") {
  const std::map<std::string, size_t> expected{{"cube", 358}, {"seam cell", 16412}};
  for (const Table& table : tables()) {
    size_t count = 0, bad = 0;
    for (uint32_t solid = 0; solid < 1u << table.cell.corners; ++solid) {
      std::set<int> used;
      size_t edges_in_loops = 0;
      int triangles = 0, last_first = -1;
      for (const std::vector<int>& loop : table.loops(solid)) {
        ++count;
        triangles += static_cast<int>(loop.size()) - 2;
        edges_in_loops += loop.size();
        used.insert(loop.begin(), loop.end());
        bad += loop.size() < 3 || loop.size() > static_cast<size_t>(kLongestLoop);
        bad += loop[0] != *std::min_element(loop.begin(), loop.end()) || loop[0] <= last_first;
        last_first = loop[0];
        for (size_t i = 0; i < loop.size(); ++i)
          bad += (table.edge_faces[loop[i]] & table.edge_faces[loop[(i + 1) % loop.size()]]) == 0;
      }
      size_t crossed_edges = 0;
      for (size_t e = 0; e < table.cell.edges.size(); ++e)
        crossed_edges += crossed(table.cell, static_cast<int>(e), solid);
      for (int e : used) bad += !crossed(table.cell, e, solid);
      bad += used.size() != edges_in_loops || used.size() != crossed_edges || triangles != table.triangles(solid);
    }
    INFO(table.name);
    CHECK(bad == 0);
    CHECK(count == expected.at(table.name));
  }
}

TEST_CASE("each face is crossed once in each direction by its two sides", "[mesh][tables]") {
  // The segments in which a cell's loops cross a face depend only on the signs of that face's corners.
  for (const Table& table : tables()) {
    std::map<std::pair<size_t, uint32_t>, std::set<std::pair<int, int>>> segments_of_face;
    size_t differing = 0;
    for (uint32_t solid = 0; solid < 1u << table.cell.corners; ++solid) {
      std::vector<std::set<std::pair<int, int>>> segments(table.cell.faces.size());
      for (const std::vector<int>& loop : table.loops(solid)) {
        for (size_t i = 0; i < loop.size(); ++i) {
          const int a = loop[i], b = loop[(i + 1) % loop.size()];
          const unsigned common = table.edge_faces[a] & table.edge_faces[b];
          for (size_t f = 0; f < segments.size(); ++f)
            if (common == 1u << f) segments[f].insert({a, b});
        }
      }
      for (size_t f = 0; f < segments.size(); ++f) {
        uint32_t signs = 0;
        for (int corner : table.cell.faces[f]) signs = signs << 1 | (solid >> corner & 1);
        const auto [at, is_new] = segments_of_face.try_emplace({f, signs}, segments[f]);
        differing += at->second != segments[f];
      }
    }
    INFO(table.name);
    CHECK(differing == 0);
  }
}

TEST_CASE("every loop is triangulated without a diagonal in a face", "[mesh][tables]") {
  for (const Table& table : tables()) {
    size_t bad = 0;
    for (uint32_t solid = 0; solid < 1u << table.cell.corners; ++solid) {
      for (const std::vector<int>& loop : table.loops(solid)) {
        const std::vector<LoopPoint> points = randomPoints(loop, table.edge_faces, solid);
        const size_t n = loop.size();
        std::vector<uint32_t> out(3 * (n - 2) + 1, 99);
        const uint32_t* end = table.triangulate(points, out.data());
        bad += end != out.data() + 3 * (n - 2) || out.back() != 99;
        // Directed edges of the triangles: every side of the loop must occur once; every diagonal must occur once in
        // each direction, and must not lie in a face of the cell.
        std::map<std::pair<uint32_t, uint32_t>, int> sides;
        for (size_t t = 0; t + 3 < out.size(); t += 3)
          for (size_t i = 0; i < 3; ++i) ++sides[{out[t + i], out[t + (i + 1) % 3]}];
        for (const auto& [side, times] : sides) {
          const auto [a, b] = side;
          const bool in_loop = (a + 1) % n == b;
          bad += a == b || times != 1;
          bad += !in_loop && (sides.count({b, a}) != 1 || (points[a].faces & points[b].faces) != 0);
          bad += in_loop && sides.count({b, a}) != 0;
        }
        bad += sides.size() != 3 * (n - 2);
      }
    }
    INFO(table.name);
    CHECK(bad == 0);
  }
}

TEST_CASE("the chosen triangulation has the largest smallest triangle", "[mesh][tables]") {
  size_t loops = 0, bad = 0, differing = 0;
  for (const Table& table : tables()) {
    for (uint32_t solid = 0; solid < 1u << table.cell.corners; ++solid) {
      for (const std::vector<int>& loop : table.loops(solid)) {
        // Trying all triangulations of long loops is slow, so only a few of them are tested.
        if (loop.size() > 9 || (loop.size() > 7 && solid % 16 != 0)) continue;
        const std::vector<LoopPoint> points = randomPoints(loop, table.edge_faces, solid + 77);
        const auto n = static_cast<int>(loop.size());
        std::vector<uint32_t> quick(3 * (loop.size() - 2)), any(quick.size());
        triangulateAnyLoop(points.data(), n, any.data());
        if (!table.flat) {
          table.triangulate(points, quick.data());
          differing += quick != any;
        }
        int32_t smallest = std::numeric_limits<int32_t>::max();
        for (size_t t = 0; t < any.size(); t += 3)
          smallest = std::min(smallest, triangleMeasure(points[any[t]], points[any[t + 1]], points[any[t + 2]]));
        bad += smallest != bestByTrying(points, 0, points.size() - 1);
        ++loops;
      }
    }
  }
  CHECK(bad == 0);
  CHECK(differing == 0);
  CHECK(loops > 10000);
}

TEST_CASE("equal choices are settled by the first apex", "[mesh][tables]") {
  // Tests a square, and six points at one place: all triangulations of each are equally good.
  const Table cube = tables()[0];
  const std::vector<LoopPoint> square{{0, 0, 0, 1, 0}, {8, 0, 0, 2, 1}, {8, 8, 0, 4, 2}, {0, 8, 0, 8, 3}};
  std::vector<uint32_t> out(6);
  cube.triangulate(square, out.data());
  CHECK(out == std::vector<uint32_t>{0, 1, 3, 1, 2, 3});
  std::vector<LoopPoint> flat(6, LoopPoint{5, 5, 5, 0, 0});
  for (uint32_t i = 0; i < 6; ++i) flat[i].vertex = i;
  out.resize(12);
  cube.triangulate(flat, out.data());
  CHECK(out == std::vector<uint32_t>{0, 1, 5, 1, 2, 5, 2, 3, 5, 3, 4, 5});
}
