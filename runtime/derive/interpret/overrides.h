#pragma once
// Derives what overrides replace: their blocks, and `inner` in them.

#include <cstddef>
#include <cstdint>

#include "derive/interpret/cell_context.h"
#include "derive/interpret/env.h"

namespace sgm::interpret {

/// Derives the target under its first `below` overrides, of which the last is the outermost.
void runUnderEdits(const UnderEdit& what, size_t below, CellContext& c, Env& env, ShapeList& out);

/// Derives a block, or the meet or extrusion that has the block, under the overrides of its tag. room: as in UnderEdit.
void runTagged(const StmtNode& s, uint16_t tag, CellContext& c, const Env& env, ShapeList& out, bool room = false);

/// The statement `inner`: the content that the override's block replaces.
void runInner(const StmtNode& s, CellContext& c, const Env& env, ShapeList& out);

}  // namespace sgm::interpret
