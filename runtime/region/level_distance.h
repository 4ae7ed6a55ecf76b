#pragma once
// How far the meshes of two levels of detail lie from each other.

#include <optional>

#include "measure/hausdorff.h"
#include "mesh/weld.h"

namespace sgm {

/// In coarse cells, from one level's surface to the next one's, where both have the same field and no part of the solid
/// or of the void is thinner than a cell. A triangle lies in a cell whose corners' signs differ; there the field is 0
/// somewhere, at most a diagonal away. That place lies in a cell of the other level whose corners' signs differ too,
/// but for what the surface bulges out of it, which is of second order; its triangles are at most its diagonal away.
/// One diagonal is of a coarse cell and one of a fine one: sqrt(3) (1 + 1/2). Smooth surfaces are of second order in
/// the cell, and far nearer. No bound holds for a field that leaves detail out by level.
inline constexpr double kLevelBound = 2.598076211353316;

struct LevelDistance {
  /// From the fine mesh to the coarse one and back, metres. Nothing where one of them has triangles to be looked at and
  /// the other is empty: as far as its level is coarse, all that is there is too thin for it.
  std::optional<measure::Hausdorff> distance;
  uint64_t fine_triangles = 0, coarse_triangles = 0;  ///< that were looked at
  /// Triangles with a corner outside of the region, or less than kBorderCells coarse cells inside of a face of it where
  /// the surface is cut: what is nearest to them may lie beyond.
  uint64_t fine_left_out = 0, coarse_left_out = 0;
};

inline constexpr int32_t kBorderCells = 3;

/// extent: the box that the fine mesh is of, hi included; the coarse one's holds it. coarse_cell: its edge, units.
/// The same bits for any number of threads. Errors: those of measure::hausdorff.
Result<LevelDistance> levelDistance(const WorldMesh& fine, const IntBox& extent, const WorldMesh& coarse,
                                    int32_t coarse_cell, const measure::HausdorffSettings& settings, JobSystem& jobs);

}  // namespace sgm
