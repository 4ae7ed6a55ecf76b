#include <algorithm>

#include "grammar/check/check.h"
#include "grammar/text/codes.h"

namespace sgm {

namespace {

constexpr int kDeepestExpressions = 400;

Type numberType(Dim dim, bool sample = false) { return {ValueKind::number, dim, sample, false}; }

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

constexpr const char* kVectorExample = "such as (1m, 2m, 3m)";

std::string orElse(std::string_view hint, std::string_view other) { return std::string(hint.empty() ? other : hint); }

/// An example of how to write a value of this kind and dimension.
std::string_view exampleOf(const Type& type) {
  switch (type.kind) {
    case ValueKind::number:
      return type.dim == kRatio    ? "such as 3 or 40%"
             : type.dim == kLength ? "such as 2m"
             : type.dim == kAngle  ? "such as 30deg"
             : type.dim == kArea   ? "such as 2m2"
             : type.dim == kVolume ? "such as 2m3"
                                   : "give it the dimension that it needs";
    case ValueKind::boolean:
      return "such as a < b";
    case ValueKind::pair:
      return "such as (1m, 2m)";
    case ValueKind::cell:
      return "such as cell";
    default:
      return kVectorExample;
  }
}

/// The requirement for both sides of an operator.
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

bool Checker::agrees(const Type& type, ValueKind kind, Dim dim) const {
  if (type.kind == ValueKind::unknown || kind == ValueKind::unknown) return true;
  if (type.kind != kind) return false;
  if (kind != ValueKind::number && kind != ValueKind::vector && kind != ValueKind::pair) return true;
  return type.any_dim || type.dim == dim;
}

ExprId Checker::culprit(ExprId id) const {
  for (;;) {
    const ExprNode& n = node(id);
    ExprId next = kNoId;
    auto consider = [&](ExprId candidate) {
      if (next == kNoId && candidate != kNoId && node(candidate).type.sample) next = candidate;
    };
    for (uint32_t i = 0; i < n.children.count; ++i) consider(child(n, i));
    if (n.ref != Ref::field && !(n.ref == Ref::builtin && n.id == static_cast<uint32_t>(Builtin::fractal)))
      for (uint32_t i = 0; i < n.args.count; ++i) consider(program_.ast.args[n.args.first + i].value);
    if (next == kNoId) return id;
    id = next;
  }
}

void Checker::deriveOnly(ExprId id, std::string_view what) {
  if (id == kNoId || !node(id).type.sample) return;
  const ExprNode& n = node(culprit(id));
  std::string_view kind = "known at sample time only";
  if (n.ref == Ref::field || n.kind == ExprKind::name)
    kind = n.ref == Ref::value ? "known at sample time only" : "a field";
  sink_.error(n.span, codes::kStage,
              join({what, " is decided when shapes are derived, and `", text(n.name), "` is ", kind}),
              "fields serve displace, warp and the t of morph");
}

std::string Checker::unitHint(ExprId id, const Type& type, Dim wanted) const {
  const ExprNode& n = node(id);
  if (type.kind != ValueKind::number) return {};
  const bool bare = n.kind == ExprKind::number && type.dim == kRatio && !text(n.name).ends_with('%');
  if (bare && wanted == kLength) return join({"write `", text(n.name), "m`"});
  if (bare && wanted == kAngle) return join({"write `", text(n.name), "deg`"});
  if (type.dim == kRatio && wanted == kLength) return "multiply it by 1m to make a length of it";
  if (type.dim == kLength && wanted == kRatio) return "divide it by a length to make a ratio of it";
  if (type.dim == kRatio && wanted == kAngle) return "multiply it by 1deg or 1rad to make an angle of it";
  return {};
}

void Checker::demandType(ExprId id, const Type& type, ValueKind kind, Dim dim, std::string_view what, bool sample) {
  if (!agrees(type, kind, dim)) {
    const Type wanted{kind, dim, false, false};
    Type found = type;
    found.sample = false;
    sink_.error(node(id).span, type.kind == kind ? codes::kUnitMismatch : codes::kTypeMismatch,
                join({what, " is ", withArticle(typeName(wanted)), ", and this is ", withArticle(typeName(found))}),
                orElse(kind == ValueKind::number ? unitHint(id, type, dim) : "", exampleOf(wanted)));
    return;
  }
  if (!sample) deriveOnly(id, what);
}

Type Checker::demand(ExprId id, ValueKind kind, Dim dim, std::string_view what, bool sample) {
  if (id == kNoId) return kUnknownType;
  const Type type = expression(id);
  demandType(id, type, kind, dim, what, sample);
  return type;
}

Type Checker::unify(const Type& a, const Type& b, bool& good) const {
  good = true;
  Type out = a;
  out.sample = a.sample || b.sample;
  if (a.kind == ValueKind::unknown) {
    out = b;
    out.sample = a.sample || b.sample;
    return out;
  }
  if (b.kind == ValueKind::unknown) return out;
  if (a.kind != b.kind) {
    good = false;
    return out;
  }
  if (a.kind == ValueKind::number || a.kind == ValueKind::vector || a.kind == ValueKind::pair) {
    if (a.any_dim) {
      out.dim = b.dim;
      out.any_dim = b.any_dim;
    } else if (!b.any_dim && !(a.dim == b.dim)) {
      good = false;
    }
  }
  return out;
}

Type Checker::expression(ExprId id) {
  if (id == kNoId) return kUnknownType;
  // Nested lets add up, but the stack depth must not depend on the text.
  if (expression_depth_ >= kDeepestExpressions) {
    sink_.error(node(id).span, codes::kTooDeep, "lets, fields and expressions are nested too deep",
                "use fewer levels of lets");
    return kUnknownType;
  }
  ++expression_depth_;
  ExprNode& n = node(id);
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
    case ExprKind::vector: {
      bool good = true;
      type = numberType(kRatio);
      for (uint32_t i = 0; i < n.children.count; ++i) {
        const ExprId part = child(n, i);
        const Type t = expression(part);
        if (t.kind != ValueKind::number && t.kind != ValueKind::unknown) {
          sink_.error(node(part).span, codes::kTypeMismatch,
                      join({"a vector has numbers, and this is ", withArticle(typeName(t))}), kVectorExample);
          continue;
        }
        if (i == 0) {
          type = t;
          continue;
        }
        const Type before = type;
        type = unify(type, t, good);
        if (!good)
          sink_.error(node(part).span, codes::kUnitMismatch,
                      join({"the parts of a vector have one dimension, and these are ", withArticle(typeName(before)),
                            " and ", withArticle(typeName(t))}),
                      orElse(unitHint(part, t, before.dim), kVectorExample));
      }
      if (type.kind == ValueKind::unknown) type.any_dim = true;
      type.kind = n.children.count == 3 ? ValueKind::vector : ValueKind::pair;
      break;
    }
    case ExprKind::negate: {
      type = expression(child(n, 0));
      if (type.kind != ValueKind::number && type.kind != ValueKind::vector && type.kind != ValueKind::unknown) {
        sink_.error(n.span, codes::kTypeMismatch, join({"a minus stands before a number, not a ", typeName(type)}),
                    type.kind == ValueKind::boolean ? "write `not`" : "such as -2m");
        type = kUnknownType;
      }
      break;
    }
    case ExprKind::logical_not:
      type = demand(child(n, 0), ValueKind::boolean, kRatio, "the operand of `not`", true);
      type.kind = ValueKind::boolean;
      break;
    case ExprKind::binary:
      type = binary(id);
      break;
    case ExprKind::conditional:
      type = conditional(id);
      break;
    case ExprKind::range:
      demand(child(n, 0), ValueKind::number, kRatio, "the start of a range");
      demand(child(n, 1), ValueKind::number, kRatio, "the end of a range");
      type.kind = ValueKind::range;
      break;
    case ExprKind::name:
      type = name(id);
      break;
    case ExprKind::member:
      type = member(id);
      break;
    case ExprKind::call:
      type = callValue(id);
      break;
    case ExprKind::query:
      type = query(id);
      break;
  }
  --expression_depth_;
  node(id).type = type;
  return type;
}

Type Checker::binary(ExprId id) {
  const ExprNode& n = node(id);
  const ExprId left = child(n, 0), right = child(n, 1);
  const BinaryOp op = n.binary;
  if (op == BinaryOp::logical_and || op == BinaryOp::logical_or) {
    const std::string_view what = op == BinaryOp::logical_and ? "each side of `and`" : "each side of `or`";
    const Type a = demand(left, ValueKind::boolean, kRatio, what, true);
    const Type b = demand(right, ValueKind::boolean, kRatio, what, true);
    return {ValueKind::boolean, kRatio, a.sample || b.sample, false};
  }
  const Type a = expression(left), b = expression(right);
  const bool sample = a.sample || b.sample;
  const bool known = a.kind != ValueKind::unknown && b.kind != ValueKind::unknown;
  const bool comparison = op >= BinaryOp::less && op <= BinaryOp::not_equal;
  const Type condition{ValueKind::boolean, kRatio, sample, false};
  if (!known) {
    if (comparison) return condition;
    if (op == BinaryOp::add || op == BinaryOp::subtract) {
      bool good = true;
      return unify(a, b, good);
    }
    return {ValueKind::unknown, kRatio, sample, false};
  }
  auto wrong = [&](std::string_view hint = {}) {
    sink_.error(n.span, codes::kTypeMismatch,
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
    if (op == BinaryOp::divide && node(right).kind == ExprKind::number && node(right).value == 0)
      sink_.error(node(right).span, codes::kDivideByZero, "division by zero", "divide by a number other than 0");
    const ValueKind kind =
        a.kind == ValueKind::vector || b.kind == ValueKind::vector ? ValueKind::vector : ValueKind::number;
    return {kind, {static_cast<int8_t>(length), static_cast<int8_t>(angle)}, sample, false};
  }
  bool good = true;
  const Type both = unify(a, b, good);
  if (a.kind != b.kind) return comparison ? (wrong(), condition) : wrong();
  if (!good) {
    std::string hint = unitHint(right, b, a.dim);
    if (hint.empty() || (node(right).kind != ExprKind::number && node(left).kind == ExprKind::number)) {
      const std::string other = unitHint(left, a, b.dim);
      if (!other.empty()) hint = other;
    }
    sink_.error(n.span, codes::kUnitMismatch,
                join({withArticle(typeName(a)), " and ", withArticle(typeName(b)), " cannot be ", verb(op)}),
                orElse(hint, ruleOf(op)));
  }
  return comparison ? condition : both;
}

Type Checker::conditional(ExprId id) {
  const ExprNode& n = node(id);
  const Type c = demand(child(n, 0), ValueKind::boolean, kRatio, "the condition of `if`", true);
  const Type a = expression(child(n, 1)), b = expression(child(n, 2));
  bool good = true;
  Type out = unify(a, b, good);
  if (!good)
    sink_.error(node(child(n, 2)).span, a.kind == b.kind ? codes::kUnitMismatch : codes::kTypeMismatch,
                join({"`then` gives ", withArticle(typeName(a)), " and `else` ", withArticle(typeName(b))}),
                orElse(unitHint(child(n, 2), b, a.dim), "both give values of one kind and dimension"));
  out.sample = out.sample || c.sample;
  return out;
}

Type Checker::name(ExprId id) {
  ExprNode& n = node(id);
  for (auto local = scope_.locals.rbegin(); local != scope_.locals.rend(); ++local) {
    if (local->name != n.name) continue;
    if (local->field != kNoId) {
      const Local copy = *local;
      n.ref = Ref::field;
      n.id = copy.field;
      return localFieldUse(id, copy);
    }
    n.ref = Ref::local;
    n.id = local->slot;
    return local->type;
  }
  const std::string_view word = text(n.name);
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
    if (!scope_.rule)
      sink_.error(n.span, codes::kWrongUse, join({"`", word, "` is known inside rules only"}),
                  "pass it to a let as an argument");
    return word == "cell" ? Type{ValueKind::cell, kRatio, false, false}
                          : Type{ValueKind::vector, kLength, false, false};
  }
  resolveCallee(id, false);
  switch (n.ref) {
    case Ref::parameter: {
      const Param& param = program_.params[n.id];
      return numberType(param.dim);
    }
    case Ref::let:
    case Ref::field: {
      const IdRange formals = n.ref == Ref::let ? program_.lets[n.id].formals : program_.fields[n.id].formals;
      std::vector<uint32_t> bound;
      if (!bind(id, word, viewOf(formals), false, bound)) return kUnknownType;
      n.bound = store(bound);
      std::vector<Type> types;
      for (uint32_t b : bound) types.push_back(expression(b));
      return letOrField(id, n.ref, n.id, types);
    }
    case Ref::rule:
    case Ref::primitive:
      sink_.error(n.span, codes::kWrongUse, join({"`", word, "` is a shape and has no value"}),
                  "write it as a statement of its own");
      return kUnknownType;
    case Ref::builtin:
      sink_.error(n.span, codes::kWrongUse, join({"`", word, "` is a function and needs arguments"}),
                  join({"write `", word, "(...)`"}));
      return kUnknownType;
    default:
      return kUnknownType;
  }
}

}  // namespace sgm
