#include "measure/defect_places.h"

#include <algorithm>
#include <array>

#include "measure/area_volume.h"
#include "measure/triangle_pair.h"

namespace sgm::measure {
namespace {

constexpr std::array<std::string_view, 11> kNames{"open_edge",  "turned_edge", "nonmanifold_edge", "pinched_vertex",
                                                  "degenerate", "flat",        "duplicate",        "inside_out",
                                                  "nested",     "folded",      "self_intersection"};

/// True if the triangle may be flat. If this inexact test returns false, the exact one is not needed.
bool nearlyFlat(const Triangles& mesh, const Triangle& t) {
  const Point a = mesh.points[t[0]], b = mesh.points[t[1]], c = mesh.points[t[2]];
  const double longest = std::max({dot(b - a, b - a), dot(c - b, c - b), dot(a - c, a - c)});
  return !(length(crossOf(a, b, c)) > 1e-6 * longest);
}

class Places {
 public:
  explicit Places(const Triangles& mesh) : mesh_(mesh) {}

  bool full(DefectKind kind) const { return counts_[static_cast<size_t>(kind)] == kMaxExamples; }
  void add(DefectKind kind, uint32_t triangle, Point at) {
    if (full(kind)) return;
    ++counts_[static_cast<size_t>(kind)];
    found_.push_back({kind, triangle, at});
  }
  void addTriangle(DefectKind kind, uint32_t triangle) {
    const Triangle& t = mesh_.triangles[triangle];
    add(kind, triangle, (1.0 / 3) * (mesh_.points[t[0]] + mesh_.points[t[1]] + mesh_.points[t[2]]));
  }
  std::vector<DefectPlace> take() {
    std::stable_sort(found_.begin(), found_.end(),
                     [](const DefectPlace& a, const DefectPlace& b) { return a.kind < b.kind; });
    return std::move(found_);
  }

 private:
  const Triangles& mesh_;
  std::array<size_t, kNames.size()> counts_{};
  std::vector<DefectPlace> found_;
};

/// Returns the corner of the triangle opposite to the half edge.
uint32_t apexOf(std::span<const Triangle> triangles, HalfEdge half) { return endOf(triangles, nextHalf(half)); }

void addOfEdges(const Triangles& mesh, const Edges& edges, const Cut* cut, Places& places) {
  const std::span<const Triangle> triangles = mesh.triangles;
  for (size_t e = 0; e < edges.count(); ++e) {
    const std::span<const HalfEdge> around = edges.around(e);
    const Point a = mesh.points[beginOf(triangles, around[0])], b = mesh.points[endOf(triangles, around[0])];
    const auto add = [&](DefectKind kind) { places.add(kind, around[0] / 3, 0.5 * (a + b)); };
    if (around.size() == 1) {
      if (cut == nullptr || !cut->holds(a, b)) add(DefectKind::open_edge);
      continue;
    }
    if (around.size() > 2) add(DefectKind::nonmanifold_edge);
    if (around.size() == 2 && beginOf(triangles, around[0]) == beginOf(triangles, around[1]))
      add(DefectKind::turned_edge);
    // A duplicate triangle is found at each of its three edges, but recorded only once: at the edge opposite to the
    // corner with the highest number.
    for (size_t i = 1; i < around.size() && !places.full(DefectKind::duplicate); ++i) {
      const uint32_t apex = apexOf(triangles, around[i]);
      if (apex < beginOf(triangles, around[i]) || apex < endOf(triangles, around[i])) continue;
      const bool twice = std::any_of(around.begin(), around.begin() + static_cast<std::ptrdiff_t>(i),
                                     [&](HalfEdge other) { return apexOf(triangles, other) == apex; });
      if (twice) places.addTriangle(DefectKind::duplicate, around[i] / 3);
    }
  }
}

}  // namespace

std::string_view nameOf(DefectKind kind) { return kNames[static_cast<size_t>(kind)]; }

bool Cut::holds(Point a, Point b) const {
  for (int axis = 0; axis < 3; ++axis) {
    if (a[axis] == b[axis] && (a[axis] == low[axis] || a[axis] == high[axis])) return true;
  }
  return false;
}

uint64_t cutEdges(const Triangles& mesh, const Edges& edges, const Cut& cut) {
  uint64_t count = 0;
  for (size_t e = 0; e < edges.count(); ++e) {
    const std::span<const HalfEdge> around = edges.around(e);
    if (around.size() > 1) continue;
    count += cut.holds(mesh.points[beginOf(mesh.triangles, around[0])], mesh.points[endOf(mesh.triangles, around[0])]);
  }
  return count;
}

std::vector<DefectPlace> defectPlaces(const Triangles& mesh, const Edges& edges, const Shells& parts,
                                      const Nesting& nesting, const SelfIntersections* self_intersections,
                                      const Cut* cut) {
  Places places(mesh);
  addOfEdges(mesh, edges, cut, places);
  for (const auto& [vertex, triangle] : parts.pinched)
    places.add(DefectKind::pinched_vertex, triangle, mesh.points[vertex]);
  for (uint32_t i = 0; i < mesh.triangles.size(); ++i) {
    const Triangle& t = mesh.triangles[i];
    if (hasCornerTwice(t)) {
      places.addTriangle(DefectKind::degenerate, i);
    } else if (!places.full(DefectKind::flat) && nearlyFlat(mesh, t) && isFlat(mesh.points, t)) {
      places.addTriangle(DefectKind::flat, i);
    }
  }
  for (const uint32_t shell : nesting.first_inside_out)
    places.addTriangle(DefectKind::inside_out, parts.shells[shell].first);
  for (const uint32_t shell : nesting.first_nested) places.addTriangle(DefectKind::nested, parts.shells[shell].first);
  if (self_intersections != nullptr) {
    for (const auto& [a, b] : self_intersections->folded_examples) places.addTriangle(DefectKind::folded, a);
    for (const auto& [a, b] : self_intersections->examples) places.addTriangle(DefectKind::self_intersection, a);
  }
  return places.take();
}

}  // namespace sgm::measure
