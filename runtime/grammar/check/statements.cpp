#include "grammar/check/statements.h"

#include <algorithm>
#include <utility>

#include "grammar/check/leaf_statements.h"
#include "grammar/syntax/scope_parts.h"
#include "grammar/text/codes.h"

namespace sgm {

namespace {

bool isRoundOrBox(Primitive p) {
  return p == Primitive::sphere || p == Primitive::blob || p == Primitive::ellipsoid || p == Primitive::box ||
         p == Primitive::superq;
}

/// Reports the first statement that is not permitted in the body of a `sum`, which adds fields of primitives. Returns
/// whether all statements are permitted.
bool checkSumLeaves(CheckContext& check, StmtId id) {
  const StmtNode& s = check.program.stmt(id);
  switch (s.kind) {
    case StmtKind::cut:
    case StmtKind::meet:
    case StmtKind::displace:
    case StmtKind::warp:
    case StmtKind::roof:
    case StmtKind::fit:
      check.sink.error(s.span, codes::kWrongUse, "a sum has leaves only: spheres, blobs and other primitives",
                       "cut, displace or warp the sum as a whole");
      return false;
    case StmtKind::extrude:
      return s.body == kNoId || checkSumLeaves(check, s.body);
    case StmtKind::block:
      for (uint32_t i = 0; i < s.children.count; ++i)
        if (!checkSumLeaves(check, check.program.idAt(s.children, i))) return false;
      return true;
    case StmtKind::call:
    case StmtKind::unite:
    case StmtKind::sum:
    case StmtKind::morph:
    case StmtKind::transform:
    case StmtKind::repeat:
    case StmtKind::for_each:
    case StmtKind::scatter:
    case StmtKind::let:
    case StmtKind::field:
    case StmtKind::mat:
    case StmtKind::tag:
    case StmtKind::anchor:
    case StmtKind::split:
    case StmtKind::snap:
    case StmtKind::comp:
    case StmtKind::treemap:
    case StmtKind::link:
    case StmtKind::detail:
    case StmtKind::footprint:
    case StmtKind::inner:
    case StmtKind::wfc:
    case StmtKind::border:
      return true;
  }
  return true;
}

}  // namespace

void Statements::checkStatement(StmtId id, bool shrunk) {
  if (id == kNoId || check_.sink.full()) return;
  StmtNode& s = check_.program.ast.stmts[id];
  s.ordinal = ordinal_++;
  const StmtNode copy = s;
  switch (copy.kind) {
    case StmtKind::block:
      return checkBlock(id, copy, shrunk);
    case StmtKind::call:
      return callRule(copy.expr, false, shrunk);
    case StmtKind::sum:
      if (!checkSumLeaves(check_, copy.body)) return;
      [[fallthrough]];
    case StmtKind::unite:
    case StmtKind::cut:
    case StmtKind::meet:
      types_.require(copy.amount, ValueKind::number, kLength, "the width of a smooth join");
      return checkStatement(copy.body, shrunk);
    case StmtKind::morph:
      return checkMorph(copy, shrunk);
    case StmtKind::displace:
      types_.require(copy.expr, ValueKind::number, kLength, "a displacement", true);
      types_.require(copy.amount, ValueKind::number, kLength, "the bound of a displacement");
      return checkStatement(copy.body, shrunk);
    case StmtKind::warp:
      types_.require(copy.expr, ValueKind::vector, kLength, "a warp", true);
      types_.require(copy.amount, ValueKind::number, kLength, "the bound of a warp");
      return checkStatement(copy.body, shrunk);
    case StmtKind::transform:
      return checkTransform(copy, shrunk);
    case StmtKind::repeat:
      types_.require(copy.expr, ValueKind::number, kRatio, "a count");
      return checkTransform(copy, shrunk);
    case StmtKind::for_each:
      return checkLoop(id, copy, shrunk);
    case StmtKind::scatter:
      return checkScatter(copy, shrunk);
    case StmtKind::split:
      return checkSplit(copy);
    case StmtKind::snap:
      types_.requireRange(copy.expr, kLength, "the distance of snap planes", kSnapRange);
      types_.require(copy.amount, ValueKind::number, kLength, "the place of the first snap plane");
      return checkStatement(copy.body, shrunk);
    case StmtKind::comp:
      return checkParts(copy);
    case StmtKind::treemap:
      checkRooms(check_, symbols_, types_, copy);
      return checkParts(copy);
    case StmtKind::wfc:
      checkTiles(check_, types_, copy);
      return checkParts(copy);
    case StmtKind::let:
      return checkLet(id, copy);
    case StmtKind::field:
      return checkField(copy);
    case StmtKind::mat:
      check_.program.ast.stmts[id].extra = check_.tableIndex(check_.program.materials, copy.name, copy.span);
      return;
    case StmtKind::tag:
      check_.program.ast.stmts[id].extra = check_.tableIndex(check_.program.tags, copy.name, copy.span);
      return;
    case StmtKind::anchor:
      check_.program.ast.stmts[id].extra = check_.tableIndex(check_.program.names, copy.name, copy.span);
      check_.program.ast.stmts[id].extra2 =
          copy.name2 == kNoId ? 0 : check_.tableIndex(check_.program.names, copy.name2, copy.span);
      return;
    case StmtKind::detail:
      return checkDetail(copy, shrunk);
    case StmtKind::footprint:
      return checkFootprint(check_, types_, id, copy);
    case StmtKind::extrude:
      types_.require(copy.expr, ValueKind::number, kLength, "the height of an extrusion");
      checkPlan(check_, symbols_, types_, copy, body_);
      return checkStatement(copy.body, shrunk);
    case StmtKind::roof:
      return checkRoof(check_, symbols_, types_, copy, body_);
    case StmtKind::fit:
      return checkFit(check_, symbols_, types_, copy);
    case StmtKind::inner:
    case StmtKind::link:    // Nothing to do: a link is checked as a part of the treemap statement that contains it.
    case StmtKind::border:  // Nothing to do: a border is checked as a part of the wfc statement that contains it.
      return;
  }
}

/// Checks transform and repeat. shrunk: see RuleCall::shrunk. A `size` in the transform counts as making the scope
/// smaller, too, but not in a repeat.
void Statements::checkTransform(const StmtNode& s, bool shrunk) {
  const size_t outside = scales_.size();
  const bool copied = s.kind == StmtKind::repeat;
  const TransformEffect effect = checkTransforms(check_, symbols_, types_, s.xforms);
  for (const ExprId factor : effect.factors) scales_.push_back({factor, copied});
  checkStatement(s.body, shrunk || (effect.shrinks && !copied));
  scales_.resize(outside);
}

void Statements::checkBlock(StmtId id, const StmtNode& s, bool shrunk) {
  const size_t locals = types_.scope().locals.size();
  for (uint32_t i = 0; i < s.children.count; ++i) checkStatement(check_.program.idAt(s.children, i), shrunk);
  types_.scope().closeTo(locals);
  uint16_t material = 0, tag = 0;
  for (uint32_t i = 0; i < s.children.count; ++i) {
    const StmtNode& child = check_.program.stmt(check_.program.idAt(s.children, i));
    const bool is_material = child.kind == StmtKind::mat;
    if (!is_material && child.kind != StmtKind::tag) continue;
    uint16_t& word = is_material ? material : tag;
    if (word != 0)
      check_.sink.error(child.span, codes::kDuplicate,
                        is_material ? "this block has a second `mat`" : "this block has a second `tag`",
                        "it holds for the whole block; open another block for the other");
    word = static_cast<uint16_t>(child.extra);
  }
  check_.program.ast.stmts[id].material = material;
  check_.program.ast.stmts[id].tag = tag;
}

void Statements::checkLet(StmtId id, const StmtNode& s) {
  Type type = types_.checkExpression(s.expr);
  types_.requireDerived(s.expr, "a let");
  type.sample = false;
  const uint32_t slot = types_.scope().next_slot++;
  check_.program.ast.stmts[id].slot = slot;
  types_.declareLocal(s.name, s.span, {s.name, slot, type, kNoId, 0});
}

void Statements::checkField(const StmtNode& s) {
  Field& field = check_.program.fields[s.extra];
  for (uint32_t i = 0; i < field.formals.count; ++i)
    check_.program.ast.formals[field.formals.first + i].slot = types_.scope().next_slot++;
  const Local local{field.name, 0, {}, s.extra, types_.scope().locals.size()};
  types_.declareLocal(field.name, field.span, local);
  types_.scope().slot_count = std::max(types_.scope().slot_count, types_.scope().next_slot);
  field.slot_count = types_.scope().slot_count;
  if (field.formals.count > 0) return;
  // Check the body of a field without parameters here, so that errors are found even in a field that is never used. A
  // field with parameters is checked at its calls.
  const size_t locals = types_.scope().locals.size();
  types_.scope().locals.resize(local.depth);
  const bool in_field = std::exchange(types_.scope().field, true);
  Type type = types_.checkExpression(field.body);
  types_.scope().field = in_field;
  if (type.kind != ValueKind::number && type.kind != ValueKind::vector && type.kind != ValueKind::boolean &&
      type.kind != ValueKind::unknown)
    check_.sink.error(check_.node(field.body).span, codes::kTypeMismatch,
                      join({"a field gives a number or a vector, not a ", typeName(type)}),
                      "name it with `let` instead");
  if (locals > local.depth) types_.scope().locals.push_back(local);
}

void Statements::checkMorph(const StmtNode& s, bool shrunk) {
  types_.require(s.expr, ValueKind::number, kRatio, "the t of a morph", true);
  for (uint32_t i = 0; i < 2; ++i) {
    const StmtId operand = check_.program.idAt(s.children, i);
    checkStatement(operand, shrunk);
    if (!s.power) continue;
    const StmtNode& shape = check_.program.stmt(operand);
    const bool good = shape.kind == StmtKind::call && check_.node(shape.expr).ref == Ref::primitive &&
                      isRoundOrBox(static_cast<Primitive>(check_.node(shape.expr).id));
    const bool understood = shape.kind != StmtKind::call || check_.node(shape.expr).ref != Ref::none;
    if (!good && understood)
      check_.sink.error(shape.span, codes::kWrongUse, "`power` morphs spheres, ellipsoids, superquadrics and boxes",
                        "leave `power` out for a linear morph");
  }
}

}  // namespace sgm
