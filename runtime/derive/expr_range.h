#pragma once
// Interval bounds of expressions that are evaluated per sample.

#include <span>
#include <vector>

#include "derive/shape.h"

namespace sgm {

/// A closed interval; either end may be infinite.
struct Range {
  double lo = 0, hi = 0;
};

/// The range of every expression of the chunk over `box` (coordinates are unbounded if box is nullptr), widened for the
/// float arithmetic of the field. The ranges of noise and sweep are -1..1 and 0..1.
std::vector<Range> exprRanges(std::span<const Expr> exprs, const IntBox* box = nullptr);

/// Contains the image of the box under a warp by the three expressions from `offset` on, in metres. Saturates.
IntBox warpedBox(std::span<const Expr> exprs, uint32_t offset, const IntBox& box);

}  // namespace sgm
