#include "grammar/range/reach_values.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/math.h"

namespace sgm {

namespace {

constexpr int kDeepestPiece = 8;    // maximum number of halvings of one argument's range
constexpr int kDeepestValue = 600;  // maximum depth of nested evaluations, which bounds the stack

Interval compare(BinaryOp op, Interval a, Interval b) {
  switch (op) {
    case BinaryOp::less:
      return a.hi < b.lo ? kTrue : a.lo >= b.hi ? kFalse : kEither;
    case BinaryOp::less_equal:
      return a.hi <= b.lo ? kTrue : a.lo > b.hi ? kFalse : kEither;
    case BinaryOp::greater:
      return compare(BinaryOp::less, b, a);
    case BinaryOp::greater_equal:
      return compare(BinaryOp::less_equal, b, a);
    case BinaryOp::equal:
      return a.exact() && a == b ? kTrue : a.hi < b.lo || b.hi < a.lo ? kFalse : kEither;
    case BinaryOp::not_equal: {
      const Interval equal = compare(BinaryOp::equal, a, b);
      return {1 - equal.hi, 1 - equal.lo};
    }
    default:
      return kEither;
  }
}

}  // namespace

RangeEvaluator::RangeEvaluator(const Program& program, uint32_t& steps)
    : program_(program), steps_(steps), used_parameters_(program.params.size(), false), calls_(program) {
  // The host may set any number for a parameter without a declared range.
  for (const Param& param : program.params)
    parameters_.push_back(param.has_range ? Interval{param.low, param.high} : Interval::everything());
}

void RangeEvaluator::compareArguments(ExprId call, IdRange formals, std::span<const RangeValue> given) {
  if (!pieces_) misfits_.compare(program_, call, formals, given, calls_);
}

Interval RangeEvaluator::number(ExprId id, const RangeFrame& frame) {
  const RangeValue value = evaluate(id, frame);
  return value.kind == ValueKind::number ? value.v[0] : Interval::everything();
}

IntervalVector RangeEvaluator::vector(ExprId id, const RangeFrame& frame) {
  const RangeValue value = evaluate(id, frame);
  if (value.kind == ValueKind::vector || value.kind == ValueKind::pair) return value.v;
  return {Interval::everything(), Interval::everything(), Interval::everything()};
}

Interval RangeEvaluator::condition(ExprId id, const RangeFrame& frame) {
  const RangeValue value = evaluate(id, frame);
  return value.kind == ValueKind::boolean ? value.v[0] : kEither;
}

RangeValue RangeEvaluator::evaluate(ExprId id, const RangeFrame& frame) {
  if (id == kNoId || steps_ == 0 || depth_ >= kDeepestValue) return RangeValue::unknown();
  --steps_;
  ++depth_;
  const uint32_t before = losses_.takeLatest();
  RangeValue out = evaluateNode(id, frame);
  const uint32_t inside = losses_.takeLatest();
  // `loss` names the expression that made the value unbounded. So a bounded value has none, even if an operand has one.
  if (out.bounded())
    out.loss = 0;
  else if (out.loss == 0)
    out.loss = inside;
  losses_.restoreLatest(before != 0 ? before : out.loss);
  --depth_;
  return out;
}

RangeValue RangeEvaluator::evaluateNode(ExprId id, const RangeFrame& frame) {
  const ExprNode& n = program_.expr(id);
  RangeValue out;
  switch (n.kind) {
    case ExprKind::number:
      out = n.type.kind == ValueKind::boolean ? RangeValue::condition(Interval::exactly(n.value))
                                              : RangeValue::number(Interval::exactly(n.value));
      break;
    case ExprKind::vector: {
      out.kind = n.children.count == 3 ? ValueKind::vector : ValueKind::pair;
      for (uint32_t i = 0; i < n.children.count && i < 3; ++i) out.v[i] = number(child(n, i), frame);
      break;
    }
    case ExprKind::negate:
      out = evaluate(child(n, 0), frame);
      for (Interval& part : out.v) part = -part;
      break;
    case ExprKind::logical_not: {
      const Interval c = condition(child(n, 0), frame);
      out = RangeValue::condition({1 - c.hi, 1 - c.lo});
      break;
    }
    case ExprKind::binary:
      out = binary(id, frame);
      break;
    case ExprKind::conditional: {
      const Interval c = condition(child(n, 0), frame);
      if (c == kTrue) {
        out = evaluate(child(n, 1), frame);
      } else if (c == kFalse) {
        out = evaluate(child(n, 2), frame);
      } else {
        const RangeValue a = evaluate(child(n, 1), frame), b = evaluate(child(n, 2), frame);
        if (a.kind == b.kind) {
          out.kind = a.kind;
          for (size_t i = 0; i < 3; ++i) out.v[i] = hull(a.v[i], b.v[i]), out.at[i] = hull(a.at[i], b.at[i]);
        }
      }
      break;
    }
    case ExprKind::name:
    case ExprKind::call:
      out = call(id, frame);
      break;
    case ExprKind::member:
      out = member(n, frame);
      break;
    case ExprKind::query:
      out = query(id, frame);
      break;
    case ExprKind::text:
    case ExprKind::range:
      break;
  }
  return out;
}

RangeValue RangeEvaluator::query(ExprId id, const RangeFrame& frame) {
  const ExprNode& n = program_.expr(id);
  dependence_.place = dependence_.scale = true;
  const double radius = n.children.count == 0 ? 0 : std::max(0.0, number(child(n, 0), frame).hi);
  const double ball = boundProduct(radius, frame.place.scale.magnitude());
  for (size_t i = 0; i < 3; ++i) {
    if (cell_[i].hi == 0) continue;
    const Interval at = frame.place.offset[i];
    const Interval cell = Interval{low_, low_ + 1} * cell_[i];
    const double far = std::max(cell.lo - at.lo, at.hi - cell.hi) + ball;
    if (far > observation_.distance_m) observation_ = {far, id};
  }
  return RangeValue::condition(kEither);
}

RangeValue RangeEvaluator::binary(ExprId id, const RangeFrame& frame) {
  const ExprNode& n = program_.expr(id);
  if (n.binary == BinaryOp::logical_and || n.binary == BinaryOp::logical_or) {
    const Interval a = condition(child(n, 0), frame), b = condition(child(n, 1), frame);
    return RangeValue::condition(n.binary == BinaryOp::logical_and ? minimum(a, b) : maximum(a, b));
  }
  const RangeValue a = evaluate(child(n, 0), frame), b = evaluate(child(n, 1), frame);
  if (n.binary >= BinaryOp::less && n.binary <= BinaryOp::not_equal)
    return RangeValue::condition(
        a.kind == ValueKind::number && b.kind == ValueKind::number ? compare(n.binary, a.v[0], b.v[0]) : kEither);
  const bool a_vector = a.kind == ValueKind::vector, b_vector = b.kind == ValueKind::vector;
  RangeValue out;
  out.kind = a_vector || b_vector ? ValueKind::vector : ValueKind::number;
  for (size_t i = 0; i < (a_vector || b_vector ? 3u : 1u); ++i) {
    const Interval x = a.v[a_vector ? i : 0], y = b.v[b_vector ? i : 0];
    switch (n.binary) {
      case BinaryOp::add:
        out.v[i] = x + y;
        break;
      case BinaryOp::subtract:
        out.v[i] = x - y;
        break;
      case BinaryOp::multiply:
        out.v[i] = x * y;
        break;
      default:
        if (i == 0 && y.holds(0) && b.loss == 0)
          losses_.add({BoundLoss::Cause::divisor, id, calls_.writtenCaller(id), y});
        out.v[i] = x / y;
        break;
    }
  }
  return out;
}

RangeValue RangeEvaluator::call(ExprId id, const RangeFrame& frame) {
  const ExprNode& n = program_.expr(id);
  switch (n.ref) {
    case Ref::parameter:
      used_parameters_[n.id] = true;
      if (!parameters_[n.id].bounded()) losses_.add({BoundLoss::Cause::parameter, id, calls_.writtenCaller(id), {}});
      return RangeValue::number(parameters_[n.id]);
    case Ref::local:
      return n.id < frame.slots.size() ? frame.slots[n.id] : RangeValue::unknown();
    case Ref::value: {
      const Interval all = Interval::everything();
      switch (static_cast<BuiltinValue>(n.id)) {
        case BuiltinValue::cell:
          return {ValueKind::cell, {Interval{}, Interval{}, Interval{}}};
        case BuiltinValue::scope:
          return RangeValue::vector(frame.scope);
        case BuiltinValue::u:
          return RangeValue::number({0, 1});
        default:
          return RangeValue::vector({all, all, all});
      }
    }
    case Ref::let:
    case Ref::field:
      return applied(id, frame);
    case Ref::builtin:
      return builtin(n, frame);
    default:
      return RangeValue::unknown();
  }
}

RangeValue RangeEvaluator::applied(ExprId id, const RangeFrame& frame) {
  const ExprNode& n = program_.expr(id);
  const bool is_let = n.ref == Ref::let;
  const IdRange formals = is_let ? program_.lets[n.id].formals : program_.fields[n.id].formals;
  const ExprId body = is_let ? program_.lets[n.id].body : program_.fields[n.id].body;
  RangeFrame inner;
  if (!is_let && program_.fields[n.id].local) inner = frame;
  inner.start = frame.start;
  inner.place = frame.place;
  inner.scope = frame.scope;
  std::vector<RangeValue> given;
  for (uint32_t i = 0; i < formals.count && i < n.bound.count; ++i) {
    const uint32_t slot = program_.ast.formals[formals.first + i].slot;
    if (inner.slots.size() <= slot) inner.slots.resize(slot + 1);
    given.push_back(evaluate(program_.idAt(n.bound, i), frame));
    inner.slots[slot] = given.back();
  }
  compareArguments(id, formals, given);
  calls_.enter(id);
  RangeValue out = evaluate(body, inner);
  for (uint32_t i = 0; pieces_ && !out.bounded() && i < formals.count && i < n.bound.count; ++i) {
    const uint32_t slot = program_.ast.formals[formals.first + i].slot;
    if (!hasPieces(inner.slots[slot])) continue;
    if (const auto tighter = inPieces(body, inner, slot, inner.slots[slot].v[0], 0)) out = *tighter;
  }
  calls_.leave();
  return out;
}

std::optional<RangeValue> RangeEvaluator::inPieces(ExprId body, RangeFrame& frame, uint32_t slot, Interval range,
                                                   int depth) {
  RangeValue& argument = frame.slots[slot];
  const Interval whole = std::exchange(argument.v[0], range);
  const bool cut = depth < kDeepestPiece && hasPieces(argument);
  std::optional<RangeValue> out;
  if (depth > 0) out = evaluate(body, frame);
  if (depth == 0 || !out->bounded()) {
    out.reset();
    const double middle = dividingPoint(range);
    const auto low = cut ? inPieces(body, frame, slot, {range.lo, middle}, depth + 1) : std::nullopt;
    const auto high = low ? inPieces(body, frame, slot, {middle, range.hi}, depth + 1) : std::nullopt;
    if (high && low->kind == high->kind) {
      out = low;
      for (size_t i = 0; i < 3; ++i)
        out->v[i] = hull(low->v[i], high->v[i]), out->at[i] = hull(low->at[i], high->at[i]);
    }
  }
  argument.v[0] = whole;
  return out;
}

void RangeEvaluator::refine(ExprId id, bool holds, RangeFrame& frame) {
  const ExprNode& n = program_.expr(id);
  if (n.kind == ExprKind::logical_not) return refine(child(n, 0), !holds, frame);
  if (n.kind != ExprKind::binary) return;
  if (n.binary == (holds ? BinaryOp::logical_and : BinaryOp::logical_or)) {
    refine(child(n, 0), holds, frame);
    refine(child(n, 1), holds, frame);
    return;
  }
  if (n.binary < BinaryOp::less || n.binary > BinaryOp::greater_equal) return;
  for (uint32_t side = 0; side < 2; ++side) {
    const ExprNode& local = program_.expr(child(n, side));
    if (local.ref != Ref::local || local.id >= frame.slots.size() || frame.slots[local.id].kind != ValueKind::number)
      continue;
    const Interval other = number(child(n, 1 - side), frame);
    const bool less = n.binary == BinaryOp::less || n.binary == BinaryOp::less_equal;
    const bool below = (less == (side == 0)) == holds;  // true: the condition bounds the local from above
    Interval& value = frame.slots[local.id].v[0];
    if (below && other.hi < value.hi) value.hi = std::max(other.hi, value.lo);
    if (!below && other.lo > value.lo) value.lo = std::min(other.lo, value.hi);
  }
}

}  // namespace sgm
