// Scopes in parts: split and comp.

#include <algorithm>

#include "grammar/check.h"
#include "grammar/codes.h"
#include "grammar/scope_parts.h"

namespace sgm {

void Checker::snapStatement(const StmtNode& s, bool shrunk) {
  demandRange(s.expr, kLength, "the distance of snap planes", kSnapRange);
  demand(s.amount, ValueKind::number, kLength, "the place of the first snap plane");
  statement(s.body, shrunk);
}

void Checker::splitStatement(const StmtNode& s) {
  demandRange(s.amount, kLength, "how far the lines of a split snap", kSnapReachRange);
  for (uint32_t i = 0; i < s.parts.count; ++i) {
    PartNode& part = program_.ast.parts[s.parts.first + i];
    const ExprId size = part.size;
    const Type type = expression(size);
    part.relative = !part.flexible && type.kind == ValueKind::number && !type.any_dim && type.dim == kRatio;
    demandType(size, type, ValueKind::number, part.relative ? kRatio : kLength,
               part.flexible ? "a flexible size" : "the size of a part");
    // Most likely a length without its unit.
    if (part.relative && node(size).kind == ExprKind::number && node(size).value > 1)
      sink_.error(node(size).span, codes::kValueRange, "a part cannot be more than 100% of the scope",
                  "write a length, such as 2m, or a share, such as 25%");
  }
  partStatements(s);
}

void Checker::partStatements(const StmtNode& s) {
  for (uint32_t i = 0; i < s.children.count; ++i) {
    const size_t locals = scope_.locals.size();
    statement(program_.idAt(s.children, i), true);
    scope_.locals.resize(std::min(locals, scope_.locals.size()));
  }
}

}  // namespace sgm
