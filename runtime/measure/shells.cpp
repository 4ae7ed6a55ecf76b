#include "measure/shells.h"

#include <algorithm>

#include "measure/area_volume.h"
#include "measure/union_find.h"

namespace sgm::measure {
namespace {

/// Returns the corner, in the half edge's triangle, that lies at `vertex`, one of the half edge's two ends.
uint32_t cornerAt(std::span<const Triangle> triangles, HalfEdge half, uint32_t vertex) {
  return beginOf(triangles, half) == vertex ? half : nextHalf(half);
}

uint64_t objectsOf(const Triangles& mesh) {
  UnionFind vertices(mesh.points.size(), mesh.memory);
  LargeVector<uint8_t> used(mesh.points.size(), mesh.memory);
  for (const Triangle& t : mesh.triangles) {
    for (const uint32_t v : t) used[v] = true;
    vertices.join(t[0], t[1]);
    vertices.join(t[0], t[2]);
  }
  uint64_t objects = 0;
  for (uint32_t v = 0; v < used.size(); ++v) objects += used[v] && vertices.rootOf(v) == v;
  return objects;
}

}  // namespace

std::optional<uint64_t> Shell::genus() const {
  if (!manifold) return std::nullopt;
  // For a connected, oriented surface, the Euler characteristic V - E + F is 2 - 2 genus - borders.
  return static_cast<uint64_t>(2 - static_cast<int64_t>(borders) - euler()) / 2;
}

Shells shellsOf(const Triangles& mesh, const Edges& edges, Point centre) {
  const std::span<const Triangle> triangles = mesh.triangles;
  UnionFind parts(triangles.size(), mesh.memory), fans(3 * triangles.size(), mesh.memory);
  for (size_t e = 0; e < edges.count(); ++e) {
    const std::span<const HalfEdge> around = edges.around(e);
    const uint32_t a = beginOf(triangles, around[0]), b = endOf(triangles, around[0]);
    for (const HalfEdge half : around.subspan(1)) {
      parts.join(around[0] / 3, half / 3);
      for (const uint32_t end : {a, b}) fans.join(cornerAt(triangles, around[0], end), cornerAt(triangles, half, end));
    }
  }

  Shells result;
  result.objects = objectsOf(mesh);
  result.of_triangle = LargeVector<uint32_t>(triangles.size(), kNoShell, mesh.memory);
  LargeVector<uint32_t>& number = result.of_triangle;
  // Triangles with a repeated corner have no edges, and so are not connected to others here.
  const auto degenerate = [&](const Triangle& t) { return t[0] == t[1] || t[1] == t[2] || t[2] == t[0]; };
  for (uint32_t i = 0; i < triangles.size(); ++i) {
    if (degenerate(triangles[i])) continue;
    const uint32_t root = parts.rootOf(i);
    if (root == i) {
      number[i] = static_cast<uint32_t>(result.shells.size());
      result.shells.push_back({.first = i});
    }
    number[i] = number[root];
    Shell& shell = result.shells[number[i]];
    const Point a = mesh.points[triangles[i][0]] - centre, b = mesh.points[triangles[i][1]] - centre,
                c = mesh.points[triangles[i][2]] - centre;
    const Point cross = crossOf(a, b, c);
    ++shell.triangles;
    shell.area += 0.5 * length(cross);
    shell.volume += dot(a, cross) / 6;
  }

  LargeVector<HalfEdge> border_halves(mesh.memory);
  for (size_t e = 0; e < edges.count(); ++e) {
    const std::span<const HalfEdge> around = edges.around(e);
    Shell& shell = result.shells[number[around[0] / 3]];
    ++shell.edges;
    if (around.size() == 1) {
      ++shell.border_edges;
      border_halves.push_back(around[0]);
    } else if (around.size() > 2 || beginOf(triangles, around[0]) == beginOf(triangles, around[1])) {
      shell.manifold = false;
    }
  }
  // A mesh without a border, the usual case, needs no memory here.
  const size_t border_fans = border_halves.empty() ? 0 : fans.size();
  UnionFind borders(border_fans, mesh.memory);
  for (const HalfEdge half : border_halves) borders.join(fans.rootOf(half), fans.rootOf(nextHalf(half)));
  LargeVector<uint8_t> seen(border_fans, mesh.memory);
  for (const HalfEdge half : border_halves) {
    const uint32_t root = borders.rootOf(fans.rootOf(half));
    if (!seen[root]) ++result.shells[number[half / 3]].borders;
    seen[root] = true;
  }
  LargeVector<uint32_t> fan_at(mesh.points.size(), kNoShell, mesh.memory);
  for (uint32_t corner = 0; corner < fans.size(); ++corner) {
    if (number[corner / 3] == kNoShell || fans.rootOf(corner) != corner) continue;
    Shell& shell = result.shells[number[corner / 3]];
    ++shell.vertices;
    uint32_t& other = fan_at[beginOf(triangles, corner)];
    if (other == kNoShell) {
      other = corner;
    } else {
      shell.manifold = false;
      result.shells[number[other / 3]].manifold = false;
      if (result.pinched.size() < kMaxExamples) result.pinched.emplace_back(beginOf(triangles, corner), corner / 3);
    }
  }

  std::vector<uint32_t> order(result.shells.size()), rank(result.shells.size());
  std::iota(order.begin(), order.end(), 0u);
  std::stable_sort(order.begin(), order.end(),
                   [&](uint32_t a, uint32_t b) { return result.shells[a].triangles > result.shells[b].triangles; });
  std::vector<Shell> sorted(order.size());
  for (uint32_t i = 0; i < order.size(); ++i) {
    sorted[i] = result.shells[order[i]];
    rank[order[i]] = i;
  }
  result.shells = std::move(sorted);
  for (uint32_t& n : number)
    if (n != kNoShell) n = rank[n];
  return result;
}

}  // namespace sgm::measure
