#pragma once
// The octree for a single picture: cells look equally large at every distance.

#include <array>

#include "stream/plan/octree.h"

namespace sgm {

/// The camera of one picture. In units from the world's origin; all values are finite.
struct PictureView {
  std::array<double, 3> position{};
  std::array<double, 3> direction{0, 0, -1};  ///< of any length above 0
  double half_angle = 0.6;                    ///< radians, above 0: between the direction and the picture's corners
  double cell_angle = 0.003;                  ///< radians, above 0: the largest angle under which a cell may appear
};

/// How often to halve cells of `coarsest` units so that a cell at `nearest` units from the camera appears no larger
/// than the view allows. The halved cells are at least `finest` units wide. 0..kMaxLevel.
int halvingsFor(const PictureView& view, int32_t coarsest, int32_t finest, double nearest);

/// Returns the tree with all virtual nodes split that meet the region or touch such a node, and all nodes in the region
/// split whose cells appear too large. Nodes outside of the picture may appear four times as large, since only light
/// and reflections reach them. top: level of the coarsest chunks; finest_cell: edge of a level-0 cell, units.
Octree viewTarget(const PictureView& view, const IntBox& region, int top, int32_t finest_cell);

}  // namespace sgm
