#include <algorithm>
#include <utility>

#include "grammar/check/arguments.h"
#include "grammar/check/type_rules.h"
#include "grammar/check/types.h"
#include "grammar/syntax/keywords.h"
#include "grammar/text/codes.h"

namespace sgm {

namespace {

constexpr int kDeepestExpressions = 400;

std::string_view verb(BinaryOp op) {
  switch (op) {
    case BinaryOp::add:
      return "added";
    case BinaryOp::subtract:
      return "subtracted";
    case BinaryOp::multiply:
      return "multiplied";
    case BinaryOp::divide:
      return "divided";
    default:
      return "compared";
  }
}

/// Returns the requirement for the operands of an operator, for messages.
std::string_view ruleOf(BinaryOp op) {
  switch (op) {
    case BinaryOp::add:
    case BinaryOp::subtract:
      return "both sides are numbers, or both vectors, of one dimension";
    case BinaryOp::multiply:
      return "one side is a number, the other a number or a vector";
    case BinaryOp::divide:
      return "a number or a vector is divided by a number";
    default:
      return "both sides are numbers of one dimension";
  }
}

}  // namespace

void Types::enter(Scope scope) {
  scope_ = std::move(scope);
  known_local_.clear();
}

void Types::declareLocal(NameId name, const Span& span, const Local& local) {
  const std::string_view word = check_.text(name);
  if (isValueWord(word)) {
    check_.sink.error(span, codes::kShadowsBuiltin, join({"`", word, "` is a value of the language"}),
                      join({"choose another name, such as `", word, "_`"}));
    return;
  }
  for (const Local& known : scope_.locals)
    if (known.name == name) {
      check_.sink.error(span, codes::kDuplicate, join({"`", word, "` is declared twice in this rule"}),
                        "rename one of them");
      return;
    }
  scope_.locals.push_back(local);
  scope_.slot_count = std::max(scope_.slot_count, scope_.next_slot);
}

Type Types::checkExpression(ExprId id) {
  if (id == kNoId) return kUnknownType;
  // Limits the nesting of expressions, also across the lets that they use, so that untrusted text cannot overflow the
  // stack.
  if (depth_ >= kDeepestExpressions) {
    check_.sink.error(check_.node(id).span, codes::kTooDeep, "lets, fields and expressions are nested too deep",
                      "use fewer levels of lets");
    return kUnknownType;
  }
  ++depth_;
  ExprNode& n = check_.node(id);
  Type type;
  switch (n.kind) {
    case ExprKind::number:
      type = n.type;
      type.sample = false;
      type.any_dim = type.kind == ValueKind::number && n.value == 0 && type.dim == kRatio;
      break;
    case ExprKind::text:
      type.kind = ValueKind::text;
      break;
    case ExprKind::vector:
      type = checkVector(id);
      break;
    case ExprKind::negate:
      type = checkExpression(check_.child(n, 0));
      if (type.kind != ValueKind::number && type.kind != ValueKind::vector && type.kind != ValueKind::unknown) {
        check_.sink.error(n.span, codes::kTypeMismatch,
                          join({"a minus stands before a number, not a ", typeName(type)}),
                          type.kind == ValueKind::boolean ? "write `not`" : "such as -2m");
        type = kUnknownType;
      }
      break;
    case ExprKind::logical_not:
      type = require(check_.child(n, 0), ValueKind::boolean, kRatio, "the operand of `not`", true);
      type.kind = ValueKind::boolean;
      break;
    case ExprKind::binary:
      type = checkBinary(id);
      break;
    case ExprKind::conditional:
      type = checkConditional(id);
      break;
    case ExprKind::range:
      require(check_.child(n, 0), ValueKind::number, kRatio, "the start of a range");
      require(check_.child(n, 1), ValueKind::number, kRatio, "the end of a range");
      type.kind = ValueKind::range;
      break;
    case ExprKind::name:
      type = checkName(id);
      break;
    case ExprKind::member:
      type = checkMember(id);
      break;
    case ExprKind::call:
      type = checkCall(id);
      break;
    case ExprKind::query:
      type = checkQuery(id);
      break;
  }
  --depth_;
  check_.node(id).type = type;
  return type;
}

std::vector<Type> Types::checkExpressions(const std::vector<uint32_t>& ids) {
  std::vector<Type> types;
  for (const uint32_t id : ids) types.push_back(checkExpression(id));
  return types;
}

Type Types::checkVector(ExprId id) {
  const ExprNode& n = check_.node(id);
  constexpr Type kVector{ValueKind::vector, kLength, false, false};
  Type type = numberType(kRatio);
  for (uint32_t i = 0; i < n.children.count; ++i) {
    const ExprId part = check_.child(n, i);
    const Type t = checkExpression(part);
    if (t.kind != ValueKind::number && t.kind != ValueKind::unknown) {
      check_.sink.error(check_.node(part).span, codes::kTypeMismatch,
                        join({"a vector has numbers, and this is ", withArticle(typeName(t))}),
                        std::string(exampleOf(kVector)));
      continue;
    }
    if (i == 0) {
      type = t;
      continue;
    }
    const Type before = type;
    const Unified both = unify(before, t);
    type = both.type;
    if (!both.good)
      check_.sink.error(check_.node(part).span, codes::kUnitMismatch,
                        join({"the parts of a vector have one dimension, and these are ", withArticle(typeName(before)),
                              " and ", withArticle(typeName(t))}),
                        orElse(unitHint(check_.program, part, t, before.dim), exampleOf(kVector)));
  }
  if (type.kind == ValueKind::unknown) type.any_dim = true;
  type.kind = n.children.count == 3 ? ValueKind::vector : ValueKind::pair;
  return type;
}

Type Types::checkBinary(ExprId id) {
  const ExprNode& n = check_.node(id);
  const ExprId left = check_.child(n, 0), right = check_.child(n, 1);
  const BinaryOp op = n.binary;
  if (op == BinaryOp::logical_and || op == BinaryOp::logical_or) {
    const std::string_view what = op == BinaryOp::logical_and ? "each side of `and`" : "each side of `or`";
    const Type a = require(left, ValueKind::boolean, kRatio, what, true);
    const Type b = require(right, ValueKind::boolean, kRatio, what, true);
    return {ValueKind::boolean, kRatio, a.sample || b.sample, false};
  }
  const Type a = checkExpression(left), b = checkExpression(right);
  const bool sample = a.sample || b.sample;
  const bool known = a.kind != ValueKind::unknown && b.kind != ValueKind::unknown;
  const bool comparison = op >= BinaryOp::less && op <= BinaryOp::not_equal;
  const Type condition{ValueKind::boolean, kRatio, sample, false};
  if (!known) {
    if (comparison) return condition;
    if (op == BinaryOp::add || op == BinaryOp::subtract) return unify(a, b).type;
    return {ValueKind::unknown, kRatio, sample, false};
  }
  auto wrong = [&](std::string_view hint = {}) {
    check_.sink.error(n.span, codes::kTypeMismatch,
                      join({withArticle(typeName(a)), " and ", withArticle(typeName(b)), " cannot be ", verb(op)}),
                      orElse(hint, ruleOf(op)));
    return Type{ValueKind::unknown, kRatio, sample, false};
  };
  const bool a_numeric = a.kind == ValueKind::number || a.kind == ValueKind::vector;
  const bool b_numeric = b.kind == ValueKind::number || b.kind == ValueKind::vector;
  if (comparison) {
    const bool equality = op == BinaryOp::equal || op == BinaryOp::not_equal;
    if (equality && a.kind == ValueKind::boolean && b.kind == ValueKind::boolean) return condition;
    if (a.kind != ValueKind::number || b.kind != ValueKind::number) {
      wrong();
      return condition;
    }
  } else if (!a_numeric || !b_numeric) {
    return wrong();
  }
  if (op == BinaryOp::multiply || op == BinaryOp::divide) {
    if (b.kind == ValueKind::vector && (op == BinaryOp::divide || a.kind == ValueKind::vector)) return wrong();
    const int sign = op == BinaryOp::multiply ? 1 : -1;
    const int length = a.dim.length + sign * b.dim.length, angle = a.dim.angle + sign * b.dim.angle;
    if (length < -6 || length > 6 || angle < -6 || angle > 6) return wrong("dimensions end at the sixth power");
    if (op == BinaryOp::divide && check_.node(right).kind == ExprKind::number && check_.node(right).value == 0)
      check_.sink.error(check_.node(right).span, codes::kDivideByZero, "division by zero",
                        "divide by a number other than 0");
    const ValueKind kind =
        a.kind == ValueKind::vector || b.kind == ValueKind::vector ? ValueKind::vector : ValueKind::number;
    return {kind, {static_cast<int8_t>(length), static_cast<int8_t>(angle)}, sample, false};
  }
  const Unified both = unify(a, b);
  if (a.kind != b.kind) return comparison ? (wrong(), condition) : wrong();
  if (!both.good) {
    std::string hint = unitHint(check_.program, right, b, a.dim);
    if (hint.empty() || (check_.node(right).kind != ExprKind::number && check_.node(left).kind == ExprKind::number)) {
      const std::string other = unitHint(check_.program, left, a, b.dim);
      if (!other.empty()) hint = other;
    }
    check_.sink.error(n.span, codes::kUnitMismatch,
                      join({withArticle(typeName(a)), " and ", withArticle(typeName(b)), " cannot be ", verb(op)}),
                      orElse(hint, ruleOf(op)));
  }
  return comparison ? condition : both.type;
}

Type Types::checkConditional(ExprId id) {
  const ExprNode& n = check_.node(id);
  const Type c = require(check_.child(n, 0), ValueKind::boolean, kRatio, "the condition of `if`", true);
  const Type a = checkExpression(check_.child(n, 1)), b = checkExpression(check_.child(n, 2));
  const Unified both = unify(a, b);
  Type out = both.type;
  if (!both.good)
    check_.sink.error(
        check_.node(check_.child(n, 2)).span, a.kind == b.kind ? codes::kUnitMismatch : codes::kTypeMismatch,
        join({"`then` gives ", withArticle(typeName(a)), " and `else` ", withArticle(typeName(b))}),
        orElse(unitHint(check_.program, check_.child(n, 2), b, a.dim), "both give values of one kind and dimension"));
  out.sample = out.sample || c.sample;
  return out;
}

Type Types::checkName(ExprId id) {
  ExprNode& n = check_.node(id);
  for (auto local = scope_.locals.rbegin(); local != scope_.locals.rend(); ++local) {
    if (local->name != n.name) continue;
    if (local->field != kNoId) {
      const Local copy = *local;
      n.ref = Ref::field;
      n.id = copy.field;
      return useLocalField(id, copy);
    }
    n.ref = Ref::local;
    n.id = local->slot;
    return local->type;
  }
  const std::string_view word = check_.text(n.name);
  auto value = [&](BuiltinValue v) {
    n.ref = Ref::value;
    n.id = static_cast<uint32_t>(v);
  };
  if (word == "p" || word == "q" || word == "u") {
    value(word == "p" ? BuiltinValue::p : word == "q" ? BuiltinValue::q : BuiltinValue::u);
    return word == "u" ? numberType(kRatio, true) : Type{ValueKind::vector, kLength, true, false};
  }
  if (word == "cell" || word == "scope") {
    value(word == "cell" ? BuiltinValue::cell : BuiltinValue::scope);
    if (!scope_.inRule())
      check_.sink.error(n.span, codes::kWrongUse, join({"`", word, "` is known inside rules only"}),
                        "pass it to a let as an argument");
    return word == "cell" ? Type{ValueKind::cell, kRatio, false, false}
                          : Type{ValueKind::vector, kLength, false, false};
  }
  symbols_.resolveCallee(id, scope_, false);
  switch (n.ref) {
    case Ref::parameter: {
      const Param& param = check_.program.params[n.id];
      return numberType(param.dim);
    }
    case Ref::let:
    case Ref::field: {
      const IdRange formals =
          n.ref == Ref::let ? check_.program.lets[n.id].formals : check_.program.fields[n.id].formals;
      const auto bound = bindArguments(check_, symbols_, scope_, id, {word, viewOf(check_.program, formals)});
      if (!bound) return kUnknownType;
      n.bound = check_.store(*bound);
      return useValue(id, n.ref, n.id, checkExpressions(*bound));
    }
    case Ref::rule:
    case Ref::primitive:
      check_.sink.error(n.span, codes::kWrongUse, join({"`", word, "` is a shape and has no value"}),
                        "write it as a statement of its own");
      return kUnknownType;
    case Ref::builtin:
      check_.sink.error(n.span, codes::kWrongUse, join({"`", word, "` is a function and needs arguments"}),
                        join({"write `", word, "(...)`"}));
      return kUnknownType;
    default:
      return kUnknownType;
  }
}

}  // namespace sgm
