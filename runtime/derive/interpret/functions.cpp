// Evaluates the functions of the language.

#include <algorithm>
#include <cmath>

#include "base/math.h"
#include "derive/draws.h"
#include "derive/interpret/evaluator.h"

namespace sgm::interpret {
namespace {

/// Whether the function is a method: the first bound argument of its calls is the receiver, which precedes the
/// parameters in the builtin table.
bool isMethod(Builtin id) {
  return id == Builtin::cell_point || id == Builtin::cell_links || id == Builtin::face_point;
}

/// Whether the angle is in the range of detSin and detCos; for other angles the functions of the language return 0. So
/// sines and cosines lie between -1 and 1 for any number, as the proof of reach requires.
bool isAngle(double radians) { return std::fabs(radians) <= 1e6; }

}  // namespace

Value Evaluator::argument(const ExprNode& node, uint32_t index, const Env& env) {
  const uint32_t bound = boundAt(node, index);
  if (bound != kNoId) return evaluate(bound, env);
  const BuiltinInfo& info = builtinTable()[node.id];
  const uint32_t parameter = isMethod(info.id) ? index - 1 : index;
  return Value::number(parameter < info.params.size() ? info.params[parameter].fallback : 0.0);
}

double Evaluator::realArgument(const ExprNode& node, uint32_t index, const Env& env) {
  return argument(node, index, env).real();
}

Value Evaluator::evaluateBuiltin(const ExprNode& node, const Env& env) {
  switch (static_cast<Builtin>(node.id)) {
    case Builtin::rand:
    case Builtin::rand_keyed:
    case Builtin::chance:
    case Builtin::chance_keyed:
      return evaluateRandom(node, env);
    case Builtin::cell_noise:
    case Builtin::fractal:
    case Builtin::cell_point:
    case Builtin::cell_links:
    case Builtin::face_point:
      return evaluateCellular(node, env);
    case Builtin::branch:
      return evaluateBranch(node, env);
    default:
      return evaluatePure(node, env);
  }
}

Value Evaluator::evaluatePure(const ExprNode& node, const Env& env) {
  const auto num = [&](uint32_t i) { return argument(node, i, env).n[0]; };
  const auto real = [&](uint32_t i) { return realArgument(node, i, env); };
  // Arguments are evaluated in sequence, since the result must not depend on the C++ compiler's evaluation order of
  // arguments.
  const auto all = [&](uint32_t count) {
    std::array<Num, 3> values;
    for (uint32_t i = 0; i < count; ++i) values[i] = num(i);
    return values;
  };
  switch (static_cast<Builtin>(node.id)) {
    case Builtin::min: {
      const auto v = all(2);
      return Value::number(draft_.binary(ExprOp::minimum, v[0], v[1]));
    }
    case Builtin::max: {
      const auto v = all(2);
      return Value::number(draft_.binary(ExprOp::maximum, v[0], v[1]));
    }
    case Builtin::abs:
      return Value::number(draft_.unary(ExprOp::absolute, num(0)));
    case Builtin::floor:
      return Value::number(draft_.unary(ExprOp::floor, num(0)));
    case Builtin::ceil:
      return Value::number(-detFloor(-real(0)));
    case Builtin::sqrt:
      return Value::number(draft_.unary(ExprOp::square_root, num(0)));
    case Builtin::mix: {
      const auto v = all(3);
      return Value::number(draft_.mix(v[0], v[1], v[2]));
    }
    case Builtin::clamp: {
      const auto v = all(3);
      return Value::number(draft_.clamp(v[0], v[1], v[2]));
    }
    case Builtin::smoothstep: {
      const auto v = all(3);
      return Value::number(draft_.smoothstep(v[0].value, v[1].value, v[2]));
    }
    case Builtin::fract: {
      const Num a = num(0);
      return Value::number(draft_.binary(ExprOp::subtract, a, draft_.unary(ExprOp::floor, a)));
    }
    case Builtin::sin:
      return Value::number(isAngle(real(0)) ? detSin(real(0)) : 0.0);
    case Builtin::cos:
      return Value::number(isAngle(real(0)) ? detCos(real(0)) : 0.0);
    case Builtin::atan2: {
      const auto v = all(2);
      return Value::number(detAtan2(v[0].value, v[1].value));
    }
    case Builtin::pow: {
      const auto v = all(2);
      return Value::number(detPow(v[0].value, v[1].value));
    }
    case Builtin::length:
      return Value::number(length(argument(node, 0, env).vec()));
    case Builtin::position: {
      const auto v = all(3);
      return Value::vector(v[0], v[1], v[2]);
    }
    default:
      return {};
  }
}

Value Evaluator::evaluateRandom(const ExprNode& node, const Env& env) {
  const double by_path = env.key.unit(kPathDraw + node.ordinal);
  const auto by_key = [&] { return keyOf(argument(node, 0, env)).unit(kKeyedDraw); };
  const auto between = [&](uint32_t first, double unit) {
    const double low = realArgument(node, first, env), high = realArgument(node, first + 1, env);
    return Value::number(low + (high - low) * unit);
  };
  switch (static_cast<Builtin>(node.id)) {
    case Builtin::rand:
      return between(0, by_path);
    case Builtin::rand_keyed:
      return between(1, by_key());
    case Builtin::chance:
      return Value::boolean({by_path < realArgument(node, 0, env) ? 1.0 : 0.0});
    default:
      return Value::boolean({by_key() < realArgument(node, 1, env) ? 1.0 : 0.0});
  }
}

Value Evaluator::evaluateCellular(const ExprNode& node, const Env& env) {
  const auto whole = [&](uint32_t i, double low, double high) {
    const double v = realArgument(node, i, env);
    return std::isnan(v) ? low : std::clamp(detFloor(v + 0.5), low, high);
  };
  const auto jitter = [&] { return std::clamp(realArgument(node, 1, env), 0.0, 1.0); };
  switch (static_cast<Builtin>(node.id)) {
    case Builtin::cell_noise: {
      const int32_t period = std::max(1, toUnits(realArgument(node, 1, env)));
      const double salt = realArgument(node, 2, env);
      return Value::number(in_.lattice.noise(argument(node, 0, env).cell, period, keyOf(Value::number(salt)).value));
    }
    case Builtin::fractal: {
      NoiseSpec spec;
      spec.period = std::max(1, toUnits(realArgument(node, 0, env)));
      spec.octaves = static_cast<uint32_t>(whole(1, 1, 12));
      spec.seed = static_cast<uint32_t>(keyOf(Value::number(realArgument(node, 2, env))).value >> 32);
      return Value::number(draft_.noise(spec));
    }
    case Builtin::cell_point:
      return pointValue(in_.lattice.point(in_.cell, argument(node, 0, env).cell, jitter()), env);
    case Builtin::face_point:
      return pointValue(in_.lattice.facePoint(in_.cell, argument(node, 0, env).face(), jitter()), env);
    case Builtin::cell_links: {
      const Int3 cell = argument(node, 0, env).cell;
      const int tree = static_cast<int>(whole(1, 0, 20));
      return Value::ofFaces(in_.lattice.links(cell, tree, realArgument(node, 2, env)));
    }
    default:
      return {};
  }
}

Value Evaluator::evaluateBranch(const ExprNode& node, const Env& env) {
  std::array<double, 4> given{};
  for (uint32_t i = 0; i < given.size(); ++i) given[i] = realArgument(node, i, env);
  given[0] = detFloor(given[0] + 0.5);
  const uint32_t first = static_cast<uint32_t>(segments_.size());
  if (budget_.failed()) return Value::ofSegments(first, 0);
  for (size_t i = 0; i < given.size(); ++i) {
    const ValueRange& range = branchRangeTable()[i];
    if (range.holds(given[i])) continue;
    budget_.note(std::string(range.rule).append(", ").append(range.example).append("; this one is left out"), node.span,
                 env.activation);
    return Value::ofSegments(first, 0);
  }
  const PathKey key = env.key.child(kBranchSalt, node.ordinal);
  const Skeleton skeleton = grownSkeleton(key, {given[0], given[1], given[2], given[3]});
  if (!skeleton.whole) {
    budget_.note("this branch has more than " + std::to_string(kMaxSegments) +
                     " segments; side branches are left out: take fewer steps, or lower `fork`",
                 node.span, env.activation);
  }
  const uint32_t count = static_cast<uint32_t>(skeleton.segments.size());
  if (!budget_.step(count, node.span, env.activation)) return Value::ofSegments(first, 0);
  segments_.insert(segments_.end(), skeleton.segments.begin(), skeleton.segments.end());
  budget_.hold(count * sizeof(Segment));
  budget_.withinBytes(node.span, env.activation);
  return Value::ofSegments(first, count);
}

}  // namespace sgm::interpret
