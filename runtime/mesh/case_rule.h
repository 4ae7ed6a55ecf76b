#pragma once
// The common rule of marching cubes and seam cells, for any closed cell. It runs at build time (generate_tables.cpp)
// and in tests; the runtime reads the generated tables (tables.h).
//
// The rule. On every face of a cell, walk the corners counter-clockwise as seen from outside. One directed segment cuts
// off each maximal run of solid corners, from the edge where the walk enters the run to the edge where it leaves it.
// The segments of a cell form loops, counter-clockwise as seen from the void. Since the rule depends only on the face's
// own signs, two cells that share a face produce the same segments, reversed.
//
// Canonical order. A loop starts at its edge of lowest number; the loops of a case are sorted by their first edges.

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>
#include <vector>

namespace sgm {

/// A closed polyhedral cell. Faces list their corners counter-clockwise as seen from outside; edges are corner pairs.
struct Cell {
  int corners = 0;
  std::vector<std::array<int, 2>> edges;
  std::vector<std::vector<int>> faces;

  int edgeBetween(int a, int b) const {
    const auto at = std::find_if(edges.begin(), edges.end(), [&](const std::array<int, 2>& e) {
      return (e[0] == a && e[1] == b) || (e[0] == b && e[1] == a);
    });
    return static_cast<int>(at - edges.begin());
  }

  /// Returns the faces that contain edge e, as a mask: bit f for face f. A triangulation may have a diagonal between
  /// two edges only if no face contains both, that is, if their masks are disjoint.
  uint32_t facesOfEdge(int e) const {
    uint32_t mask = 0;
    for (size_t f = 0; f < faces.size(); ++f) {
      const std::vector<int>& face = faces[f];
      for (size_t i = 0; i < face.size(); ++i)
        if (edgeBetween(face[i], face[(i + 1) % face.size()]) == e) mask |= 1u << f;
    }
    return mask;
  }
};

/// Corners, edges and faces of a cube, numbered as in tables.h.
inline Cell cubeCell() {
  Cell cell{8, {}, {}};
  for (int axis = 0; axis < 3; ++axis) {
    const int first = axis == 0 ? 1 : 0, second = axis == 2 ? 1 : 2;
    for (int i = 0; i < 4; ++i) {
      const int low = (i & 1) << first | (i >> 1) << second;
      cell.edges.push_back({low, low | 1 << axis});
    }
  }
  for (int axis = 0; axis < 3; ++axis) {
    const int u = 1 << (axis + 1) % 3, v = 1 << (axis + 2) % 3, w = 1 << axis;
    cell.faces.push_back({0, v, u | v, u});
    cell.faces.push_back({w, u | w, u | v | w, v | w});
  }
  return cell;
}

/// The seam cell over the high face of a fine chunk (the coarse chunk lies beyond), numbered as in tables.h.
inline Cell seamCell() {
  const auto fine = [](int a, int b) { return a + 3 * b; };
  const auto coarse = [](int a, int b) { return 9 + a + 2 * b; };
  Cell cell{13, {}, {}};
  for (int b = 0; b < 3; ++b)
    for (int a = 0; a < 2; ++a) cell.edges.push_back({fine(a, b), fine(a + 1, b)});
  for (int b = 0; b < 2; ++b)
    for (int a = 0; a < 3; ++a) cell.edges.push_back({fine(a, b), fine(a, b + 1)});
  for (int b = 0; b < 2; ++b) cell.edges.push_back({coarse(0, b), coarse(1, b)});
  for (int a = 0; a < 2; ++a) cell.edges.push_back({coarse(a, 0), coarse(a, 1)});
  for (int b = 0; b < 2; ++b)
    for (int a = 0; a < 2; ++a) cell.edges.push_back({fine(2 * a, 2 * b), coarse(a, b)});

  for (int b = 0; b < 2; ++b)
    for (int a = 0; a < 2; ++a) cell.faces.push_back({fine(a, b), fine(a, b + 1), fine(a + 1, b + 1), fine(a + 1, b)});
  cell.faces.push_back({coarse(0, 0), coarse(1, 0), coarse(1, 1), coarse(0, 1)});
  constexpr std::array<std::array<int, 2>, 4> ring{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
  for (size_t i = 0; i < 4; ++i) {
    const auto [a0, b0] = ring[i];
    const auto [a1, b1] = ring[(i + 1) % 4];
    cell.faces.push_back(
        {fine(2 * a0, 2 * b0), fine(a0 + a1, b0 + b1), fine(2 * a1, 2 * b1), coarse(a1, b1), coarse(a0, b0)});
  }
  return cell;
}

/// Returns the loops of one case, each as a list of edge numbers. Bit c of solid: corner c is solid.
inline std::vector<std::vector<int>> loopsOfCase(const Cell& cell, uint32_t solid) {
  std::vector<int> follow(cell.edges.size(), -1);
  for (const std::vector<int>& face : cell.faces) {
    const size_t n = face.size();
    const auto isSolid = [&](size_t i) { return (solid >> face[i % n] & 1) != 0; };
    for (size_t enter = 0; enter < n; ++enter) {
      if (isSolid(enter) || !isSolid(enter + 1)) continue;
      size_t leave = enter + 1;
      while (isSolid(leave + 1)) ++leave;
      const int from = cell.edgeBetween(face[enter], face[(enter + 1) % n]);
      follow[static_cast<size_t>(from)] = cell.edgeBetween(face[leave % n], face[(leave + 1) % n]);
    }
  }
  std::vector<std::vector<int>> loops;
  for (size_t start = 0; start < follow.size(); ++start) {
    if (follow[start] < 0) continue;
    std::vector<int>& loop = loops.emplace_back();
    for (size_t at = start; follow[at] >= 0;) {
      loop.push_back(static_cast<int>(at));
      at = static_cast<size_t>(std::exchange(follow[at], -1));
    }
  }
  return loops;
}

}  // namespace sgm
