#pragma once
// Area and volume of triangles (sections 7.1 and 7.2 of the paper).

#include "base/jobs.h"
#include "measure/triangles.h"

namespace sgm::measure {

struct AreaVolume {
  /// The sum of half the lengths of the triangles' cross products (equation 7 of the paper, where it is printed as a
  /// vector).
  double area = 0;
  /// Half the sum of the cross products. 0 for a closed surface, up to rounding; but 0 does not prove that it is
  /// closed.
  Point area_vector;
  /// By the divergence theorem: a sixth of the sum of the triple products, about `centre`. Exact for a closed mesh;
  /// negative if its triangles face inward; overlapping parts count twice.
  double volume = 0;
  Point low, high;  ///< bounding box of the triangles' corners; 0 if there is no triangle
  /// The origin of the triple products: the middle of low and high, so that a mesh far from the origin loses no
  /// precision. About another origin o, an open mesh has volume + dot(centre - o, area_vector) / 3, and these values of
  /// the parts of a closed surface add up to its volume.
  Point centre;

  double volumeAbout(Point origin) const { return volume + dot(centre - origin, area_vector) / 3; }
};

/// Computes area and volume of a mesh. Precondition: the coordinates are finite. The result has the same bits for any
/// number of threads.
AreaVolume areaVolume(const Triangles& mesh, JobSystem& jobs);

/// Returns the cross product of two sides: twice the area of the triangle, along its normal.
inline Point crossOf(Point a, Point b, Point c) { return asset::cross(b - a, c - a); }

}  // namespace sgm::measure
