#include "grammar/check/idle_cuts.h"

#include "grammar/text/codes.h"

namespace sgm {

namespace {

void cutsOf(const Program& program, DiagnosticSink& sink, StmtId id, bool first);

/// Checks the statements of a block that already contains something before its first statement, so that even a cut as
/// the first statement has an effect. Warns of idle cuts nested in these statements.
void cutsIn(const Program& program, DiagnosticSink& sink, StmtId block) {
  const IdRange children = program.stmt(block).children;
  for (uint32_t i = 0; i < children.count; ++i) cutsOf(program, sink, program.idAt(children, i), false);
}

/// Warns if the statement is a cut without effect: a cut removes only from content that precedes it in its block.
/// first: true if no content precedes this statement in its block.
void cutsOf(const Program& program, DiagnosticSink& sink, StmtId id, bool first) {
  if (id == kNoId || sink.full()) return;
  const StmtNode& s = program.stmt(id);
  switch (s.kind) {
    case StmtKind::transform:
    case StmtKind::repeat:
    case StmtKind::for_each:
    case StmtKind::scatter:
    case StmtKind::detail:
    case StmtKind::snap:
      return cutsOf(program, sink, s.body, first);
    case StmtKind::cut:
      if (first && !s.layer_level)
        sink.warning(s.span, codes::kIdleCut, "nothing stands before this cut in its block",
                     "a cut takes from what its own block has added before it");
      return cutsOf(program, sink, s.body, true);
    case StmtKind::block: {
      bool nothing = true;
      for (uint32_t i = 0; i < s.children.count; ++i) {
        const StmtId child = program.idAt(s.children, i);
        cutsOf(program, sink, child, nothing);
        const StmtKind kind = program.stmt(program.innermost(child)).kind;
        nothing = nothing &&
                  (kind == StmtKind::cut || kind == StmtKind::let || kind == StmtKind::field || kind == StmtKind::mat ||
                   kind == StmtKind::tag || kind == StmtKind::anchor || kind == StmtKind::footprint);
      }
      return;
    }
    case StmtKind::extrude:
      // The extruded shape precedes the statements of the block, so a cut that comes first has an effect.
      if (s.body != kNoId) cutsIn(program, sink, s.body);
      return;
    case StmtKind::treemap:
      // The open space of a room or corridor precedes the statements of its block, so a cut that comes first has an
      // effect.
      for (uint32_t i = 0; i < s.children.count; ++i) {
        const StmtId child = program.idAt(s.children, i);
        const bool open = program.ast.parts[s.parts.first + i].floor != FloorPart::facade;
        if (!open || program.stmt(child).kind != StmtKind::block) {
          cutsOf(program, sink, child, !open);
          continue;
        }
        cutsIn(program, sink, child);
      }
      return;
    case StmtKind::morph:
    case StmtKind::split:
    case StmtKind::comp:
    case StmtKind::wfc:
      for (uint32_t i = 0; i < s.children.count; ++i) cutsOf(program, sink, program.idAt(s.children, i), true);
      return;
    case StmtKind::call:
    case StmtKind::unite:
    case StmtKind::meet:
    case StmtKind::sum:
    case StmtKind::displace:
    case StmtKind::warp:
    case StmtKind::let:
    case StmtKind::field:
    case StmtKind::mat:
    case StmtKind::tag:
    case StmtKind::anchor:
    case StmtKind::link:
    case StmtKind::footprint:
    case StmtKind::roof:
    case StmtKind::inner:
    case StmtKind::fit:
    case StmtKind::border:
      return cutsOf(program, sink, s.body, true);
  }
}

}  // namespace

void warnOfIdleCuts(const Program& program, StmtId body, bool follows, DiagnosticSink& sink) {
  if (follows)
    cutsIn(program, sink, body);
  else
    cutsOf(program, sink, body, false);
}

}  // namespace sgm
