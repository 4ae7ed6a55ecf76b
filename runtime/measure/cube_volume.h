#pragma once
// Volume by counting cubes (section 7.2 of the paper, equation 8) under the three rules for "inside".

#include <cstdint>

#include "base/result.h"
#include "measure/triangles.h"

namespace sgm::measure {

/// Cubes of one edge that fill a box; equation 8 multiplies their number by edge^3.
struct CubeVolumes {
  double edge = 0;      ///< C_E = 1 / LD, in the mesh's unit
  uint64_t all = 0;     ///< cubes with all eight corners inside: too few by about half of those that the surface cuts
  uint64_t any = 0;     ///< with one corner inside or more: too many by as much
  uint64_t centre = 0;  ///< with their centre inside
  double volumeOf(uint64_t cubes) const { return static_cast<double>(cubes) * edge * edge * edge; }
};

inline constexpr uint64_t kMostCubes = uint64_t{1} << 30;
/// Looks at columns of cubes for a triangle, all together: a surface that is no folded sheet takes few a column.
inline constexpr uint64_t kMostLooks = uint64_t{1} << 27;

/// The cubes lie on a grid that starts `edge` before `low` and ends `edge` behind `high`. Inside is where the triangles
/// go round a place more often forward than backward, as seen along z; of an open mesh that says little.
/// Contract: the coordinates lie within low..high. Memory: a bit a cube, 8 bytes at least a column of cubes, 24 bytes a
/// place where a column crosses a triangle. Errors: invalid_argument for an edge that is not above 0; limit beyond
/// kMostCubes (columns of less than 64 counted as that many) or kMostLooks.
Result<CubeVolumes> cubeVolumes(const Triangles& mesh, Point low, Point high, double edge);

}  // namespace sgm::measure
