#pragma once
// Measures the distance between the meshes of two levels of detail.

#include <optional>

#include "measure/hausdorff.h"
#include "mesh/weld.h"

namespace sgm {

/// The largest distance in coarse cells from one level's surface to the next one's, if both have the same field and no
/// part of the solid or of the void is thinner than a cell. A triangle lies in a cell whose corners differ in sign; so
/// the field is 0 somewhere in it, at most a diagonal away. That place lies in a cell of the other level whose corners
/// differ in sign, too (except for a second-order bulge of the surface), and that cell's triangles are at most its
/// diagonal away. One diagonal is of a coarse cell and one of a fine one: sqrt(3) (1 + 1/2). Smooth surfaces are of
/// second order in the cell, and far nearer. No bound holds for a field that omits detail by level.
inline constexpr double kLevelBound = 2.598076211353316;

struct LevelDistance {
  /// The distances from the fine mesh to the coarse one and back, in metres. nullopt if only one of the meshes has
  /// triangles to test: if the coarse one has none, all parts are too thin for its level.
  std::optional<measure::Hausdorff> distance;
  uint64_t fine_triangles = 0, coarse_triangles = 0;  ///< tested triangles
  /// Triangles that were not tested, because a corner lies outside of the region, or less than kBorderCells coarse
  /// cells from a face of the region where the surface is cut: the surface nearest to them may lie outside.
  uint64_t fine_left_out = 0, coarse_left_out = 0;
};

inline constexpr int32_t kBorderCells = 3;

/// Measures the distance between two levels. extent: the box of the fine mesh, hi included; the coarse mesh's box
/// contains it. coarse_cell: cell edge of the coarse level, in units. The same bits for any number of threads. Errors:
/// those of measure::hausdorff.
Result<LevelDistance> levelDistance(const WorldMesh& fine, const IntBox& extent, const WorldMesh& coarse,
                                    int32_t coarse_cell, const measure::HausdorffSettings& settings, JobSystem& jobs);

}  // namespace sgm
