#pragma once
// Computes the extents of statements: one function for each kind that derives shapes. A function receives the frame
// with the scope of the statement, and restores scope and place in the frame before it returns; but names that the
// statement declares keep their values in the frame.

#include "grammar/range/extent.h"
#include "grammar/reach/reach_context.h"

namespace sgm::reach {

// Defined in reach_statements.cpp: the choice of the function, blocks, and statements that combine or deform their
// bodies.

/// Returns the extent of any statement: an empty extent for kNoId, and an unbounded one if the step budget is used up.
Extent boundStatement(StmtId id, RangeFrame& frame, ReachContext& context);
/// Returns the extent of a block, a meet or an extrusion, ignoring overrides of its tag.
Extent boundUntagged(const StmtNode& s, RangeFrame& frame, ReachContext& context);
/// Returns the extent of a block. first: the extent of content that precedes the block's own statements.
Extent boundBlock(const StmtNode& s, RangeFrame& frame, ReachContext& context, Extent first = Extent::nothing());

// Defined in reach_transforms.cpp: statements that move or copy their content.
Extent boundTransform(const StmtNode& s, RangeFrame& frame, ReachContext& context);
Extent boundRepeat(const StmtNode& s, RangeFrame& frame, ReachContext& context);
Extent boundForEach(const StmtNode& s, RangeFrame& frame, ReachContext& context);
Extent boundScatter(const StmtNode& s, RangeFrame& frame, ReachContext& context);

// Defined in reach_split.cpp, reach_treemap.cpp and reach_wfc.cpp: statements that divide a scope into parts.
Extent boundSplit(const StmtNode& s, RangeFrame& frame, ReachContext& context);
Extent boundComp(const StmtNode& s, RangeFrame& frame, ReachContext& context);
Extent boundTreemap(const StmtNode& s, RangeFrame& frame, ReachContext& context);
Extent boundWfc(const StmtNode& s, RangeFrame& frame, ReachContext& context);

// Defined in reach_profiles.cpp: footprints, their extrusions, roofs, and assets.
RangeValue evaluateFootprint(const FootprintNode& plan, const RangeFrame& frame, ReachContext& context);
Extent boundExtrude(const StmtNode& s, RangeFrame& frame, ReachContext& context);
Extent boundRoof(const StmtNode& s, RangeFrame& frame, ReachContext& context);
Extent boundFit(const StmtNode& s, RangeFrame& frame, ReachContext& context);

// Returns the extent of a call of `ca` (a cellular automaton), which fills its layer's cell. Defined in
// reach_automaton.cpp.
Extent boundAutomaton(const ExprNode& call, const RangeFrame& frame, ReachContext& context);

}  // namespace sgm::reach
