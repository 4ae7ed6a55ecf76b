#include "asset/convex_cell.h"

#include <algorithm>
#include <limits>

namespace sgm::asset {

namespace {

/// Returns the part of a cell behind a plane; the cut becomes a new facet.
ConvexCell partBehind(const ConvexCell& cell, const Plane& plane, double tolerance) {
  ConvexCell part;
  for (const ConvexCell::Facet& facet : cell.facets)
    if (Loop loop = clippedLoop(facet.loop, plane, tolerance); loop.size() >= 3)
      part.facets.push_back({facet.plane, std::move(loop)});
  const Point about = cell.middle();
  double reach = 0;
  for (const ConvexCell::Facet& facet : cell.facets)
    for (const Point& p : facet.loop) reach = std::max(reach, length(p - about));
  Loop cap = squareIn(plane, about, 4 * reach);
  for (const ConvexCell::Facet& facet : cell.facets) cap = clippedLoop(cap, facet.plane, tolerance);
  if (cap.size() >= 3) part.facets.push_back({plane, std::move(cap)});
  return part;
}

}  // namespace

Loop clippedLoop(const Loop& loop, const Plane& plane, double tolerance) {
  Loop out;
  bool behind = false, before = false;
  for (const Point& p : loop) {
    behind = behind || plane.distance(p) < -tolerance;
    before = before || plane.distance(p) > tolerance;
  }
  if (!before) return loop;
  if (!behind) return out;
  for (size_t i = 0; i < loop.size(); ++i) {
    const Point a = loop[i], b = loop[(i + 1) % loop.size()];
    const double from = plane.distance(a), to = plane.distance(b);
    if (from <= tolerance) out.push_back(a);
    // Compute the intersection always from the same end of the edge, regardless of its direction, so that both adjacent
    // polygons get the same point.
    if ((from < -tolerance && to > tolerance) || (from > tolerance && to < -tolerance))
      out.push_back(from < 0 ? a + (from / (from - to)) * (b - a) : b + (to / (to - from)) * (a - b));
  }
  return out;
}

Loop squareIn(const Plane& plane, Point about, double half_edge) {
  const Point n = plane.normal, middle = about - plane.distance(about) * n;
  const Point axis = std::fabs(n.x) < 0.6 ? Point{1, 0, 0} : Point{0, 1, 0};
  const Point u = half_edge * normalised(cross(axis, n)), v = cross(n, u);
  return {middle - u - v, middle + u - v, middle + u + v, middle - u + v};
}

double areaOf(const Loop& loop) {
  Point sum;
  for (size_t i = 2; i < loop.size(); ++i) sum = sum + cross(loop[i - 1] - loop[0], loop[i] - loop[0]);
  return 0.5 * length(sum);
}

Point middleOf(const Loop& loop) {
  Point sum;
  for (const Point& p : loop) sum = sum + p;
  return loop.empty() ? sum : (1.0 / static_cast<double>(loop.size())) * sum;
}

ConvexCell ConvexCell::box(Point low, Point high) {
  ConvexCell cell;
  const Point middle = 0.5 * (low + high), edges = high - low;
  for (int axis = 0; axis < 3; ++axis)
    for (const bool upper : {false, true}) {
      Facet facet;
      facet.plane.normal[axis] = upper ? 1 : -1;
      facet.plane.offset = upper ? high[axis] : -low[axis];
      facet.loop = squareIn(facet.plane, middle, 1);
      for (Point& p : facet.loop)
        for (int k = 0; k < 3; ++k)
          if (k != axis) p[k] = p[k] < middle[k] ? middle[k] - 0.5 * edges[k] : middle[k] + 0.5 * edges[k];
      cell.facets.push_back(std::move(facet));
    }
  return cell;
}

Point ConvexCell::middle() const {
  Point sum;
  double count = 0;
  for (const Facet& facet : facets)
    for (const Point& p : facet.loop) {
      sum = sum + p;
      count += 1;
    }
  return count > 0 ? (1 / count) * sum : sum;
}

double ConvexCell::volume() const {
  const Point about = middle();
  double sum = 0;
  for (const Facet& facet : facets) sum -= areaOf(facet.loop) * facet.plane.distance(about) / 3;
  return sum;
}

std::pair<double, double> ConvexCell::range(const Plane& plane) const {
  double least = std::numeric_limits<double>::max(), most = -least;
  for (const Facet& facet : facets)
    for (const Point& p : facet.loop) {
      const double at = plane.distance(p);
      least = std::min(least, at);
      most = std::max(most, at);
    }
  return {least, most};
}

SplitCell splitCell(const ConvexCell& cell, const Plane& plane, double tolerance) {
  const auto [least, most] = cell.range(plane);
  if (most <= tolerance) return {cell, std::nullopt};
  if (least >= -tolerance) return {std::nullopt, cell};
  return {partBehind(cell, plane, tolerance), partBehind(cell, plane.turned(), tolerance)};
}

}  // namespace sgm::asset
