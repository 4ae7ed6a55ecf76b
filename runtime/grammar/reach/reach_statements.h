#pragma once
// The extents of statements: one function for each kind that has a shape. A function gets the frame with the scope in
// which the statement is written, and leaves scope and place as they were; the slots of names that it binds stay set.

#include "grammar/range/extent.h"
#include "grammar/reach/reach_context.h"

namespace sgm::reach {

// reach_statements.cpp: the choice of the function, blocks, and statements that combine or deform their bodies.

/// Nothing if the id is kNoId; no bound if the budget is used up.
Extent boundStatement(StmtId id, RangeFrame& frame, ReachContext& context);
/// A block, a meet or an extrusion without the overrides of its tag.
Extent boundUntagged(const StmtNode& s, RangeFrame& frame, ReachContext& context);
/// first: the extent before the block's own statements.
Extent boundBlock(const StmtNode& s, RangeFrame& frame, ReachContext& context, Extent first = Extent::nothing());

// reach_transforms.cpp: moved content, and copies of it.
Extent boundTransform(const StmtNode& s, RangeFrame& frame, ReachContext& context);
Extent boundRepeat(const StmtNode& s, RangeFrame& frame, ReachContext& context);
Extent boundForEach(const StmtNode& s, RangeFrame& frame, ReachContext& context);
Extent boundScatter(const StmtNode& s, RangeFrame& frame, ReachContext& context);

// reach_split.cpp, reach_treemap.cpp, reach_wfc.cpp: parts of scopes.
Extent boundSplit(const StmtNode& s, RangeFrame& frame, ReachContext& context);
Extent boundComp(const StmtNode& s, RangeFrame& frame, ReachContext& context);
Extent boundTreemap(const StmtNode& s, RangeFrame& frame, ReachContext& context);
Extent boundWfc(const StmtNode& s, RangeFrame& frame, ReachContext& context);

// reach_profiles.cpp: footprints, their extrusions, roofs, and assets.
RangeValue evaluateFootprint(const FootprintNode& plan, const RangeFrame& frame, ReachContext& context);
Extent boundExtrude(const StmtNode& s, RangeFrame& frame, ReachContext& context);
Extent boundRoof(const StmtNode& s, RangeFrame& frame, ReachContext& context);
Extent boundFit(const StmtNode& s, RangeFrame& frame, ReachContext& context);

// reach_automaton.cpp: a call of `ca`, which fills its layer's cell.
Extent boundAutomaton(const ExprNode& call, const RangeFrame& frame, ReachContext& context);

}  // namespace sgm::reach
