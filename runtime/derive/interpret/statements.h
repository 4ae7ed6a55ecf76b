#pragma once
// One function for each kind of statement. Each derives its statement in an environment, and appends to `out` the
// shapes that the statement adds to its block. After the budget has failed, results are ignored.

#include <cstdint>

#include "derive/interpret/cell_context.h"
#include "derive/interpret/env.h"

namespace sgm::interpret {

// The following functions are defined in statements.cpp.

/// Derives any statement, with the overrides of its tag; does nothing for kNoId.
void runStatement(StmtId id, CellContext& c, const Env& env, ShapeList& out);
/// Derives a call of a rule or a primitive.
void runCall(ExprId id, uint32_t ordinal, CellContext& c, const Env& env, ShapeList& out);
void runBlock(const StmtNode& s, CellContext& c, const Env& env, ShapeList& out);
/// Derives the statements of a block directly into the block that owns `out`, without a block of their own.
void runContents(const StmtNode& s, CellContext& c, const Env& env, ShapeList& out);
void runDetail(const StmtNode& s, CellContext& c, const Env& env, ShapeList& out);
/// Sets the environment's material and tag to those of a block.
void label(const StmtNode& block, Env& env);

// The following functions are defined in combine.cpp and morph.cpp.
void runUnite(const StmtNode& s, CellContext& c, const Env& env, ShapeList& out);
void runCut(const StmtNode& s, CellContext& c, const Env& env, ShapeList& out);
void runMeet(const StmtNode& s, CellContext& c, const Env& env, ShapeList& out);
void runSum(const StmtNode& s, CellContext& c, const Env& env, ShapeList& out);
void runDisplace(const StmtNode& s, CellContext& c, const Env& env, ShapeList& out);
void runWarp(const StmtNode& s, CellContext& c, const Env& env, ShapeList& out);
void runMorph(const StmtNode& s, CellContext& c, const Env& env, ShapeList& out);

// The following functions are defined in placement.cpp and scatter.cpp.
void runTransform(const StmtNode& s, CellContext& c, const Env& env, ShapeList& out);
void runRepeat(const StmtNode& s, CellContext& c, const Env& env, ShapeList& out);
void runForEach(const StmtNode& s, CellContext& c, const Env& env, ShapeList& out);
void runAnchor(const StmtNode& s, CellContext& c, const Env& env);
void runScatter(const StmtNode& s, CellContext& c, const Env& env, ShapeList& out);

// The following functions are defined in split.cpp.
void runSplit(const StmtNode& s, CellContext& c, const Env& env, ShapeList& out);
void runSnap(const StmtNode& s, CellContext& c, const Env& env, ShapeList& out);
void runComp(const StmtNode& s, CellContext& c, const Env& env, ShapeList& out);
/// Derives a child of a split, comp or wfc as a block of its own, in `scope` at `place`. index: index of the child;
/// number: distinguishes the keys of parts that share a child.
void runPart(const StmtNode& s, uint32_t index, uint64_t number, const Placement& place, Vec3 scope, CellContext& c,
             const Env& env, ShapeList& out);

// The following functions are defined in rooms.cpp, tiles.cpp and fit.cpp.
void runTreemap(const StmtNode& s, CellContext& c, const Env& env, ShapeList& out);
void runWfc(const StmtNode& s, CellContext& c, const Env& env, ShapeList& out);
void runFit(const StmtNode& s, CellContext& c, const Env& env, ShapeList& out);

// The following functions are defined in profiles.cpp.
void runFootprint(const StmtNode& s, CellContext& c, const Env& env);
void runExtrude(const StmtNode& s, CellContext& c, const Env& env, ShapeList& out);
void runRoof(const StmtNode& s, CellContext& c, const Env& env, ShapeList& out);

}  // namespace sgm::interpret
