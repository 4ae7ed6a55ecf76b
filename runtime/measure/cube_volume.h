#pragma once
// Volume by counting cubes (section 7.2 of the paper, equation 8), under three rules for when a cube counts as inside.

#include <cstdint>

#include "base/result.h"
#include "measure/triangles.h"

namespace sgm::measure {

/// Counts of the cubes of one edge length in a box. Equation 8 multiplies a count by edge^3.
struct CubeVolumes {
  double edge = 0;      ///< edge of the cubes in the mesh's unit; C_E = 1 / LD in the paper
  uint64_t all = 0;     ///< cubes with all eight corners inside; volume too small by about half of the cut cubes
  uint64_t any = 0;     ///< cubes with at least one corner inside; volume too large by about half of the cut cubes
  uint64_t centre = 0;  ///< cubes whose centre is inside
  double volumeOf(uint64_t cubes) const { return static_cast<double>(cubes) * edge * edge * edge; }
};

inline constexpr uint64_t kMaxCubes = uint64_t{1} << 30;
/// Limits the work of cubeVolumes(). The work is the sum over all triangles of the number of columns of cubes that the
/// triangle lies over. Only a densely folded surface exceeds this limit.
inline constexpr uint64_t kMaxLooks = uint64_t{1} << 27;

/// Counts cubes. They lie on a grid that starts `edge` before `low` and ends `edge` after `high`. A point is inside if
/// the winding number of the surface around it is above 0. The number is computed along z, and means little for an open
/// mesh. Precondition: the coordinates lie within low..high. Memory: a bit per cube, at least 8 bytes per column of
/// cubes, 24 bytes per crossing of a column and a triangle. Errors: invalid_argument if edge is not above 0; limit if
/// there are more than kMaxCubes cubes (columns of less than 64 count as 64) or kMaxLooks visits.
Result<CubeVolumes> cubeVolumes(const Triangles& mesh, Point low, Point high, double edge);

}  // namespace sgm::measure
