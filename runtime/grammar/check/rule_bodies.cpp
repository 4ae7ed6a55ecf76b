// Checks rules and overrides: their heads, parameters and calls.

#include <algorithm>
#include <iterator>
#include <utility>

#include "grammar/check/arguments.h"
#include "grammar/check/statements.h"
#include "grammar/text/codes.h"

namespace sgm {

namespace {

constexpr const char* kWeightHint = "write how often this head is drawn relative to the others, such as weight 2";
constexpr const char* kShapeHint = "write a shape such as sphere(2m), or a rule";

/// Returns a hint for a function that is used where a shape is expected: other languages combine distance fields with
/// functions such as mix or min.
std::string_view shapeHint(const ExprNode& call) {
  if (call.ref != Ref::builtin) return kShapeHint;
  switch (static_cast<Builtin>(call.id)) {
    case Builtin::mix:
      return "to blend two shapes, write `morph(A, B, 0.5);`";
    case Builtin::min:
      return "to join two shapes, write `union { ... }`";
    case Builtin::max:
      return "to keep what two shapes have in common, write `meet { ... }`";
    default:
      return kShapeHint;
  }
}

/// Whether values of this kind may be arguments of rules. True for unknown types, which result from an earlier error.
bool isPassed(ValueKind kind) {
  switch (kind) {
    case ValueKind::unknown:
    case ValueKind::number:
    case ValueKind::boolean:
    case ValueKind::vector:
    case ValueKind::cell:
    case ValueKind::face:
    case ValueKind::segment:
    case ValueKind::plan:
      return true;
    case ValueKind::pair:
    case ValueKind::faces:
    case ValueKind::segments:
    case ValueKind::range:
    case ValueKind::text:
      return false;
  }
  return false;
}

/// Warns if heads of the rule use different parameter names: an override's block replaces all heads, but uses the names
/// of the first head.
void warnOfNames(CheckContext& check, const Override& edit, uint32_t rule, uint32_t parameter) {
  const auto& heads = check.program.rules[rule].alternatives;
  const auto nameIn = [&](const Alternative& head) {
    return check.program.ast.formals[head.formals.first + parameter].name;
  };
  for (const Alternative& head : heads) {
    if (nameIn(head) == nameIn(heads[0])) continue;
    check.sink.warning(
        edit.address_span, codes::kParameterNames,
        join({"the heads of `", check.text(check.program.rules[rule].name), "` call one parameter `",
              check.text(nameIn(heads[0])), "` and `", check.text(nameIn(head)), "`"}),
        join({"here it is `", check.text(nameIn(heads[0])), "`, as in the first: use one name in all of them"}));
    return;
  }
}

}  // namespace

void Statements::start(ExprId call) {
  types_.enter({});
  callRule(call, false, false);
  uses_ = {};  // a start call belongs to no rule, so it is not recorded
}

void Statements::checkWaiting() {
  while (!check_.sink.full()) {
    const std::optional<uint32_t> rule = rules_.takeWaiting();
    if (!rule) return;
    checkRule(*rule);
  }
}

void Statements::checkRule(uint32_t rule) {
  // If a rule is checked again, because a parameter's dimension became known later, drop the calls recorded by the
  // earlier check.
  if (!rules_.beginCheck(rule)) {
    std::erase_if(rule_uses_.calls, [&](const RuleCall& call) { return call.from == rule; });
    std::erase_if(rule_uses_.asked, [&](const AskedLayer& asked) { return asked.rule == rule; });
  }
  ordinal_ = draws_ = 0;
  for (uint32_t a = 0; a < check_.program.rules[rule].alternatives.size(); ++a) checkAlternative(rule, a);
  const auto& heads = check_.program.rules[rule].alternatives;
  const bool never = std::ranges::all_of(heads, [&](const Alternative& head) {
    return head.weight != kNoId && types_.fold(head.weight) == std::optional(0.0);
  });
  if (never)
    check_.sink.error(check_.node(heads[0].weight).span, codes::kValueRange,
                      join({"all heads of `", check_.text(check_.program.rules[rule].name),
                            "` have weight 0, so none is ever drawn"}),
                      "give one of them a weight above 0");
}

/// Begins a body with an empty scope.
void Statements::enterBody(StmtId body, uint32_t module) {
  body_ = body;
  scales_.clear();
  uses_ = {};
  Scope scope;
  scope.module = module;
  scope.draws = &draws_;
  scope.asked = &uses_.asked;
  types_.enter(std::move(scope));
}

void Statements::checkAlternative(uint32_t rule, uint32_t alternative) {
  rule_ = rule;
  alternative_ = alternative;
  Alternative& head = check_.program.rules[rule].alternatives[alternative];
  enterBody(head.body, check_.program.rules[rule].module);
  head.size_slot = kNoId;  // recomputed, since a second check may know more types
  for (uint32_t i = 0; i < head.formals.count; ++i) {
    FormalNode& formal = check_.program.ast.formals[head.formals.first + i];
    formal.type = rules_.of(rule)[i];
    types_.declareLocal(formal.name, formal.span, {formal.name, i, formal.type, kNoId, 0});
    if (head.size_slot == kNoId && formal.type.kind == ValueKind::number && formal.type.dim == kLength)
      head.size_slot = i;
  }
  types_.scope().next_slot = types_.scope().slot_count = head.formals.count;
  checkHead(head);
  checkStatement(head.body, false);
  head.slot_count = types_.scope().slot_count;
  for (AskedLayer& asked : uses_.asked) asked.rule = rule;
  std::move(uses_.calls.begin(), uses_.calls.end(), std::back_inserter(rule_uses_.calls));
  std::move(uses_.asked.begin(), uses_.asked.end(), std::back_inserter(rule_uses_.asked));
}

/// Checks the conditions of a head, and the calls that replace its body when its `depth` or `minsize` is reached.
void Statements::checkHead(const Alternative& head) {
  if (head.when != kNoId) types_.require(head.when, ValueKind::boolean, kRatio, "a guard");
  if (head.weight != kNoId) {
    types_.require(head.weight, ValueKind::number, kRatio, "a weight");
    if (const std::optional<double> weight = types_.fold(head.weight); weight && *weight < 0)
      check_.sink.error(check_.node(head.weight).span, codes::kValueRange,
                        join({"a weight is 0 or more, and this is ", numberText(*weight)}), kWeightHint);
  }
  if (head.depth != kNoId) types_.require(head.depth, ValueKind::number, kRatio, "a depth");
  constexpr double kDeepest = 64;  // DeriveLimits::depth
  if (head.depth != kNoId && check_.node(head.depth).kind == ExprKind::number &&
      check_.node(head.depth).value > kDeepest)
    check_.sink.warning(check_.node(head.depth).span, codes::kValueRange, "rules may be nested at most 64 deep",
                        "a cell that goes deeper is not derived at all");
  if (head.depth_call != kNoId) callRule(head.depth_call, true, false);
  if (head.minsize != kNoId) types_.require(head.minsize, ValueKind::number, kLength, "a least size");
  if (head.minsize_call != kNoId) callRule(head.minsize_call, true, false);
  if (head.lod != kNoId) types_.require(head.lod, ValueKind::number, kLength, "a level of detail");
}

RuleUses Statements::checkOverride(uint32_t index) {
  Override& edit = check_.program.overrides[index];
  rule_ = kNoId;
  alternative_ = 0;
  ordinal_ = draws_ = 0;
  enterBody(edit.body, 0);
  if (edit.steps.count > 0) {
    const uint32_t rule = check_.program.path_steps[edit.steps.first + edit.steps.count - 1].rule;
    const IdRange formals = check_.program.rules[rule].alternatives[0].formals;
    for (uint32_t i = 0; i < formals.count; ++i) {
      const FormalNode& formal = check_.program.ast.formals[formals.first + i];
      warnOfNames(check_, edit, rule, i);
      types_.declareLocal(formal.name, formal.span, {formal.name, i, rules_.of(rule)[i], kNoId, 0});
    }
    types_.scope().next_slot = types_.scope().slot_count = formals.count;
  }
  checkStatement(edit.body, false);
  edit.slot_count = types_.scope().slot_count;
  return std::exchange(uses_, {});
}

void Statements::callRule(ExprId call, bool escape, bool shrunk) {
  ExprNode& n = check_.node(call);
  if (n.children.count > 0 && !symbols_.resolveCallee(call, types_.scope(), true)) {
    check_.sink.error(n.span, codes::kWrongUse, join({"`", check_.text(n.name), "` is not a shape"}), kShapeHint);
    return;
  }
  symbols_.resolveCallee(call, types_.scope(), true);
  if (n.ref == Ref::primitive) return types_.checkPrimitive(call);
  if (n.ref != Ref::rule) {
    if (n.ref != Ref::none)
      check_.sink.error(n.span, codes::kWrongUse,
                        join({"`", check_.text(n.name), "` gives a value and is not a shape"}),
                        std::string(shapeHint(n)));
    types_.checkLooseArguments(n);
    return;
  }
  const uint32_t rule = n.id;
  const IdRange formals = check_.program.rules[rule].alternatives[0].formals;
  const auto bound =
      bindArguments(check_, symbols_, types_.scope(), call, {check_.text(n.name), viewOf(check_.program, formals)});
  if (!bound) return;
  if (n.bound.count == 0) n.bound = check_.store(*bound);
  std::vector<Type> types = types_.checkExpressions(*bound);
  if (!checkPassed(n, *bound, types)) return;
  uses_.calls.push_back({rule_, alternative_, rule, call, escape, shrunk, scales_});
  if (!rules_.isReached(rule)) {
    types_.requireFormalRanges(formals, *bound, types, check_.text(n.name));
    return rules_.reach(rule, std::move(types));
  }
  for (size_t i = 0; i < types.size(); ++i) {
    const Type known = rules_.of(rule)[i];
    // An earlier call passed the literal 0, which fits every dimension; now the dimension is known, so the body is
    // checked again with it.
    if (known.kind == ValueKind::unknown || (known.any_dim && !types[i].any_dim && known.kind == types[i].kind))
      rules_.refine(rule, i, types[i]);
    else
      types_.requireType((*bound)[i], types[i], known.kind, known.dim,
                         join({"`", check_.text(check_.program.ast.formals[formals.first + i].name), "` of `",
                               check_.text(n.name), "`"}));
  }
}

/// Requires that arguments may be passed to rules: their kinds are permitted, and their values are known at derivation
/// time. Returns false after reporting an error about a kind.
bool Statements::checkPassed(const ExprNode& call, const std::vector<uint32_t>& bound, std::vector<Type>& types) {
  bool good = true;
  const std::string what = join({"an argument of `", check_.text(call.name), "`"});
  for (size_t i = 0; i < bound.size(); ++i) {
    types_.requireDerived(bound[i], what);
    types[i].sample = false;
    if (isPassed(types[i].kind)) continue;
    good = false;
    check_.sink.error(check_.node(bound[i]).span, codes::kTypeMismatch,
                      join({what, " cannot be a ", typeName(types[i])}),
                      "rules take numbers, vectors, conditions, cells, faces and segments");
  }
  return good;
}

}  // namespace sgm
