#pragma once
// Statements without bodies, and the parts of others that come before their bodies.

#include <vector>

#include "grammar/check/types.h"

namespace sgm {

/// The effect of a list of transforms on the scope.
struct TransformEffect {
  bool shrinks = false;         ///< it sets a size; the proof of reach finds scopes that do not shrink after all
  std::vector<ExprId> factors;  ///< of its scales
};
TransformEffect checkTransforms(CheckContext& check, Symbols& symbols, Types& types, IdRange xforms);

/// Declares the plan of a footprint.
void checkFootprint(CheckContext& check, Types& types, StmtId id, const StmtNode& s);
/// Checks the plan of an extrusion or a roof, if it has one. body: of the rule or override, for hints.
void checkPlan(CheckContext& check, Symbols& symbols, Types& types, const StmtNode& s, StmtId body);
void checkRoof(CheckContext& check, Symbols& symbols, Types& types, const StmtNode& s, StmtId body);

void checkFit(CheckContext& check, Symbols& symbols, Types& types, const StmtNode& s);

/// Checks the rooms of a treemap and the doors between them.
void checkRooms(CheckContext& check, Symbols& symbols, Types& types, const StmtNode& s);

/// Checks the tiles of a wfc: their sizes and weights, and whether every side has a match.
void checkTiles(CheckContext& check, Types& types, const StmtNode& s);

}  // namespace sgm
