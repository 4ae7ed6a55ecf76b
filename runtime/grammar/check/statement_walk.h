#pragma once
// Walks through the statements of a body.

#include "grammar/syntax/program.h"

namespace sgm {

/// Calls visit(const StmtNode&) for every statement of a body, in source order. kNoId: no body.
template <class Visit>
void forEachStatement(const Program& program, StmtId id, const Visit& visit) {
  if (id == kNoId) return;
  const StmtNode& s = program.stmt(id);
  visit(s);
  forEachStatement(program, s.body, visit);
  for (uint32_t i = 0; i < s.children.count; ++i) forEachStatement(program, program.idAt(s.children, i), visit);
}

}  // namespace sgm
