#pragma once
// Interval bounds of expressions that the field evaluates per sample.

#include <span>
#include <vector>

#include "derive/shape.h"

namespace sgm {

/// A closed interval; either end may be infinite.
struct Range {
  double lo = 0, hi = 0;
};

/// Returns the range of every expression of a chunk over `box` (null: over all positions), widened to include the
/// rounding of the field's float arithmetic. A noise has the range -1..1, a coordinate along a sweep 0..1.
std::vector<Range> exprRanges(std::span<const Expr> exprs, const IntBox* box = nullptr);

/// Returns a box that contains all positions to which a warp moves the points of `box`, saturated to int32. offset:
/// index of the first of the three expressions of the displacement, in metres.
IntBox warpedBox(std::span<const Expr> exprs, uint32_t offset, const IntBox& box);

}  // namespace sgm
