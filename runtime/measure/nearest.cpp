#include "measure/nearest.h"

#include <algorithm>
#include <utility>

namespace sgm::measure {
namespace {

Point nearestOnEdge(Point a, Point b, Point to) {
  const Point edge = b - a;
  const double square = dot(edge, edge);
  return square > 0 ? a + std::clamp(dot(to - a, edge) / square, 0.0, 1.0) * edge : a;
}

double squareTo(Point a, Point b) { return dot(b - a, b - a); }

/// Returns the squared distance from a point to a box; infinite if the box is empty.
double squareTo(const Bvh::Box& box, Point to) {
  double square = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const double out = std::max({double{box.low[axis]} - to[axis], to[axis] - double{box.high[axis]}, 0.0});
    square += out * out;
  }
  return square;
}

std::array<Point, 3> cornersOf(const Triangles& mesh, uint32_t triangle) {
  const Triangle& t = mesh.triangles[triangle];
  return {mesh.points[t[0]], mesh.points[t[1]], mesh.points[t[2]]};
}

}  // namespace

Point nearestOn(const std::array<Point, 3>& triangle, Point to) {
  const auto& [a, b, c] = triangle;
  Point best = nearestOnEdge(a, b, to);
  const auto offer = [&](Point place) {
    if (squareTo(place, to) < squareTo(best, to)) best = place;
  };
  offer(nearestOnEdge(b, c, to));
  offer(nearestOnEdge(c, a, to));
  const Point normal = cross(b - a, c - a);
  const double u = dot(cross(c - b, to - b), normal), v = dot(cross(a - c, to - c), normal),
               w = dot(cross(b - a, to - a), normal), all = u + v + w;
  // Uses a weighted mean of the corners instead of a projection along the normal: the normal of a sliver is mostly
  // rounding error.
  if (u >= 0 && v >= 0 && w >= 0 && all > 0) offer(u / all * a + v / all * b + w / all * c);
  return best;
}

Nearest nearestOf(const Triangles& mesh, const Bvh& tree, Point to, uint32_t guess) {
  Nearest best;
  double square = 0;
  const auto take = [&](uint32_t triangle, Point place) {
    best.triangle = triangle;
    best.place = place;
    square = squareTo(place, to);
  };
  take(guess, nearestOn(cornersOf(mesh, guess), to));
  // The stack of nodes to be searched. It is large enough, since each level of the tree adds at most one waiting node.
  std::array<std::pair<double, size_t>, 34> waiting;
  waiting[0] = {squareTo(tree.box(1), to), 1};
  size_t count = 1;
  while (count > 0) {
    const auto [at_least, node] = waiting[--count];
    if (at_least >= square) continue;
    if (tree.isLeaf(node)) {
      const uint32_t triangle = tree.triangle(node);
      const Point place = nearestOn(cornersOf(mesh, triangle), to);
      if (squareTo(place, to) < square) take(triangle, place);
      continue;
    }
    std::pair<double, size_t> near{squareTo(tree.box(2 * node), to), 2 * node},
        far{squareTo(tree.box(2 * node + 1), to), 2 * node + 1};
    if (far.first < near.first) std::swap(near, far);
    if (far.first < square) waiting[count++] = far;
    if (near.first < square) waiting[count++] = near;
  }
  best.distance = length(best.place - to);
  return best;
}

}  // namespace sgm::measure
