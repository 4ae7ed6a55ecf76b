#include <algorithm>

#include "grammar/check/arguments.h"
#include "grammar/check/type_rules.h"
#include "grammar/check/types.h"
#include "grammar/syntax/foreign_words.h"
#include "grammar/text/codes.h"

namespace sgm {

void Types::checkLooseArguments(const ExprNode& call) {
  for (uint32_t i = 0; i < call.args.count; ++i) checkExpression(check_.program.ast.args[call.args.first + i].value);
}

Type Types::checkCall(ExprId id) {
  ExprNode& n = check_.node(id);
  // A local field hides an outer declaration of the same name.
  for (auto local = scope_.locals.rbegin(); n.children.count == 0 && local != scope_.locals.rend(); ++local) {
    if (local->name != n.name || n.ref != Ref::none) continue;
    if (local->field == kNoId) break;
    n.ref = Ref::field;
    n.id = local->field;
    const Local copy = *local;
    return useLocalField(id, copy);
  }
  if (n.ref == Ref::field && check_.program.fields[n.id].local) {
    for (auto local = scope_.locals.rbegin(); local != scope_.locals.rend(); ++local)
      if (local->field == n.id) {
        const Local copy = *local;
        return useLocalField(id, copy);
      }
    return kUnknownType;
  }
  if (n.children.count > 0 && !symbols_.resolveCallee(id, scope_, false)) return checkMethod(id);
  if (!symbols_.resolveCallee(id, scope_, false)) return kUnknownType;
  switch (n.ref) {
    case Ref::builtin:
      return n.children.count > 0 ? checkMethod(id) : checkBuiltin(id);
    case Ref::let:
    case Ref::field: {
      const IdRange formals =
          n.ref == Ref::let ? check_.program.lets[n.id].formals : check_.program.fields[n.id].formals;
      const auto bound =
          bindArguments(check_, symbols_, scope_, id, {check_.text(n.name), viewOf(check_.program, formals)});
      if (!bound) {
        checkLooseArguments(n);
        return {ValueKind::unknown, kRatio, n.ref == Ref::field, false};
      }
      if (n.bound.count == 0) n.bound = check_.store(*bound);
      std::vector<Type> types = checkExpressions(*bound);
      requireFormalRanges(formals, *bound, types, check_.text(n.name));
      if (n.ref == Ref::let)
        for (const uint32_t b : *bound) requireDerived(b, join({"an argument of `", check_.text(n.name), "`"}));
      return useValue(id, n.ref, n.id, types);
    }
    case Ref::rule:
    case Ref::primitive:
      check_.sink.error(n.span, codes::kWrongUse, join({"`", check_.text(n.name), "` is a shape and has no value"}),
                        "write it as a statement of its own");
      return kUnknownType;
    case Ref::parameter:
      check_.sink.error(n.span, codes::kWrongUse,
                        join({"`", check_.text(n.name), "` is a parameter and takes no arguments"}),
                        join({"write `", check_.text(n.name), "`"}));
      return kUnknownType;
    default:
      checkLooseArguments(n);
      return kUnknownType;
  }
}

std::optional<Dim> Types::checkArguments(const std::vector<uint32_t>& bound, std::span<const BuiltinParam> params,
                                         std::string_view callee) {
  auto paramOf = [&](size_t i) -> const BuiltinParam& { return params[std::min(i, params.size() - 1)]; };
  std::vector<Type> types;
  std::optional<Dim> dim;
  for (size_t i = 0; i < bound.size(); ++i) {
    types.push_back(bound[i] == kNoId ? kUnknownType : checkExpression(bound[i]));
    const Type& type = types.back();
    if (!dim && paramOf(i).any_dim && type.kind == ValueKind::number && !type.any_dim) dim = type.dim;
  }
  for (size_t i = 0; i < bound.size(); ++i) {
    if (bound[i] == kNoId) continue;
    const BuiltinParam& param = paramOf(i);
    requireType(bound[i], types[i], param.kind, param.any_dim ? dim.value_or(kRatio) : param.dim,
                join({"`", param.name, "` of `", callee, "`"}), !param.derive_only);
  }
  return dim;
}

Type Types::checkBuiltin(ExprId id) {
  ExprNode& n = check_.node(id);
  Builtin builtin = static_cast<Builtin>(n.id);
  if (builtin == Builtin::rand && n.args.count == 3) builtin = Builtin::rand_keyed;
  if (builtin == Builtin::chance && n.args.count == 2) builtin = Builtin::chance_keyed;
  n.id = static_cast<uint32_t>(builtin);
  const BuiltinInfo& info = builtinTable()[n.id];
  const auto given = bindArguments(check_, symbols_, scope_, id, {info.name, viewOf(info.params)});
  if (!given) {
    checkLooseArguments(n);
    return {ValueKind::unknown, kRatio, builtin == Builtin::fractal, false};
  }
  const std::vector<uint32_t>& bound = *given;
  if (n.bound.count == 0) n.bound = check_.store(bound);
  const std::optional<Dim> dim = checkArguments(bound, info.params, info.name);
  bool sample = false;
  const bool any = !dim;
  for (uint32_t b : bound) sample = sample || (b != kNoId && check_.node(b).type.sample);
  const Dim common = dim.value_or(kRatio);
  Type out{ValueKind::number, common, sample, any};
  switch (builtin) {
    case Builtin::floor:
    case Builtin::ceil:
    case Builtin::fract:
    case Builtin::smoothstep:
    case Builtin::sin:
    case Builtin::cos:
    case Builtin::pow:
    case Builtin::cell_noise:
      return {ValueKind::number, kRatio, sample, false};
    case Builtin::sqrt:
      if (common.length % 2 != 0 || common.angle % 2 != 0) {
        check_.sink.error(n.span, codes::kUnitMismatch,
                          join({"the square root of ", withArticle(dimName(common)), " has no dimension"}),
                          "take it of an area or of a ratio");
        return kUnknownType;
      }
      out.dim = {static_cast<int8_t>(common.length / 2), static_cast<int8_t>(common.angle / 2)};
      return out;
    case Builtin::atan2:
      return {ValueKind::number, kAngle, sample, false};
    case Builtin::length:
      return {ValueKind::number, kLength, sample, false};
    case Builtin::fractal:
      return {ValueKind::number, kRatio, true, false};
    case Builtin::position:
      return {ValueKind::vector, common, sample, any};
    case Builtin::rand:
    case Builtin::chance:
      if (!scope_.inRule())
        check_.sink.error(n.span, codes::kRandKey, join({"outside of rules `", info.name, "` needs a key"}),
                          join({"a cell, a face, a segment or a number: ", info.name,
                                builtin == Builtin::rand ? "(c, a, b)" : "(c, p)"}));
      break;
    case Builtin::branch:
      if (!scope_.inRule())
        check_.sink.error(n.span, codes::kWrongUse, "`branch` is known inside rules only",
                          "it draws by its place in the derivation");
      // Constant arguments are checked here; other values are checked during derivation.
      for (size_t i = 0; i < bound.size(); ++i) {
        const BuiltinParam& param = info.params[i];
        if (bound[i] != kNoId && agrees(check_.node(bound[i]).type, param.kind, param.dim))
          judgeRange(bound[i], branchRangeTable()[i]);
      }
      out = {ValueKind::segments, kRatio, false, false};
      break;
    default:
      break;
  }
  const bool draw = builtin == Builtin::branch || builtin == Builtin::rand || builtin == Builtin::rand_keyed ||
                    builtin == Builtin::chance || builtin == Builtin::chance_keyed;
  if (draw && scope_.draws != nullptr) n.ordinal = (*scope_.draws)++;
  if (builtin == Builtin::rand_keyed || builtin == Builtin::chance_keyed) {
    const Type key = check_.node(bound[0]).type;
    if (key.kind != ValueKind::cell && key.kind != ValueKind::face && key.kind != ValueKind::number &&
        key.kind != ValueKind::segment && key.kind != ValueKind::unknown)
      check_.sink.error(
          check_.node(bound[0]).span, codes::kTypeMismatch,
          join({"a key is a cell, a face, a segment or a number, and this is ", withArticle(typeName(key))}),
          "such as cell or 3");
    requireDerived(bound[0], "a key");
  }
  if (builtin == Builtin::chance || builtin == Builtin::chance_keyed) return {ValueKind::boolean, kRatio, false, false};
  return out;
}

Type Types::checkMethod(ExprId id) {
  ExprNode& n = check_.node(id);
  const ExprId receiver = check_.child(n, 0);
  const Type type = checkExpression(receiver);
  const std::string_view word = check_.text(n.name);
  const bool cell = type.kind == ValueKind::cell || type.kind == ValueKind::unknown;
  const bool face = type.kind == ValueKind::face;
  Builtin builtin = Builtin::cell_point;
  if (word == "point" && (cell || face)) {
    builtin = face ? Builtin::face_point : Builtin::cell_point;
  } else if (word == "links" && cell) {
    builtin = Builtin::cell_links;
  } else {
    if (type.kind == ValueKind::unknown && symbols_.usesWhatIsLost()) return kUnknownType;
    Suggestion suggestion(word);
    if (cell || face) suggestion.offer("point");
    if (cell) suggestion.offer("links");
    const BuiltinInfo* builtin_of = findBuiltin(word);
    const bool function = builtin_of != nullptr && builtin_of->id < Builtin::cell_point;
    const std::string foreign = function ? join({"write `", word, "(...)` with the value within"}) : hintFor(word);
    check_.sink.error(n.span, codes::kUnknownMember, join({withArticle(typeName(type)), " has no `", word, "()`"}),
                      cell && word == "faces"
                          ? "write it without parentheses"
                          : suggestion.hintOr(cell              ? "it has point() and links()"
                                              : face            ? "it has point()"
                                              : foreign.empty() ? "only cells and faces have functions of their own"
                                                                : foreign));
    return kUnknownType;
  }
  const BuiltinInfo& info = builtinTable()[static_cast<size_t>(builtin)];
  const auto bound = bindArguments(check_, symbols_, scope_, id, {word, viewOf(info.params)});
  if (!bound) return kUnknownType;
  checkArguments(*bound, info.params, word);
  n.ref = Ref::builtin;
  n.id = static_cast<uint32_t>(builtin);
  if (n.bound.count == 0) {
    std::vector<uint32_t> with_receiver{receiver};
    for (const uint32_t b : *bound) with_receiver.push_back(b);
    n.bound = check_.store(with_receiver);
  }
  if (builtin == Builtin::cell_links) return {ValueKind::faces, kRatio, false, false};
  return {ValueKind::vector, kLength, false, false};
}

void Types::checkPrimitive(ExprId id) {
  ExprNode& n = check_.node(id);
  const PrimitiveInfo& info = primitiveTable()[n.id];
  const Primitive primitive = info.id;
  const bool box_like = primitive == Primitive::box || primitive == Primitive::ellipsoid;
  if (box_like && n.args.count == 1) {
    const ArgNode& arg = check_.program.ast.args[n.args.first];
    const Type type = checkExpression(arg.value);
    const bool edge = primitive == Primitive::box && type.kind != ValueKind::vector;
    requireType(arg.value, type, edge ? ValueKind::number : ValueKind::vector, kLength,
                edge ? "the edge of a box" : join({"the size of `", info.name, "`"}));
    if (n.bound.count == 0) n.bound = check_.store({arg.value, kNoId, kNoId});
    return;
  }
  const auto given = bindArguments(check_, symbols_, scope_, id, {info.name, viewOf(info.params), info.variadic});
  if (!given) {
    checkLooseArguments(n);
    return;
  }
  const std::vector<uint32_t>& bound = *given;
  if (n.bound.count == 0) n.bound = check_.store(bound);
  checkArguments(bound, info.params, info.name);
  if (primitive == Primitive::halfspace && (bound[0] == kNoId) == (bound[1] == kNoId))
    check_.sink.error(n.span, codes::kArgumentCount, "`halfspace` takes either `below` or `above`",
                      "such as halfspace(below 2m)");
  if (primitive == Primitive::prism && bound.size() > 65)
    check_.sink.error(n.span, codes::kArgumentCount, "a prism has 3 to 64 corners", "build it from several prisms");
}

}  // namespace sgm
