#include "region/level_distance.h"

#include <algorithm>
#include <limits>
#include <vector>

#include "measure/world_triangles.h"

namespace sgm {
namespace {

using measure::Point;
using measure::Triangle;

struct Range {
  Point low, high;

  bool holds(Point p) const {
    return p.x >= low.x && p.y >= low.y && p.z >= low.z && p.x <= high.x && p.y <= high.y && p.z <= high.z;
  }
};

/// Converts a position in units to metres from the mesh's origin.
Point placeFrom(Int3 units, Int3 origin) {
  Point place;
  for (int axis = 0; axis < 3; ++axis) {
    place[axis] = static_cast<double>(int64_t{units[axis]} - origin[axis]) / kUnitsPerMetre;
  }
  return place;
}

/// Returns the range with each of its faces that the surface reaches moved inwards by `border`. At such a face, a cut
/// may have removed parts of the surface.
Range innerOf(const std::vector<Point>& points, Range range, double border) {
  Range inner = range;
  for (int axis = 0; axis < 3; ++axis) {
    const auto reaches = [&](double plane) {
      return std::any_of(points.begin(), points.end(), [&](Point p) { return p[axis] == plane; });
    };
    if (reaches(range.low[axis])) inner.low[axis] += border;
    if (reaches(range.high[axis])) inner.high[axis] -= border;
  }
  return inner;
}

std::vector<Triangle> within(const asset::TriangleMesh& mesh, const Range& range) {
  std::vector<Triangle> kept;
  std::copy_if(mesh.triangles.begin(), mesh.triangles.end(), std::back_inserter(kept), [&](const Triangle& t) {
    return std::all_of(t.begin(), t.end(), [&](uint32_t v) { return range.holds(mesh.points[v]); });
  });
  return kept;
}

}  // namespace

Result<LevelDistance> levelDistance(const WorldMesh& fine, const IntBox& extent, const WorldMesh& coarse,
                                    int32_t coarse_cell, const measure::HausdorffSettings& settings, JobSystem& jobs) {
  const asset::TriangleMesh first = measure::trianglesOf(fine);
  asset::TriangleMesh second = measure::trianglesOf(coarse);
  const Point from_first = placeFrom(coarse.origin, fine.origin);
  for (Point& p : second.points) p = p + from_first;

  const Range range{placeFrom(extent.lo, fine.origin), placeFrom(extent.hi, fine.origin)};
  const Range inner = innerOf(first.points, range, kBorderCells * metres(coarse_cell));
  const std::vector<Triangle> there = within(first, inner), back = within(second, inner);
  LevelDistance result;
  result.fine_triangles = there.size();
  result.fine_left_out = first.triangles.size() - there.size();
  result.coarse_triangles = back.size();
  result.coarse_left_out = second.triangles.size() - back.size();

  if ((!there.empty() && second.triangles.empty()) || (!back.empty() && first.triangles.empty())) return result;
  // Only the triangles in the inner range are tested, but against all triangles of the other mesh: the nearest of them
  // may lie in the margin.
  Result<measure::OneSided> one =
      measure::distanceFrom({first.points, there}, {second.points, second.triangles}, settings, jobs);
  if (!one) return one.error();
  Result<measure::OneSided> other =
      measure::distanceFrom({second.points, back}, {first.points, first.triangles}, settings, jobs);
  if (!other) return other.error();
  result.distance = measure::Hausdorff{*one, *other};
  return result;
}

}  // namespace sgm
