// Evaluates expressions. A number that is known during derivation is a constant; a number that depends on the sample
// position is an expression of the field, which Draft folds and shares.

#include <algorithm>
#include <bit>
#include <utility>

#include "base/math.h"
#include "derive/interpret/evaluator.h"

namespace sgm::interpret {
namespace {

bool isTuple(const Value& v) { return v.kind == ValueKind::vector || v.kind == ValueKind::pair; }

size_t partsOf(const Value& v) { return v.kind == ValueKind::vector ? 3 : v.kind == ValueKind::pair ? 2 : 1; }

}  // namespace

Value Evaluator::evaluate(ExprId id, const Env& env) {
  if (budget_.failed() || id == kNoId) return {};
  const ExprNode& node = program_.expr(id);
  if (!budget_.step(1, node.span, env.activation)) return {};
  const Nested nested = budget_.nest();
  if (!budget_.withinNesting(node.span, env.activation)) return {};
  const auto child = [&](uint32_t i) { return evaluate(program_.idAt(node.children, i), env); };
  switch (node.kind) {
    case ExprKind::number:
      return Value::number(node.value);
    case ExprKind::text: {
      Value v;
      v.kind = ValueKind::text;
      return v;
    }
    case ExprKind::vector: {
      Value v;
      v.kind = node.children.count == 2 ? ValueKind::pair : ValueKind::vector;
      for (uint32_t i = 0; i < node.children.count && i < 3; ++i) v.n[i] = child(i).n[0];
      return v;
    }
    case ExprKind::negate: {
      Value v = child(0);
      for (size_t i = 0; i < partsOf(v); ++i) v.n[i] = draft_.unary(ExprOp::negate, v.n[i]);
      return v;
    }
    case ExprKind::logical_not:
      return Value::boolean(draft_.binary(ExprOp::subtract, {1}, child(0).n[0]));
    case ExprKind::binary:
      return evaluateBinary(node, env);
    case ExprKind::conditional: {
      const Num condition = child(0).n[0];
      if (condition.constant()) return child(condition.value != 0 ? 1 : 2);
      Value yes = child(1);
      const Value no = child(2);
      for (size_t i = 0; i < partsOf(yes); ++i) yes.n[i] = draft_.mix(no.n[i], yes.n[i], condition);
      return yes;
    }
    case ExprKind::range: {
      Value v;
      v.kind = ValueKind::range;
      v.n = {child(0).n[0], child(1).n[0], Num{}};
      return v;
    }
    case ExprKind::name:
      return evaluateName(node, env);
    case ExprKind::member:
      return evaluateMember(node, env);
    case ExprKind::call:
      return evaluateCall(node, env);
    case ExprKind::query:
      return evaluateQuery(node, env);
  }
  return {};
}

Value Evaluator::evaluateBinary(const ExprNode& node, const Env& env) {
  const Value a = evaluate(program_.idAt(node.children, 0), env);
  const Value b = evaluate(program_.idAt(node.children, 1), env);
  const auto arithmetic = [&](ExprOp op) {
    Value result = isTuple(a) ? a : b;
    for (size_t i = 0; i < partsOf(result); ++i) {
      result.n[i] = draft_.binary(op, a.n[isTuple(a) ? i : 0], b.n[isTuple(b) ? i : 0]);
    }
    return result;
  };
  const auto less = [&](const Value& l, const Value& r) { return draft_.binary(ExprOp::less, l.n[0], r.n[0]); };
  const auto negated = [&](Num n) { return draft_.binary(ExprOp::subtract, {1}, n); };
  const auto equal = [&]() -> Num {
    if (a.kind == ValueKind::cell || a.kind == ValueKind::face) {
      return {a.cell == b.cell && a.axis == b.axis ? 1.0 : 0.0};
    }
    const Num below = less(a, b), above = less(b, a);
    return negated(draft_.binary(ExprOp::maximum, below, above));
  };
  switch (node.binary) {
    case BinaryOp::add:
      return arithmetic(ExprOp::add);
    case BinaryOp::subtract:
      return arithmetic(ExprOp::subtract);
    case BinaryOp::multiply:
      return arithmetic(ExprOp::multiply);
    case BinaryOp::divide:
      return arithmetic(ExprOp::divide);
    case BinaryOp::less:
      return Value::boolean(less(a, b));
    case BinaryOp::less_equal:
      return Value::boolean(negated(less(b, a)));
    case BinaryOp::greater:
      return Value::boolean(less(b, a));
    case BinaryOp::greater_equal:
      return Value::boolean(negated(less(a, b)));
    case BinaryOp::equal:
      return Value::boolean(equal());
    case BinaryOp::not_equal:
      return Value::boolean(negated(equal()));
    case BinaryOp::logical_and:
      return Value::boolean(draft_.binary(ExprOp::minimum, a.n[0], b.n[0]));
    case BinaryOp::logical_or:
      return Value::boolean(draft_.binary(ExprOp::maximum, a.n[0], b.n[0]));
  }
  return {};
}

Value Evaluator::evaluateQuery(const ExprNode& node, const Env& env) {
  Ball ball{env.place.snap({}), 0};
  if (node.children.count > 0) {
    const double radius = real(program_.idAt(node.children, 0), env);
    if (budget_.failed()) return {};
    if (!(radius >= 0))
      budget_.note("the radius of a query is 0m or more; this one counts as 0m: bound it, such as max(r, 0m)",
                   node.span, env.activation);
    ball.radius = std::max(0, toUnits(radius * env.place.scale));
  }
  const BallProof proof = in_.lower.prove(node.id, ball, node.inside ? BoxContent::solid : BoxContent::open);
  if (!budget_.step(proof.pieces, node.span, env.activation)) return {};
  return Value::boolean({proof.holds ? 1.0 : 0.0});
}

Value Evaluator::evaluateName(const ExprNode& node, const Env& env) {
  switch (node.ref) {
    case Ref::parameter:
      parameters_read_ |= parameterBit(node.id);
      return Value::number(in_.parameters.values[node.id]);
    case Ref::let:
      return evaluateLet(node, env);
    case Ref::field:
      return evaluateField(node, env);
    case Ref::local:
      return env.slots != nullptr && node.id < env.slots->size() ? (*env.slots)[node.id] : Value{};
    case Ref::value:
      break;
    default:
      return {};
  }
  switch (static_cast<BuiltinValue>(node.id)) {
    case BuiltinValue::cell:
      return Value::ofCell(in_.cell);
    case BuiltinValue::scope:
      return Value::vector(env.scope);
    case BuiltinValue::p:
      return sampleCoordinates(env, false);
    case BuiltinValue::q:
      return sampleCoordinates(env, true);
    case BuiltinValue::u:
      if (env.sweep != kNone) return Value::number(draft_.sweep(env.sweep));
      budget_.note("u is 0: nothing is swept around this field; use it on a tube or a beam", node.span, env.activation);
      return Value::number(0);
  }
  return {};
}

Value Evaluator::sampleCoordinates(const Env& env, bool local) {
  if (!local) {
    const Num x = draft_.coordinate({}, {1, 0, 0});
    const Num y = draft_.coordinate({}, {0, 1, 0});
    const Num z = draft_.coordinate({}, {0, 0, 1});
    return Value::vector(x, y, z);
  }
  // The anchor of a coordinate expression is the scope's origin rounded to units; the rounding error is added back
  // below.
  const Placement& at = env.place;
  const Int3 anchor = at.snap({});
  const Int3 from_base = saturatingSub(anchor, at.base);
  const Vec3 rest = at.fromCell({metres(from_base.x), metres(from_base.y), metres(from_base.z)});
  std::array<Num, 3> q;
  for (size_t i = 0; i < 3; ++i) {
    const Num along =
        draft_.coordinate(anchor, {at.axes[i] / at.scale, at.axes[3 + i] / at.scale, at.axes[6 + i] / at.scale});
    q[i] = draft_.binary(ExprOp::add, along, {rest[static_cast<int>(i)]});
  }
  return Value::vector(q[0], q[1], q[2]);
}

Value Evaluator::evaluateMember(const ExprNode& node, const Env& env) {
  const Value v = evaluate(program_.idAt(node.children, 0), env);
  // After an error, evaluation may have returned a value of another kind than a segment.
  const auto segmentOf = [&](const Value& of) {
    return of.kind == ValueKind::segment ? segments_[of.first] : Segment{};
  };
  switch (node.member) {
    case Member::x:
    case Member::y:
    case Member::z: {
      const int axis = node.member == Member::x ? 0 : node.member == Member::y ? 1 : 2;
      if (v.kind == ValueKind::cell) return Value::number(v.cell[axis]);
      if (v.kind == ValueKind::pair) return Value::number(v.n[axis == 0 ? 0 : 1]);
      return Value::number(v.n[static_cast<size_t>(axis)]);
    }
    case Member::other:
      return Value::ofCell(v.face().upper());
    case Member::axis:
      return Value::number(v.axis);
    case Member::size: {
      Vec3 size{metres(in_.lattice.size.x), metres(in_.lattice.size.y), metres(in_.lattice.size.z)};
      if (v.kind == ValueKind::face) size[v.axis] = 0;
      return Value::vector(size);
    }
    case Member::center:
      return pointValue(v.kind == ValueKind::face ? in_.lattice.facePoint(in_.cell, v.face(), 0)
                                                  : in_.lattice.point(in_.cell, v.cell, 0),
                        env);
    case Member::faces:
      return Value::ofFaces(in_.lattice.ownedFaces(v.cell));
    case Member::from:
      return Value::vector(segmentOf(v).from);
    case Member::to:
      return Value::vector(segmentOf(v).to);
    case Member::along:
      return Value::number(segmentOf(v).along);
    case Member::depth:
      return Value::number(segmentOf(v).depth);
    case Member::none:
      break;
  }
  return {};
}

Value Evaluator::pointValue(Int3 units_from_cell, const Env& env) const {
  const Vec3 at = in_.origin() + Vec3{metres(units_from_cell.x), metres(units_from_cell.y), metres(units_from_cell.z)};
  return Value::vector(env.activation == kNone ? at : activations_[env.activation].start.fromCell(at));
}

Value Evaluator::evaluateCall(const ExprNode& node, const Env& env) {
  switch (node.ref) {
    case Ref::let:
      return evaluateLet(node, env);
    case Ref::field:
      return evaluateField(node, env);
    case Ref::builtin:
      return evaluateBuiltin(node, env);
    default:
      return {};
  }
}

Value Evaluator::evaluateLet(const ExprNode& node, const Env& env) {
  const Let& let = program_.lets[node.id];
  std::vector<Value> slots(std::max(let.slot_count, let.formals.count));
  // Random draws in a `let` depend on the path and on the values of its arguments, so draws for different arguments are
  // independent.
  uint64_t given = 0;
  for (uint32_t i = 0; i < let.formals.count; ++i) {
    slots[i] = evaluate(boundAt(node, i), env);
    given = hashCombine(given, keyOf(slots[i]).value);
  }
  Env inner = env;
  inner.slots = &slots;
  inner.key = env.key.child(hashText(program_.text(let.name)), given);
  return evaluate(let.body, inner);
}

Value Evaluator::evaluateField(const ExprNode& node, const Env& env) {
  const Field& field = program_.fields[node.id];
  std::vector<Value> given;
  for (uint32_t i = 0; i < field.formals.count; ++i) given.push_back(evaluate(boundAt(node, i), env));
  std::vector<Value> own(field.local ? 0 : std::max(field.slot_count, field.formals.count));
  Env inner = env;
  if (!field.local) inner.slots = &own;
  for (uint32_t i = 0; i < field.formals.count; ++i) {
    const uint32_t slot = program_.ast.formals[field.formals.first + i].slot;
    if (inner.slots != nullptr && slot < inner.slots->size()) (*inner.slots)[slot] = given[i];
  }
  return evaluate(field.body, inner);
}

ExprId Evaluator::boundAt(const ExprNode& node, uint32_t index) const {
  return index < node.bound.count ? program_.idAt(node.bound, index) : kNoId;
}

void Evaluator::addPiece(PlanPiece piece) {
  pieces_.push_back(std::move(piece));
  budget_.hold(sizeof(PlanPiece) + 4 * sizeof(PlanCorner));
}

PathKey Evaluator::keyOf(const Value& v) const {
  if (v.kind == ValueKind::cell) return in_.lattice.cellKey(v.cell);
  if (v.kind == ValueKind::face) return in_.lattice.faceKey(v.face());
  if (v.kind == ValueKind::segment) return segments_[v.first].key;
  PathKey key{in_.seed};
  for (size_t i = 0; i < partsOf(v); ++i) {
    // Adding 0 turns -0 into 0, so that both give the same key.
    key = {hashCombine(key.value, std::bit_cast<uint64_t>(v.n[i].value + 0.0))};
  }
  return key;
}

}  // namespace sgm::interpret
