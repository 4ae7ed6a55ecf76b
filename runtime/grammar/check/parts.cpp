// Checks statements that divide a scope into parts: split, comp, treemap and wfc.

#include "grammar/check/statements.h"
#include "grammar/syntax/scope_parts.h"
#include "grammar/text/codes.h"

namespace sgm {

namespace {

/// Returns the first call `box(scope)` in statement `id`; kNoId if there is none. Looks into blocks, cut and unite, but
/// not into statements that may change the scope, so the call uses the scope in which `id` itself is evaluated.
ExprId boxOfScope(const Program& program, StmtId id) {
  const StmtNode& s = program.stmt(id);
  if (s.kind == StmtKind::block || s.kind == StmtKind::cut || s.kind == StmtKind::unite) {
    ExprId found = s.body == kNoId ? kNoId : boxOfScope(program, s.body);
    for (uint32_t i = 0; found == kNoId && i < s.children.count; ++i)
      found = boxOfScope(program, program.idAt(s.children, i));
    return found;
  }
  if (s.kind != StmtKind::call) return kNoId;
  const ExprNode& call = program.expr(s.expr);
  if (call.ref != Ref::primitive || static_cast<Primitive>(call.id) != Primitive::box || call.args.count != 1)
    return kNoId;
  const ExprNode& edges = program.expr(program.ast.args[call.args.first].value);
  const bool scope = edges.ref == Ref::value && static_cast<BuiltinValue>(edges.id) == BuiltinValue::scope;
  return scope ? s.expr : kNoId;
}

/// Whether the part's scope is flat: a face of a box, or the outer wall of a room.
bool isFlat(const StmtNode& s, const PartNode& part) {
  if (s.kind == StmtKind::treemap) return part.floor == FloorPart::facade;
  return s.kind == StmtKind::comp && part.of != BoxPart::edges && part.of != BoxPart::inside;
}

}  // namespace

void Statements::checkSplit(const StmtNode& s) {
  types_.requireRange(s.amount, kLength, "the snap reach of a split", kSnapReachRange);
  for (uint32_t i = 0; i < s.parts.count; ++i) {
    PartNode& part = check_.program.ast.parts[s.parts.first + i];
    const ExprId size = part.size;
    const Type type = types_.checkExpression(size);
    part.relative = !part.flexible && type.kind == ValueKind::number && !type.any_dim && type.dim == kRatio;
    types_.requireType(size, type, ValueKind::number, part.relative ? kRatio : kLength,
                       part.flexible ? "a flexible size" : "the size of a part");
    // A number above 1 is probably a length without its unit.
    if (part.relative && check_.node(size).kind == ExprKind::number && check_.node(size).value > 1)
      check_.sink.error(check_.node(size).span, codes::kValueRange, "a part cannot be more than 100% of the scope",
                        "write a length, such as 2m, or a share, such as 25%");
  }
  checkParts(s);
}

void Statements::checkParts(const StmtNode& s) {
  for (uint32_t i = 0; i < s.children.count; ++i) {
    const size_t locals = types_.scope().locals.size();
    const StmtId child = check_.program.idAt(s.children, i);
    checkStatement(child, true);
    types_.scope().closeTo(locals);
    if (i >= s.parts.count || !isFlat(s, check_.program.ast.parts[s.parts.first + i])) continue;
    if (const ExprId box = boxOfScope(check_.program, child); box != kNoId)
      check_.sink.warning(check_.node(box).span, codes::kFlatScope,
                          "the scope of a face has no depth, so this box is left out",
                          "give it one: `size(z 0.2m) box(scope)`");
  }
}

}  // namespace sgm
