// Checks that expressions have the required types and values (Types::require and similar functions).

#include "grammar/check/type_rules.h"
#include "grammar/check/types.h"
#include "grammar/text/codes.h"

namespace sgm {

Type Types::require(ExprId id, ValueKind kind, Dim dim, std::string_view what, bool sample) {
  if (id == kNoId) return kUnknownType;
  const Type type = checkExpression(id);
  requireType(id, type, kind, dim, what, sample);
  return type;
}

void Types::requireType(ExprId id, const Type& type, ValueKind kind, Dim dim, std::string_view what, bool sample) {
  if (!agrees(type, kind, dim)) {
    const Type wanted{kind, dim, false, false};
    Type found = type;
    found.sample = false;
    check_.sink.error(
        check_.node(id).span, type.kind == kind ? codes::kUnitMismatch : codes::kTypeMismatch,
        join({what, " is ", withArticle(typeName(wanted)), ", and this is ", withArticle(typeName(found))}),
        orElse(kind == ValueKind::number ? unitHint(check_.program, id, type, dim) : "", exampleOf(wanted)));
    return;
  }
  if (!sample) requireDerived(id, what);
}

void Types::requireDerived(ExprId id, std::string_view what) {
  if (id == kNoId || !check_.node(id).type.sample) return;
  const ExprNode& n = check_.node(sampledPart(check_.program, id));
  std::string_view kind = "known at sample time only";
  if (n.ref == Ref::field || n.kind == ExprKind::name)
    kind = n.ref == Ref::value ? "known at sample time only" : "a field";
  check_.sink.error(n.span, codes::kStage,
                    join({what, " is decided when shapes are derived, and `", check_.text(n.name), "` is ", kind}),
                    "fields serve displace, warp and the t of morph");
}

void Types::requireRange(ExprId id, Dim dim, std::string_view what, const ValueRange& range) {
  if (id == kNoId) return;
  const Type type = require(id, ValueKind::number, dim, what);
  if (!agrees(type, ValueKind::number, dim)) return;
  judgeRange(id, range);
}

void Types::judgeRange(ExprId id, const ValueRange& range) {
  const std::optional<double> value = fold(id);
  if (value && !range.holds(*value))
    check_.sink.error(check_.node(id).span, codes::kValueRange, std::string(range.rule), std::string(range.example));
}

void Types::requireFormalRanges(IdRange formals, std::span<const uint32_t> bound, std::span<Type> types,
                                std::string_view callee) {
  for (uint32_t i = 0; i < formals.count && i < bound.size(); ++i) {
    const FormalNode formal = check_.program.ast.formals[formals.first + i];
    if (!formal.ranged) continue;
    if (bound[i] != formal.fallback)
      requireType(bound[i], types[i], ValueKind::number, formal.dim,
                  join({"`", check_.text(formal.name), "` of `", callee, "`"}), true);
    types[i] = {ValueKind::number, formal.dim, types[i].sample, false};
  }
}

}  // namespace sgm
