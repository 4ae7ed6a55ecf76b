#pragma once
// Computes the extents of primitives.

#include "grammar/range/extent.h"
#include "grammar/range/reach_values.h"
#include "grammar/syntax/builtins.h"

namespace sgm {

/// Returns the extent of a primitive for all possible values of its arguments.
Extent primitiveExtent(const Program& program, const ExprNode& call, RangeEvaluator& values, const RangeFrame& frame);

/// Returns the extent of solids that may lie anywhere in a box with these edges, which is centred on the scope's
/// origin.
Extent solidIn(const IntervalVector& edges);

}  // namespace sgm
