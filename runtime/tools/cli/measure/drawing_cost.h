#pragma once
// What a GPU pays to draw a mesh in the order its triangles are in.

#include <cstddef>

#include "measure/triangles.h"

namespace sgm::cli {

/// meshoptimizer's models of a GPU, with a first-in first-out cache of kVertexCache vertices and no warps: figures to
/// compare orders by, not ones of a device.
struct DrawingCost {
  size_t triangles = 0;  ///< judged: those whose corners are finite
  double acmr = 0;       ///< vertices transformed a triangle: 0.5 to 3, lower is better
  double atvr = 0;       ///< vertices transformed a vertex that is used: 1 is best
  double overdraw = 0;   ///< pixels shaded a pixel covered, of views along the axes: 1 is best
};

inline constexpr unsigned kVertexCache = 16;

/// Nothing is measured of a mesh of more than 2^31 - 1 corners: its triangles are 0.
DrawingCost drawingCost(const measure::Triangles& mesh);

}  // namespace sgm::cli
