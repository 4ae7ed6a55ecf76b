#pragma once
// Checks statements without bodies, and the parts of other statements that precede their bodies.

#include <vector>

#include "grammar/check/types.h"

namespace sgm {

/// The effect of a list of transforms on the scope.
struct TransformEffect {
  /// one of the transforms is `size`; the proof of reach (checkReach) later decides whether the scope really gets
  /// smaller
  bool shrinks = false;
  std::vector<ExprId> factors;  ///< the factors of all `scale` transforms in the list
};
TransformEffect checkTransforms(CheckContext& check, Symbols& symbols, Types& types, IdRange xforms);

/// Declares the local name of a `footprint` statement.
void checkFootprint(CheckContext& check, Types& types, StmtId id, const StmtNode& s);
/// Checks the `plan` of an extrusion or a roof, if present. body: the block of the enclosing rule or override. If the
/// plan's name is unknown in its place, a footprint of that name elsewhere in this block is suggested.
void checkPlan(CheckContext& check, Symbols& symbols, Types& types, const StmtNode& s, StmtId body);
void checkRoof(CheckContext& check, Symbols& symbols, Types& types, const StmtNode& s, StmtId body);

void checkFit(CheckContext& check, Symbols& symbols, Types& types, const StmtNode& s);

/// Checks the rooms of a treemap and the doors (links) between them.
void checkRooms(CheckContext& check, Symbols& symbols, Types& types, const StmtNode& s);

/// Checks the tiles of a wfc: their sizes and weights, and that each side of a tile fits some other side.
void checkTiles(CheckContext& check, Types& types, const StmtNode& s);

}  // namespace sgm
