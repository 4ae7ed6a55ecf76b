#pragma once
// Derives the blocks of overrides, and the statement `inner` in these blocks.

#include <cstddef>
#include <cstdint>

#include "derive/interpret/cell_context.h"
#include "derive/interpret/env.h"

namespace sgm::interpret {

/// Derives the content that overrides replace (the target, see UnderEdit) with only the first `below` of these
/// overrides applied. The last one applied is the outermost.
void runUnderEdits(const UnderEdit& what, size_t below, CellContext& c, Env& env, ShapeList& out);

/// Derives a block, or the meet or extrusion that contains it, with the overrides of its tag applied. room: see
/// UnderEdit::room.
void runTagged(const StmtNode& s, uint16_t tag, CellContext& c, const Env& env, ShapeList& out, bool room = false);

/// Derives the statement `inner`: the content that the override's block replaces.
void runInner(const StmtNode& s, CellContext& c, const Env& env, ShapeList& out);

}  // namespace sgm::interpret
