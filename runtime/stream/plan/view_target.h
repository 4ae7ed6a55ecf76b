#pragma once
// Computes the octree for a single picture, such that cells look equally large at every distance.

#include <array>

#include "stream/plan/octree.h"

namespace sgm {

/// The camera of a picture. Positions are in units from the world's origin; all values are finite.
struct PictureView {
  std::array<double, 3> position{};
  std::array<double, 3> direction{0, 0, -1};  ///< view direction, of any length above 0
  /// angle between the view direction and the picture's corners, in radians, above 0
  double half_angle = 0.6;
  double cell_angle = 0.003;  ///< maximum angle under which a cell may appear, in radians, above 0
};

/// Returns how often cells with an edge of `coarsest` units must be halved so that a cell at a distance of `nearest`
/// units from the camera looks no larger than cell_angle: 0..kMaxLevel. The halved cells have an edge of at least
/// `finest` units.
int halvingsFor(const PictureView& view, int32_t coarsest, int32_t finest, double nearest);

/// Returns an octree for the picture. It splits all virtual nodes (the roots, octree.h) that intersect the region, and
/// the virtual nodes that touch one of these. It also splits all nodes in the region whose cells would look too large.
/// Cells outside of the picture may be four times as large, since they are visible only through shadows and
/// reflections. top: level of the coarsest chunks; finest_cell: edge of a level-0 cell in units.
Octree viewTarget(const PictureView& view, const IntBox& region, int top, int32_t finest_cell);

}  // namespace sgm
