#pragma once
// How far the terminals extend.

#include "grammar/range/extent.h"
#include "grammar/syntax/builtins.h"

namespace sgm {

/// The extent of a terminal with its arguments.
Extent primitiveExtent(const Program& program, const ExprNode& call, RangeEvaluator& values, const RangeFrame& frame);

/// Solids in a box with these edges about the scope's middle, which may be left out.
Extent solidIn(const IntervalVector& edges);

}  // namespace sgm
