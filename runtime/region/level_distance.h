#pragma once
// Measures the distance between the meshes of two levels of detail.

#include <optional>

#include "measure/hausdorff.h"
#include "mesh/weld.h"

namespace sgm {

/// Upper bound of the distance, in coarse cells, from one level's surface to that of the next level, if both levels
/// have the same field and no part of the solid or of the void is thinner than a cell.
///
/// Proof: a triangle lies in a cell whose corners differ in sign, so the field is 0 at some position in that cell, at
/// most one diagonal away. That position also lies in a cell of the other level whose corners differ in sign (except
/// for a second-order bulge of the surface), and the triangles of that cell are at most one diagonal away from it. One
/// of the two diagonals is that of a coarse cell, the other that of a fine one: sqrt(3) (1 + 1/2). The distance of
/// smooth surfaces is of second order in the cell, and far smaller. There is no bound for a field that omits detail by
/// level.
inline constexpr double kLevelBound = 2.598076211353316;

struct LevelDistance {
  /// The distances from the fine mesh to the coarse one and back, in metres. nullopt if one of the meshes has triangles
  /// to test, but the other mesh has no triangles at all. If the coarse mesh has no triangles, all parts of the solid
  /// are too thin for its level.
  std::optional<measure::Hausdorff> distance;
  uint64_t fine_triangles = 0, coarse_triangles = 0;  ///< tested triangles
  /// Numbers of triangles that were not tested. Such a triangle has a corner outside of the region, or less than
  /// kBorderCells coarse cells from a face of the region where the surface is cut: the nearest part of the other mesh's
  /// surface may lie outside of the region.
  uint64_t fine_left_out = 0, coarse_left_out = 0;
};

inline constexpr int32_t kBorderCells = 3;

/// Measures the distance between two levels. extent: the box of the fine mesh, hi included; the coarse mesh's box
/// contains it. coarse_cell: cell edge of the coarse level, in units. The result has the same bits for any number of
/// threads. Errors: those of measure::hausdorff.
Result<LevelDistance> levelDistance(const WorldMesh& fine, const IntBox& extent, const WorldMesh& coarse,
                                    int32_t coarse_cell, const measure::HausdorffSettings& settings, JobSystem& jobs);

}  // namespace sgm
