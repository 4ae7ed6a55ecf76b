#pragma once
// A function for each kind of statement. They derive it in an environment, and append the shapes that it adds to its
// block to `out`. After the budget has failed they add nothing more that counts.

#include <cstdint>

#include "derive/interpret/cell_context.h"
#include "derive/interpret/env.h"

namespace sgm::interpret {

// statements.cpp
/// Any statement, with the overrides of its tag; nothing if id is kNoId.
void runStatement(StmtId id, CellContext& c, const Env& env, ShapeList& out);
/// A call of a rule or a primitive.
void runCall(ExprId id, uint32_t ordinal, CellContext& c, const Env& env, ShapeList& out);
void runBlock(const StmtNode& s, CellContext& c, const Env& env, ShapeList& out);
/// The statements of a block, derived as if they were in the block of `out`.
void runContents(const StmtNode& s, CellContext& c, const Env& env, ShapeList& out);
void runDetail(const StmtNode& s, CellContext& c, const Env& env, ShapeList& out);
/// Gives the environment the material and the tag of a block.
void label(const StmtNode& block, Env& env);

// combine.cpp and morph.cpp
void runUnite(const StmtNode& s, CellContext& c, const Env& env, ShapeList& out);
void runCut(const StmtNode& s, CellContext& c, const Env& env, ShapeList& out);
void runMeet(const StmtNode& s, CellContext& c, const Env& env, ShapeList& out);
void runSum(const StmtNode& s, CellContext& c, const Env& env, ShapeList& out);
void runDisplace(const StmtNode& s, CellContext& c, const Env& env, ShapeList& out);
void runWarp(const StmtNode& s, CellContext& c, const Env& env, ShapeList& out);
void runMorph(const StmtNode& s, CellContext& c, const Env& env, ShapeList& out);

// placement.cpp and scatter.cpp
void runTransform(const StmtNode& s, CellContext& c, const Env& env, ShapeList& out);
void runRepeat(const StmtNode& s, CellContext& c, const Env& env, ShapeList& out);
void runForEach(const StmtNode& s, CellContext& c, const Env& env, ShapeList& out);
void runAnchor(const StmtNode& s, CellContext& c, const Env& env);
void runScatter(const StmtNode& s, CellContext& c, const Env& env, ShapeList& out);

// split.cpp
void runSplit(const StmtNode& s, CellContext& c, const Env& env, ShapeList& out);
void runSnap(const StmtNode& s, CellContext& c, const Env& env, ShapeList& out);
void runComp(const StmtNode& s, CellContext& c, const Env& env, ShapeList& out);
/// A child of a split, comp or wfc, as a block of its own in `scope` at `place`; number: of the part, for its key.
void runPart(const StmtNode& s, uint32_t index, uint64_t number, const Placement& place, Vec3 scope, CellContext& c,
             const Env& env, ShapeList& out);

// rooms.cpp, tiles.cpp and fit.cpp
void runTreemap(const StmtNode& s, CellContext& c, const Env& env, ShapeList& out);
void runWfc(const StmtNode& s, CellContext& c, const Env& env, ShapeList& out);
void runFit(const StmtNode& s, CellContext& c, const Env& env, ShapeList& out);

// profiles.cpp
void runFootprint(const StmtNode& s, CellContext& c, const Env& env);
void runExtrude(const StmtNode& s, CellContext& c, const Env& env, ShapeList& out);
void runRoof(const StmtNode& s, CellContext& c, const Env& env, ShapeList& out);

}  // namespace sgm::interpret
