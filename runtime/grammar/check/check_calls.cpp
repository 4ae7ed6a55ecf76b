#include <algorithm>
#include <utility>

#include "grammar/check/check.h"
#include "grammar/syntax/foreign_words.h"
#include "grammar/text/codes.h"

namespace sgm {

namespace {

constexpr size_t kDeepestCalls = 48;

}  // namespace

Type Checker::callValue(ExprId id) {
  ExprNode& n = node(id);
  // A local field hides an outer declaration of the same name.
  for (auto local = scope_.locals.rbegin(); n.children.count == 0 && local != scope_.locals.rend(); ++local) {
    if (local->name != n.name || n.ref != Ref::none) continue;
    if (local->field == kNoId) break;
    n.ref = Ref::field;
    n.id = local->field;
    const Local copy = *local;
    return localFieldUse(id, copy);
  }
  if (n.ref == Ref::field && program_.fields[n.id].local) {
    for (auto local = scope_.locals.rbegin(); local != scope_.locals.rend(); ++local)
      if (local->field == n.id) {
        const Local copy = *local;
        return localFieldUse(id, copy);
      }
    return kUnknownType;
  }
  if (n.children.count > 0 && !resolveCallee(id, false)) return method(id);
  if (!resolveCallee(id, false)) return kUnknownType;
  switch (n.ref) {
    case Ref::builtin:
      return n.children.count > 0 ? method(id) : builtinCall(id);
    case Ref::let:
    case Ref::field: {
      const IdRange formals = n.ref == Ref::let ? program_.lets[n.id].formals : program_.fields[n.id].formals;
      std::vector<uint32_t> bound;
      std::vector<Type> types;
      if (!bind(id, text(n.name), viewOf(formals), false, bound)) {
        for (uint32_t i = 0; i < n.args.count; ++i) expression(program_.ast.args[n.args.first + i].value);
        return {ValueKind::unknown, kRatio, n.ref == Ref::field, false};
      }
      if (n.bound.count == 0) n.bound = store(bound);
      for (uint32_t b : bound) types.push_back(expression(b));
      demandRanged(formals, bound, types, text(n.name));
      if (n.ref == Ref::let)
        for (uint32_t b : bound) deriveOnly(b, join({"an argument of `", text(n.name), "`"}));
      return letOrField(id, n.ref, n.id, types);
    }
    case Ref::rule:
    case Ref::primitive:
      sink_.error(n.span, codes::kWrongUse, join({"`", text(n.name), "` is a shape and has no value"}),
                  "write it as a statement of its own");
      return kUnknownType;
    case Ref::parameter:
      sink_.error(n.span, codes::kWrongUse, join({"`", text(n.name), "` is a parameter and takes no arguments"}),
                  join({"write `", text(n.name), "`"}));
      return kUnknownType;
    default:
      for (uint32_t i = 0; i < n.args.count; ++i) expression(program_.ast.args[n.args.first + i].value);
      return kUnknownType;
  }
}

std::optional<Dim> Checker::arguments(const std::vector<uint32_t>& bound, std::span<const BuiltinParam> params,
                                      std::string_view callee) {
  auto paramOf = [&](size_t i) -> const BuiltinParam& { return params[std::min(i, params.size() - 1)]; };
  std::vector<Type> types;
  std::optional<Dim> dim;
  for (size_t i = 0; i < bound.size(); ++i) {
    types.push_back(bound[i] == kNoId ? kUnknownType : expression(bound[i]));
    const Type& type = types.back();
    if (!dim && paramOf(i).any_dim && type.kind == ValueKind::number && !type.any_dim) dim = type.dim;
  }
  for (size_t i = 0; i < bound.size(); ++i) {
    if (bound[i] == kNoId) continue;
    const BuiltinParam& param = paramOf(i);
    demandType(bound[i], types[i], param.kind, param.any_dim ? dim.value_or(kRatio) : param.dim,
               join({"`", param.name, "` of `", callee, "`"}), !param.derive_only);
  }
  return dim;
}

Type Checker::builtinCall(ExprId id) {
  ExprNode& n = node(id);
  Builtin builtin = static_cast<Builtin>(n.id);
  if (builtin == Builtin::rand && n.args.count == 3) builtin = Builtin::rand_keyed;
  if (builtin == Builtin::chance && n.args.count == 2) builtin = Builtin::chance_keyed;
  n.id = static_cast<uint32_t>(builtin);
  const BuiltinInfo& info = builtinTable()[n.id];
  std::vector<uint32_t> bound;
  if (!bind(id, info.name, viewOf(info.params), false, bound)) {
    for (uint32_t i = 0; i < n.args.count; ++i) expression(program_.ast.args[n.args.first + i].value);
    return {ValueKind::unknown, kRatio, builtin == Builtin::fractal, false};
  }
  if (n.bound.count == 0) n.bound = store(bound);
  const std::optional<Dim> dim = arguments(bound, info.params, info.name);
  bool sample = false;
  const bool any = !dim;
  for (uint32_t b : bound) sample = sample || (b != kNoId && node(b).type.sample);
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
        sink_.error(n.span, codes::kUnitMismatch,
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
      if (!scope_.rule)
        sink_.error(n.span, codes::kRandKey, join({"outside of rules `", info.name, "` needs a key"}),
                    join({"a cell, a face, a segment or a number: ", info.name,
                          builtin == Builtin::rand ? "(c, a, b)" : "(c, p)"}));
      break;
    case Builtin::branch:
      if (!scope_.rule)
        sink_.error(n.span, codes::kWrongUse, "`branch` is known inside rules only",
                    "it draws by its place in the derivation");
      branchRanges(bound);
      out = {ValueKind::segments, kRatio, false, false};
      break;
    default:
      break;
  }
  const bool draw = builtin == Builtin::branch || builtin == Builtin::rand || builtin == Builtin::rand_keyed ||
                    builtin == Builtin::chance || builtin == Builtin::chance_keyed;
  if (draw && scope_.draws != nullptr) n.ordinal = (*scope_.draws)++;
  if (builtin == Builtin::rand_keyed || builtin == Builtin::chance_keyed) {
    const Type key = node(bound[0]).type;
    if (key.kind != ValueKind::cell && key.kind != ValueKind::face && key.kind != ValueKind::number &&
        key.kind != ValueKind::segment && key.kind != ValueKind::unknown)
      sink_.error(node(bound[0]).span, codes::kTypeMismatch,
                  join({"a key is a cell, a face, a segment or a number, and this is ", withArticle(typeName(key))}),
                  "such as cell or 3");
    deriveOnly(bound[0], "a key");
  }
  if (builtin == Builtin::chance || builtin == Builtin::chance_keyed) return {ValueKind::boolean, kRatio, false, false};
  return out;
}

/// Checks constants; other values are checked at derivation.
void Checker::branchRanges(const std::vector<uint32_t>& bound) {
  for (size_t i = 0; i < bound.size(); ++i) {
    const BuiltinParam& param = builtinTable()[static_cast<size_t>(Builtin::branch)].params[i];
    if (bound[i] == kNoId || !agrees(node(bound[i]).type, param.kind, param.dim)) continue;
    const ValueRange& range = branchRangeTable()[i];
    const std::optional<double> value = fold(bound[i], 0);
    if (value && !range.holds(*value))
      sink_.error(node(bound[i]).span, codes::kValueRange, std::string(range.rule), std::string(range.example));
  }
}

Type Checker::method(ExprId id) {
  ExprNode& n = node(id);
  const ExprId receiver = child(n, 0);
  const Type type = expression(receiver);
  const std::string_view word = text(n.name);
  const bool cell = type.kind == ValueKind::cell || type.kind == ValueKind::unknown;
  const bool face = type.kind == ValueKind::face;
  Builtin builtin = Builtin::cell_point;
  if (word == "point" && (cell || face)) {
    builtin = face ? Builtin::face_point : Builtin::cell_point;
  } else if (word == "links" && cell) {
    builtin = Builtin::cell_links;
  } else {
    if (type.kind == ValueKind::unknown && uses_lost_) return kUnknownType;
    Suggestion suggestion(word);
    if (cell || face) suggestion.offer("point");
    if (cell) suggestion.offer("links");
    const BuiltinInfo* builtin_of = findBuiltin(word);
    const bool function = builtin_of != nullptr && builtin_of->id < Builtin::cell_point;
    const std::string foreign = function ? join({"write `", word, "(...)` with the value within"}) : hintFor(word);
    sink_.error(n.span, codes::kUnknownMember, join({withArticle(typeName(type)), " has no `", word, "()`"}),
                cell && word == "faces"
                    ? "write it without parentheses"
                    : suggestion.hintOr(cell              ? "it has point() and links()"
                                        : face            ? "it has point()"
                                        : foreign.empty() ? "only cells and faces have functions of their own"
                                                          : foreign));
    return kUnknownType;
  }
  const BuiltinInfo& info = builtinTable()[static_cast<size_t>(builtin)];
  std::vector<uint32_t> bound;
  if (!bind(id, word, viewOf(info.params), false, bound)) return kUnknownType;
  arguments(bound, info.params, word);
  n.ref = Ref::builtin;
  n.id = static_cast<uint32_t>(builtin);
  if (n.bound.count == 0) {
    std::vector<uint32_t> with_receiver{receiver};
    for (uint32_t b : bound) with_receiver.push_back(b);
    n.bound = store(with_receiver);
  }
  if (builtin == Builtin::cell_links) return {ValueKind::faces, kRatio, false, false};
  return {ValueKind::vector, kLength, false, false};
}

/// Returns false, after an error, if uses of lets and fields are nested too deep.
bool Checker::fitsDeeper(ExprId id) {
  if (open_.size() < kDeepestCalls) return true;
  sink_.error(node(id).span, codes::kTooDeep,
              join({"lets and fields use each other more than ", std::to_string(kDeepestCalls), " deep"}),
              "combine some of them");
  return false;
}

Type Checker::letOrField(ExprId id, Ref ref, uint32_t index, const std::vector<Type>& args) {
  const bool is_let = ref == Ref::let;
  const NameId name = is_let ? program_.lets[index].name : program_.fields[index].name;
  Key key{ref, index, {}};
  bool sample = !is_let;
  for (const Type& t : args) {
    std::get<2>(key).emplace_back(static_cast<int>(t.kind), t.dim.length, t.dim.angle, t.sample, t.any_dim);
    sample = sample || t.sample;
  }
  const auto known = known_.find(key);
  if (known != known_.end()) return known->second;
  if (std::find(open_.begin(), open_.end(), std::pair(ref, index)) != open_.end()) {
    sink_.error(node(id).span, codes::kRecursiveValue, join({"`", text(name), "` is defined by itself"}),
                "only rules may call themselves");
    return {ValueKind::unknown, kRatio, sample, false};
  }
  constexpr size_t kMostInstances = 20000;
  if (known_.size() >= kMostInstances) {
    sink_.error(node(id).span, codes::kTooLarge,
                "the program has more than 20000 lets and fields, counted once for each kind of arguments",
                "write fewer of them, or call them with arguments of fewer kinds");
    return {ValueKind::unknown, kRatio, sample, false};
  }
  if (!fitsDeeper(id)) return {ValueKind::unknown, kRatio, sample, false};
  open_.emplace_back(ref, index);
  const Scope outer = std::move(scope_);
  scope_ = {};
  uint32_t draws = 0;
  const IdRange formals = is_let ? program_.lets[index].formals : program_.fields[index].formals;
  const ExprId body = is_let ? program_.lets[index].body : program_.fields[index].body;
  scope_.module = is_let ? program_.lets[index].module : program_.fields[index].module;
  scope_.draws = &draws;
  scope_.field = !is_let;
  for (uint32_t i = 0; i < formals.count && i < args.size(); ++i)
    scope_.locals.push_back({program_.ast.formals[formals.first + i].name, i, args[i], kNoId, 0});
  Type type = expression(body);
  if (is_let) {
    deriveOnly(body, "a let");
    type.sample = false;
  } else {
    type.sample = true;
    if (type.kind != ValueKind::number && type.kind != ValueKind::vector && type.kind != ValueKind::unknown &&
        type.kind != ValueKind::boolean)
      sink_.error(node(body).span, codes::kTypeMismatch,
                  join({"a field gives a number or a vector, not ", withArticle(typeName(type))}),
                  "name it with `let` instead");
  }
  scope_ = outer;
  open_.pop_back();
  known_.emplace(std::move(key), type);
  return type;
}

Type Checker::localFieldUse(ExprId id, const Local& local) {
  Field& field = program_.fields[local.field];
  std::vector<uint32_t> bound;
  if (!bind(id, text(field.name), viewOf(field.formals), false, bound))
    return {ValueKind::unknown, kRatio, true, false};
  if (node(id).bound.count == 0) node(id).bound = store(bound);
  Key key{Ref::field, local.field, {}};
  std::vector<Type> args;
  for (uint32_t b : bound) args.push_back(expression(b));
  demandRanged(field.formals, bound, args, text(field.name));
  for (const Type& t : args)
    std::get<2>(key).emplace_back(static_cast<int>(t.kind), t.dim.length, t.dim.angle, t.sample, t.any_dim);

  const auto known = known_local_.find(key);
  if (known != known_local_.end()) return known->second;
  if (!fitsDeeper(id)) return {ValueKind::unknown, kRatio, true, false};
  open_.emplace_back(Ref::field, local.field);
  // The body sees the locals before the field, and the field's own parameters.
  std::vector<Local> outer = scope_.locals;
  scope_.locals.resize(local.depth);
  for (uint32_t i = 0; i < field.formals.count && i < args.size(); ++i) {
    const FormalNode& formal = program_.ast.formals[field.formals.first + i];
    scope_.locals.push_back({formal.name, formal.slot, args[i], kNoId, 0});
  }
  const bool in_field = std::exchange(scope_.field, true);
  Type type = expression(field.body);
  type.sample = true;
  scope_.field = in_field;
  scope_.locals = std::move(outer);
  open_.pop_back();
  known_local_.emplace(std::move(key), type);
  return type;
}

void Checker::primitiveCall(ExprId id) {
  ExprNode& n = node(id);
  const PrimitiveInfo& info = primitiveTable()[n.id];
  const Primitive primitive = info.id;
  std::vector<uint32_t> bound;
  const bool box_like = primitive == Primitive::box || primitive == Primitive::ellipsoid;
  if (box_like && n.args.count == 1) {
    const ArgNode& arg = program_.ast.args[n.args.first];
    const Type type = expression(arg.value);
    const bool edge = primitive == Primitive::box && type.kind != ValueKind::vector;
    demandType(arg.value, type, edge ? ValueKind::number : ValueKind::vector, kLength,
               edge ? "the edge of a box" : join({"the size of `", info.name, "`"}));
    if (n.bound.count == 0) n.bound = store({arg.value, kNoId, kNoId});
    return;
  }
  if (!bind(id, info.name, viewOf(info.params), info.variadic, bound)) {
    for (uint32_t i = 0; i < n.args.count; ++i) expression(program_.ast.args[n.args.first + i].value);
    return;
  }
  if (n.bound.count == 0) n.bound = store(bound);
  arguments(bound, info.params, info.name);
  if (primitive == Primitive::halfspace && (bound[0] == kNoId) == (bound[1] == kNoId))
    sink_.error(n.span, codes::kArgumentCount, "`halfspace` takes either `below` or `above`",
                "such as halfspace(below 2m)");
  if (primitive == Primitive::prism && bound.size() > 65)
    sink_.error(n.span, codes::kArgumentCount, "a prism has 3 to 64 corners", "build it from several prisms");
}

}  // namespace sgm
