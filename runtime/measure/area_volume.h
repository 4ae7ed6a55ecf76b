#pragma once
// Area and volume of triangles (sections 7.1 and 7.2 of the paper).

#include "base/jobs.h"
#include "measure/triangles.h"

namespace sgm::measure {

struct AreaVolume {
  /// The sum of the triangles' areas, that is, of half the lengths of their cross products. In the paper, equation 7 is
  /// printed without the lengths, as a vector.
  double area = 0;
  /// Half the sum of the triangles' cross products. For a closed surface it is 0, except for rounding; but an open
  /// surface may have 0, too.
  Point area_vector;
  /// Volume by the divergence theorem: a sixth of the sum of the triple products of each triangle's corners, relative
  /// to `centre`. Exact for a closed mesh; negative if its triangles face inward; where parts overlap, the overlap
  /// counts twice.
  double volume = 0;
  Point low, high;  ///< bounding box of the triangles' corners; 0 if there is no triangle
  /// The origin of the triple products: the middle of low and high, so that a mesh far from the origin loses no
  /// precision. For another origin o, an open mesh has the volume `volume + dot(centre - o, area_vector) / 3`. If the
  /// parts of a closed surface all use the same o, these volumes add up to the volume of the surface.
  Point centre;

  double volumeAbout(Point origin) const { return volume + dot(centre - origin, area_vector) / 3; }
};

/// Computes area and volume of a mesh. Precondition: the coordinates are finite. The result has the same bits for any
/// number of threads.
AreaVolume areaVolume(const Triangles& mesh, JobSystem& jobs);

/// Returns the cross product of two sides: twice the area of the triangle, along its normal.
inline Point crossOf(Point a, Point b, Point c) { return asset::cross(b - a, c - a); }

}  // namespace sgm::measure
