#pragma once
// Which octree a single picture wants: cells that look equally large at every distance.

#include <array>

#include "stream/plan/octree.h"

namespace sgm {

/// A camera that takes one picture. Units, from the world's origin; everything finite.
struct PictureView {
  std::array<double, 3> position{};
  std::array<double, 3> direction{0, 0, -1};  ///< of any length above 0
  double half_angle = 0.6;                    ///< radians, above 0: from the direction to the picture's corners
  double cell_angle = 0.003;                  ///< radians, above 0: the widest that a cell may look
};

/// How often cells of `coarsest` units are halved, so that one at `nearest` units from the camera looks no wider than
/// the view asks. The halved cells are at least `finest` units wide. 0..kMaxLevel.
int halvingsFor(const PictureView& view, int32_t coarsest, int32_t finest, double nearest);

/// The tree that has split all virtual nodes that meet the region or touch one that does, and in the region all nodes
/// whose cells look too wide; those that the picture does not show may look four times as wide, since light and
/// reflections alone find them. top: level of the coarsest chunks; finest_cell: edge of a level-0 cell, units.
Octree viewTarget(const PictureView& view, const IntBox& region, int top, int32_t finest_cell);

}  // namespace sgm
