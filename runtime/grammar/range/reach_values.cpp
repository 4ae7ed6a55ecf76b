#include "grammar/range/reach_values.h"

#include <algorithm>
#include <cmath>

#include "base/math.h"

namespace sgm {

namespace {

constexpr int kDeepestPiece = 8;    // halvings of one argument's range
constexpr int kDeepestValue = 600;  // stack frames of this evaluation
constexpr Interval kEither{0, 1};
constexpr Interval kTrue{1, 1};
constexpr Interval kFalse{0, 0};

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

/// The field computes with floats: if a step lies at a whole number, the value may fall on either side.
Interval sampledFloats(Interval v) {
  auto whole = [](double x) { return x == std::floor(x) && std::fabs(x) < 1e6; };
  return {whole(v.lo) ? v.lo : v.lo - 1e-6 * std::fabs(v.lo) - 1e-9,
          whole(v.hi) ? v.hi : v.hi + 1e-6 * std::fabs(v.hi) + 1e-9};
}

}  // namespace

bool RangeValue::bounded() const {
  if (kind == ValueKind::number) return v[0].bounded();
  if (kind == ValueKind::pair) return v[0].bounded() && v[1].bounded();
  return kind != ValueKind::vector || (v[0].bounded() && v[1].bounded() && v[2].bounded());
}

bool isStandard(const Program& program, uint32_t file) {
  return file != 0 && program.modules[file].path.starts_with("std/");
}

bool hasPieces(const RangeValue& value) {
  return value.kind == ValueKind::number && value.v[0].bounded() && middleOf(value.v[0]) > value.v[0].lo &&
         middleOf(value.v[0]) < value.v[0].hi;
}

double middleOf(Interval range) {
  return range.lo > 0 ? std::sqrt(range.lo) * std::sqrt(range.hi) : range.lo + (range.hi - range.lo) / 2;
}

RangeEvaluator::RangeEvaluator(const Program& program, uint32_t& steps)
    : program_(program), steps_(steps), asked_parameters_(program.params.size(), false) {
  // Without a declared range the host may set any number.
  for (const Param& param : program.params)
    parameters_.push_back(param.has_range ? Interval{param.low, param.high} : Interval::everything());
}

IntervalVector anyDirection(const IntervalVector& v) {
  double sum = 0;
  for (const Interval& part : v) sum += part.magnitude() * part.magnitude();
  const double length = std::sqrt(sum) * (1 + 1e-12);
  const Interval ball{-length, length};
  return {ball, ball, ball};
}

void PlaceRange::move(const IntervalVector& by) {
  const IntervalVector step = turned ? anyDirection(by) : by;
  for (size_t i = 0; i < 3; ++i) offset[i] = offset[i] + step[i] * scale;
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
  const uint32_t before = std::exchange(loss_, 0);
  RangeValue out = valueOf(id, frame);
  // A bounded value does not inherit the losses of its operands.
  if (out.bounded())
    out.loss = 0;
  else if (out.loss == 0)
    out.loss = loss_;
  loss_ = before != 0 ? before : out.loss;
  --depth_;
  return out;
}

ExprId RangeEvaluator::callerOf(ExprId id) const {
  if (!isStandard(program_, program_.expr(id).span.file)) return kNoId;
  const auto written = std::find_if(callers_.rbegin(), callers_.rend(),
                                    [&](ExprId call) { return !isStandard(program_, program_.expr(call).span.file); });
  return written == callers_.rend() ? kNoId : *written;
}

void RangeEvaluator::lose(BoundLoss::Cause cause, ExprId id, Interval divisor) {
  constexpr size_t kMostKept = 256;
  const bool zero = cause == BoundLoss::Cause::divisor && divisor == Interval{0, 0};
  if (zero && zeros_.size() < kMostKept) zeros_.push_back({cause, id, callerOf(id), divisor});
  if (loss_ != 0) return;
  if (losses_.size() < kMostKept) losses_.push_back({cause, id, callerOf(id), divisor});
  loss_ = static_cast<uint32_t>(losses_.size() - 1);
}

RangeValue RangeEvaluator::valueOf(ExprId id, const RangeFrame& frame) {
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
  asked_.place = asked_.scale = true;
  const double radius = n.children.count == 0 ? 0 : std::max(0.0, number(child(n, 0), frame).hi);
  const double ball = boundProduct(radius, frame.place.scale.magnitude());
  for (size_t i = 0; i < 3; ++i) {
    if (cell_[i].hi == 0) continue;
    const Interval at = frame.place.offset[i];
    const Interval cell = Interval{low_, low_ + 1} * cell_[i];
    const double far = std::max(cell.lo - at.lo, at.hi - cell.hi) + ball;
    if (far > sight_.far) sight_ = {far, id};
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
        if (i == 0 && y.holds(0) && b.loss == 0) lose(BoundLoss::Cause::divisor, id, y);
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
      asked_parameters_[n.id] = true;
      if (!parameters_[n.id].bounded()) lose(BoundLoss::Cause::parameter, id, {});
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
  judge(id, formals, given);
  enter(id);
  RangeValue out = evaluate(body, inner);
  for (uint32_t i = 0; pieces_ && !out.bounded() && i < formals.count && i < n.bound.count; ++i) {
    const uint32_t slot = program_.ast.formals[formals.first + i].slot;
    if (!hasPieces(inner.slots[slot])) continue;
    if (const auto tighter = inPieces(body, inner, slot, inner.slots[slot].v[0], 0)) out = *tighter;
  }
  leave();
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
    const double middle = middleOf(range);
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

RangeValue RangeEvaluator::member(const ExprNode& n, const RangeFrame& frame) {
  const RangeValue of = evaluate(child(n, 0), frame);
  const bool place = of.kind == ValueKind::cell || of.kind == ValueKind::face;
  switch (n.member) {
    case Member::x:
    case Member::y:
    case Member::z:
      if (place || of.kind == ValueKind::unknown) return RangeValue::number(Interval::everything());
      return RangeValue::number(of.v[static_cast<size_t>(n.member) - static_cast<size_t>(Member::x)]);
    case Member::other: {
      RangeValue out{ValueKind::cell, of.v};
      for (size_t i = 0; i < 3; ++i) out.v[i] = of.v[i] + Interval{0, 1};
      return out;
    }
    case Member::axis:
      return RangeValue::number({0, 2});
    case Member::size:
      return RangeValue::vector(cell_);
    case Member::center: {
      if (!place) return RangeValue::unknown();
      // For a face: on the side between its cells, half way along the others.
      const Interval share = of.kind == ValueKind::face ? Interval{0.5, 1} : Interval{0.5, 0.5};
      return point({of.v[0] + share, of.v[1] + share, of.v[2] + share}, frame);
    }
    case Member::faces:
      return {ValueKind::faces, of.v};
    case Member::from:
    case Member::to:
      if (of.kind != ValueKind::segment) return RangeValue::unknown();
      return RangeValue::vector({of.v[0], of.v[0], of.v[0]});
    case Member::along:
      return RangeValue::number({0, 1});
    case Member::depth:
      return RangeValue::number(of.v[1]);
    default:
      return RangeValue::unknown();
  }
}

RangeValue RangeEvaluator::builtin(const ExprNode& n, const RangeFrame& frame) {
  const Builtin id = static_cast<Builtin>(n.id);
  auto arg = [&](uint32_t i) { return program_.idAt(n.bound, i); };
  auto in = [&](uint32_t i) { return number(arg(i), frame); };
  switch (id) {
    case Builtin::min:
      return RangeValue::number(minimum(in(0), in(1)));
    case Builtin::max:
      return RangeValue::number(maximum(in(0), in(1)));
    case Builtin::abs:
      return RangeValue::number(absolute(in(0)));
    case Builtin::floor:
      return RangeValue::number(floorOf(program_.expr(arg(0)).type.sample ? sampledFloats(in(0)) : in(0)));
    case Builtin::ceil:
      return RangeValue::number(-floorOf(-in(0)));
    case Builtin::sqrt:
      return RangeValue::number(squareRoot(in(0)));
    case Builtin::mix: {
      const Interval a = in(0), b = in(1), t = in(2);
      const Interval line = a + (b - a) * t, both = hull(a, b);
      // For t in 0..1 the value lies between the ends, whatever a and b have in common; the line is tighter if t is
      // known.
      if (t.lo >= 0 && t.hi <= 1) return RangeValue::number({std::max(line.lo, both.lo), std::min(line.hi, both.hi)});
      return RangeValue::number(line);
    }
    case Builtin::clamp:
      return RangeValue::number(minimum(maximum(in(0), in(1)), in(2)));
    case Builtin::smoothstep:
      return RangeValue::number(smoothStep(in(0), in(1), in(2)));
    case Builtin::fract:
      in(0);  // the queries in its operand
      return RangeValue::number({0, 1});
    case Builtin::sin:
      return RangeValue::number(sine(in(0)));
    case Builtin::cos:
      return RangeValue::number(cosine(in(0)));
    case Builtin::atan2:
      return RangeValue::number({-3.1415926535897936, 3.1415926535897936});
    case Builtin::pow:
      return RangeValue::number(power(in(0), in(1)));
    case Builtin::length: {
      const IntervalVector v = vector(arg(0), frame);
      Interval sum{};
      for (const Interval& part : v) sum = sum + absolute(part) * absolute(part);
      return RangeValue::number(squareRoot(sum));
    }
    case Builtin::rand:
      return RangeValue::number(hull(in(0), in(1)));
    case Builtin::rand_keyed:
      return RangeValue::number(hull(in(1), in(2)));
    case Builtin::chance: {
      const Interval p = in(0);
      return RangeValue::condition(p.lo >= 1 ? kTrue : p.hi <= 0 ? kFalse : kEither);
    }
    case Builtin::chance_keyed: {
      const Interval p = in(1);
      return RangeValue::condition(p.lo >= 1 ? kTrue : p.hi <= 0 ? kFalse : kEither);
    }
    case Builtin::cell_noise:
      return RangeValue::number({0, 1});
    case Builtin::fractal:
      in(0);
      return RangeValue::number({-1, 1});
    case Builtin::cell_point:
    case Builtin::face_point: {
      const RangeValue of = evaluate(arg(0), frame);
      if (of.kind != ValueKind::cell && of.kind != ValueKind::face) return RangeValue::unknown();
      Interval jitter = arg(1) == kNoId ? Interval{0.5, 0.5} : in(1);
      jitter = minimum(maximum(jitter, {0, 0}), {1, 1});
      const double half = jitter.hi / 2;
      Interval spread{0.5 - half, 0.5 + half};
      // On one axis a point of a face lies on the side between its cells.
      if (of.kind == ValueKind::face) spread.hi = 1;
      return point({of.v[0] + spread, of.v[1] + spread, of.v[2] + spread}, frame);
    }
    case Builtin::cell_links:
      return {ValueKind::faces, evaluate(arg(0), frame).v};
    case Builtin::position:
      return RangeValue::vector({in(0), in(1), in(2)});
    case Builtin::branch: {
      // Ends are no farther than all steps in a straight line, with room for the rounding of each.
      const double steps = std::floor(std::clamp(in(0).hi + 0.5, 0.0, static_cast<double>(kMostSegments)));
      const double far = boundProduct(steps, std::max(0.0, in(1).hi)) * (1 + 1e-9);
      return {ValueKind::segments, {Interval{-far, far}, Interval{0, std::max(0.0, steps - 1)}, Interval{}}, {}};
    }
  }
  return RangeValue::unknown();
}

RangeValue RangeEvaluator::point(const IntervalVector& cells, const RangeFrame& frame) {
  RangeValue out = RangeValue::vector(cells);
  for (size_t i = 0; i < 3; ++i) out.v[i] = (cells[i] + Interval::exactly(low_)) * cell_[i];
  asked_.place = true;
  const PlaceRange& start = frame.start;
  if (start == PlaceRange{}) return out;
  for (size_t i = 0; i < 3; ++i) out.v[i] = out.v[i] - start.offset[i];
  if (start.turned) out.v = anyDirection(out.v);
  for (Interval& part : out.v) part = part / start.scale;
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
    const bool below = (less == (side == 0)) == holds;  // the local is on the smaller side
    Interval& value = frame.slots[local.id].v[0];
    if (below && other.hi < value.hi) value.hi = std::max(other.hi, value.lo);
    if (!below && other.lo > value.lo) value.lo = std::min(other.lo, value.hi);
  }
}

}  // namespace sgm
