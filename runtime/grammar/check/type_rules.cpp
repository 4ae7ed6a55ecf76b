#include "grammar/check/type_rules.h"

#include "grammar/text/sink.h"

namespace sgm {

bool agrees(const Type& type, ValueKind kind, Dim dim) {
  if (type.kind == ValueKind::unknown || kind == ValueKind::unknown) return true;
  if (type.kind != kind) return false;
  if (kind != ValueKind::number && kind != ValueKind::vector && kind != ValueKind::pair) return true;
  return type.any_dim || type.dim == dim;
}

Unified unify(const Type& a, const Type& b) {
  Unified both{a, true};
  Type& out = both.type;
  out.sample = a.sample || b.sample;
  if (a.kind == ValueKind::unknown) {
    out = b;
    out.sample = a.sample || b.sample;
    return both;
  }
  if (b.kind == ValueKind::unknown) return both;
  if (a.kind != b.kind) {
    both.good = false;
    return both;
  }
  if (a.kind == ValueKind::number || a.kind == ValueKind::vector || a.kind == ValueKind::pair) {
    if (a.any_dim) {
      out.dim = b.dim;
      out.any_dim = b.any_dim;
    } else if (!b.any_dim && !(a.dim == b.dim)) {
      both.good = false;
    }
  }
  return both;
}

ExprId sampledPart(const Program& program, ExprId id) {
  for (;;) {
    const ExprNode& n = program.expr(id);
    ExprId next = kNoId;
    auto consider = [&](ExprId candidate) {
      if (next == kNoId && candidate != kNoId && program.expr(candidate).type.sample) next = candidate;
    };
    for (uint32_t i = 0; i < n.children.count; ++i) consider(program.idAt(n.children, i));
    if (n.ref != Ref::field && !(n.ref == Ref::builtin && n.id == static_cast<uint32_t>(Builtin::fractal)))
      for (uint32_t i = 0; i < n.args.count; ++i) consider(program.ast.args[n.args.first + i].value);
    if (next == kNoId) return id;
    id = next;
  }
}

std::string unitHint(const Program& program, ExprId id, const Type& type, Dim wanted) {
  const ExprNode& n = program.expr(id);
  if (type.kind != ValueKind::number) return {};
  const bool bare = n.kind == ExprKind::number && type.dim == kRatio && !program.text(n.name).ends_with('%');
  if (bare && wanted == kLength) return join({"write `", program.text(n.name), "m`"});
  if (bare && wanted == kAngle) return join({"write `", program.text(n.name), "deg`"});
  if (type.dim == kRatio && wanted == kLength) return "multiply it by 1m to make a length of it";
  if (type.dim == kLength && wanted == kRatio) return "divide it by a length to make a ratio of it";
  if (type.dim == kRatio && wanted == kAngle) return "multiply it by 1deg or 1rad to make an angle of it";
  return {};
}

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
      return "such as (1m, 2m, 3m)";
  }
}

std::string orElse(std::string_view hint, std::string_view other) { return std::string(hint.empty() ? other : hint); }

}  // namespace sgm
