#pragma once
// Volume by counting cubes (section 7.2 of the paper, equation 8) under the three rules for "inside".

#include <cstdint>

#include "base/result.h"
#include "measure/triangles.h"

namespace sgm::measure {

/// Cubes of one edge length that fill a box; equation 8 multiplies their number by edge^3.
struct CubeVolumes {
  double edge = 0;      ///< C_E = 1 / LD, in the mesh's unit
  uint64_t all = 0;     ///< with all eight corners inside: misses about half of those that the surface cuts
  uint64_t any = 0;     ///< with at least one corner inside: about as many too many
  uint64_t centre = 0;  ///< with their centre inside
  double volumeOf(uint64_t cubes) const { return static_cast<double>(cubes) * edge * edge * edge; }
};

inline constexpr uint64_t kMostCubes = uint64_t{1} << 30;
/// The maximum number of visited columns of cubes over all triangles: a surface that is not a folded sheet needs few.
inline constexpr uint64_t kMostLooks = uint64_t{1} << 27;

/// The cubes lie on a grid that starts `edge` before `low` and ends `edge` after `high`. A point is inside if the
/// triangles surround it more often forward than backward, seen along z; the result means little for an open mesh.
/// Precondition: the coordinates lie within low..high. Memory: a bit per cube, at least 8 bytes per column of cubes, 24
/// bytes per crossing of a column and a triangle. Errors: invalid_argument for an edge that is not above 0; limit
/// beyond kMostCubes (columns of less than 64 count as 64) or kMostLooks.
Result<CubeVolumes> cubeVolumes(const Triangles& mesh, Point low, Point high, double edge);

}  // namespace sgm::measure
