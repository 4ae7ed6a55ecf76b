#pragma once
// Estimates a GPU's cost of drawing a mesh with its triangles in their given order.

#include <cstddef>

#include "measure/triangles.h"

namespace sgm::cli {

/// Results of simulating a GPU with meshoptimizer: a FIFO vertex cache of kVertexCache entries, without warps. The
/// figures serve to compare triangle orders; no real device has exactly these figures.
struct DrawingCost {
  size_t triangles = 0;  ///< number of triangles with finite corners; other triangles are ignored
  double acmr = 0;       ///< transformed vertices per triangle: 0.5 to 3, lower is better
  double atvr = 0;       ///< transformed vertices per used vertex: 1 is best
  double overdraw = 0;   ///< shaded pixels per covered pixel, in views along the axes: 1 is best
};

inline constexpr unsigned kVertexCache = 16;

/// Estimates the cost of drawing a mesh. All members are zero for a mesh of more than 2^31 - 1 corners.
DrawingCost drawingCost(const measure::Triangles& mesh);

}  // namespace sgm::cli
