#pragma once
// The extents of terminals.

#include "grammar/range/extent.h"
#include "grammar/range/reach_values.h"
#include "grammar/syntax/builtins.h"

namespace sgm {

/// The extent of a terminal with its arguments.
Extent primitiveExtent(const Program& program, const ExprNode& call, RangeEvaluator& values, const RangeFrame& frame);

/// Solids in a box with these edges around the scope's middle, which may be absent.
Extent solidIn(const IntervalVector& edges);

}  // namespace sgm
