#pragma once
// Interval bounds of sample-time expressions.

#include <span>
#include <vector>

#include "derive/shape.h"

namespace sgm {

/// A closed interval; either end may be infinite.
struct Range {
  double lo = 0, hi = 0;
};

/// The range of every expression of the chunk over `box` (coordinates are unbounded where box is nullptr), widened for
/// the float arithmetic of the field. Noise is taken as -1..1, a sweep as 0..1.
std::vector<Range> exprRanges(std::span<const Expr> exprs, const IntBox* box = nullptr);

/// Holds every place that a warp by the three expressions from `offset` on, metres, leads to from the box. Saturates.
IntBox warpedBox(std::span<const Expr> exprs, uint32_t offset, const IntBox& box);

}  // namespace sgm
