// Checks lets and fields, once for each tuple of argument types.

#include <algorithm>
#include <set>
#include <utility>

#include "grammar/check/arguments.h"
#include "grammar/check/types.h"
#include "grammar/text/codes.h"

namespace sgm {

namespace {

constexpr size_t kDeepestCalls = 48;

std::vector<std::tuple<int, int, int, bool, bool>> keyOf(const std::vector<Type>& args) {
  std::vector<std::tuple<int, int, int, bool, bool>> key;
  for (const Type& t : args) key.emplace_back(static_cast<int>(t.kind), t.dim.length, t.dim.angle, t.sample, t.any_dim);
  return key;
}

}  // namespace

/// Returns false, after reporting an error, if the lets and fields that use each other are nested too deep.
bool Types::canNestDeeper(ExprId id) {
  if (open_.size() < kDeepestCalls) return true;
  check_.sink.error(check_.node(id).span, codes::kTooDeep,
                    join({"lets and fields use each other more than ", std::to_string(kDeepestCalls), " deep"}),
                    "combine some of them");
  return false;
}

Type Types::useValue(ExprId id, Ref ref, uint32_t index, const std::vector<Type>& args) {
  const bool is_let = ref == Ref::let;
  const NameId name = is_let ? check_.program.lets[index].name : check_.program.fields[index].name;
  const bool sample = !is_let || std::ranges::any_of(args, [](const Type& t) { return t.sample; });
  Key key{ref, index, keyOf(args)};
  const auto known = known_.find(key);
  if (known != known_.end()) return known->second;
  if (std::find(open_.begin(), open_.end(), std::pair(ref, index)) != open_.end()) {
    check_.sink.error(check_.node(id).span, codes::kRecursiveValue,
                      join({"`", check_.text(name), "` is defined by itself"}), "only rules may call themselves");
    return {ValueKind::unknown, kRatio, sample, false};
  }
  constexpr size_t kMaxInstances = 20000;
  if (known_.size() >= kMaxInstances) {
    check_.sink.error(check_.node(id).span, codes::kTooLarge,
                      "the program has more than 20000 lets and fields, counted once for each kind of arguments",
                      "write fewer of them, or call them with arguments of fewer kinds");
    return {ValueKind::unknown, kRatio, sample, false};
  }
  if (!canNestDeeper(id)) return {ValueKind::unknown, kRatio, sample, false};
  open_.emplace_back(ref, index);
  Scope outer = std::exchange(scope_, {});
  uint32_t draws = 0;
  const IdRange formals = is_let ? check_.program.lets[index].formals : check_.program.fields[index].formals;
  const ExprId body = is_let ? check_.program.lets[index].body : check_.program.fields[index].body;
  scope_.module = is_let ? check_.program.lets[index].module : check_.program.fields[index].module;
  scope_.draws = &draws;
  scope_.field = !is_let;
  for (uint32_t i = 0; i < formals.count && i < args.size(); ++i)
    scope_.locals.push_back({check_.program.ast.formals[formals.first + i].name, i, args[i], kNoId, 0});
  Type type = checkExpression(body);
  if (is_let) {
    requireDerived(body, "a let");
    type.sample = false;
  } else {
    type.sample = true;
    if (type.kind != ValueKind::number && type.kind != ValueKind::vector && type.kind != ValueKind::unknown &&
        type.kind != ValueKind::boolean)
      check_.sink.error(check_.node(body).span, codes::kTypeMismatch,
                        join({"a field gives a number or a vector, not ", withArticle(typeName(type))}),
                        "name it with `let` instead");
  }
  scope_ = std::move(outer);
  open_.pop_back();
  known_.emplace(std::move(key), type);
  return type;
}

Type Types::useLocalField(ExprId id, const Local& local) {
  Field& field = check_.program.fields[local.field];
  const auto bound =
      bindArguments(check_, symbols_, scope_, id, {check_.text(field.name), viewOf(check_.program, field.formals)});
  if (!bound) return {ValueKind::unknown, kRatio, true, false};
  if (check_.node(id).bound.count == 0) check_.node(id).bound = check_.store(*bound);
  std::vector<Type> args = checkExpressions(*bound);
  requireFormalRanges(field.formals, *bound, args, check_.text(field.name));
  Key key{Ref::field, local.field, keyOf(args)};
  const auto known = known_local_.find(key);
  if (known != known_local_.end()) return known->second;
  if (!canNestDeeper(id)) return {ValueKind::unknown, kRatio, true, false};
  open_.emplace_back(Ref::field, local.field);
  // In the field's body, only locals declared before the field and the field's own parameters are visible.
  std::vector<Local> outer = scope_.locals;
  scope_.locals.resize(local.depth);
  for (uint32_t i = 0; i < field.formals.count && i < args.size(); ++i) {
    const FormalNode& formal = check_.program.ast.formals[field.formals.first + i];
    scope_.locals.push_back({formal.name, formal.slot, args[i], kNoId, 0});
  }
  const bool in_field = std::exchange(scope_.field, true);
  Type type = checkExpression(field.body);
  type.sample = true;
  scope_.field = in_field;
  scope_.locals = std::move(outer);
  open_.pop_back();
  known_local_.emplace(std::move(key), type);
  return type;
}

void Types::checkUnused() {
  std::set<std::pair<Ref, uint32_t>> used;
  for (const auto& [key, type] : known_) used.emplace(std::get<0>(key), std::get<1>(key));
  enter({});
  auto check = [&](Ref ref, uint32_t index, IdRange formals, ExprId body) {
    if (used.count({ref, index}) == 0 && !check_.sink.full())
      useValue(body, ref, index, typesOf(check_.program, formals));
  };
  for (uint32_t i = 0; i < check_.program.lets.size(); ++i)
    check(Ref::let, i, check_.program.lets[i].formals, check_.program.lets[i].body);
  for (uint32_t i = 0; i < check_.program.fields.size(); ++i)
    if (!check_.program.fields[i].local)
      check(Ref::field, i, check_.program.fields[i].formals, check_.program.fields[i].body);
}

}  // namespace sgm
