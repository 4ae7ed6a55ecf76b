#pragma once
// Area and volume of triangles (section 7.1 and 7.2 of the paper).

#include "base/jobs.h"
#include "measure/triangles.h"

namespace sgm::measure {

struct AreaVolume {
  /// Equation 7, which prints a vector: the sum of half the length of each triangle's cross product.
  double area = 0;
  /// Half the sum of the cross products. 0 for a closed surface, up to rounding; 0 does not prove that it is closed.
  Point area_vector;
  /// By the divergence theorem: a sixth of the sum of the triple products, about `centre`. Exact for a closed mesh;
  /// negative where its triangles face inward; what is covered twice counts twice.
  double volume = 0;
  Point low, high;  ///< around the triangles' corners; 0 where there is none
  /// Where the triple products count from: the middle of low and high, so that a mesh far out loses nothing. About
  /// another origin o an open mesh has volume + dot(centre - o, area_vector) / 3, by which the parts of a closed
  /// surface add up.
  Point centre;

  double volumeAbout(Point origin) const { return volume + dot(centre - origin, area_vector) / 3; }
};

/// Contract: the coordinates are finite. The same bits for any number of threads.
AreaVolume areaVolume(const Triangles& mesh, JobSystem& jobs);

/// Of one triangle: twice its area along its normal.
inline Point crossOf(Point a, Point b, Point c) { return asset::cross(b - a, c - a); }

}  // namespace sgm::measure
