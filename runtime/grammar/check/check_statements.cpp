#include <algorithm>
#include <set>
#include <utility>

#include "grammar/check/check.h"
#include "grammar/text/codes.h"

namespace sgm {

namespace {

constexpr const char* kWeightHint = "write how often this head is drawn relative to the others, such as weight 2";
constexpr const char* kShapeHint = "write a shape such as sphere(2m), or a rule";

/// Other languages combine distance fields with such functions.
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

bool roundOrBox(Primitive p) {
  return p == Primitive::sphere || p == Primitive::blob || p == Primitive::ellipsoid || p == Primitive::box ||
         p == Primitive::superq;
}

}  // namespace

void Checker::checkRules() {
  const uint32_t before = sink_.errorCount();
  rule_types_.assign(program_.rules.size(), {});
  rule_state_.assign(program_.rules.size(), 0);
  start_rules_.assign(program_.rules.size(), false);
  for (uint32_t r = 0; r < program_.rules.size(); ++r) {
    const Rule& rule = program_.rules[r];
    bool when = false, otherwise = false;
    for (const Alternative& a : rule.alternatives) {
      when = when || a.guard == Guard::when;
      otherwise = otherwise || a.guard == Guard::otherwise;
      if (a.formals.count != rule.alternatives[0].formals.count)
        sink_
            .error(a.span, codes::kArgumentCount,
                   join({"`", text(rule.name), "` has ", std::to_string(rule.alternatives[0].formals.count),
                         rule.alternatives[0].formals.count == 1 ? " parameter" : " parameters",
                         " in its first head and ", std::to_string(a.formals.count), " in this one"}),
                   "the heads of a rule have the same parameters")
            .notes.push_back(join({"the first is at ", sink_.place(rule.alternatives[0].span)}));
      else
        headRanges(rule, a);
    }
    const bool lod = std::any_of(rule.alternatives.begin(), rule.alternatives.end(),
                                 [](const Alternative& a) { return a.lod != kNoId; });
    if (otherwise && !when && !lod && !syntax_[rule.module].mayDeclare(rule.name))
      sink_.error(rule.span, codes::kGuards, join({"`", text(rule.name), "` has an `else` and no `when`"}),
                  "add a head with `when`, or leave `else` out");
  }
  if (sink_.errorCount() > before) return;

  // Starts first, then their callees, in order of the first call: types flow from callers to callees.
  auto startAt = [&](ExprId call) {
    scope_ = {};
    callRule(call, false, false);
    if (node(call).ref == Ref::rule) start_rules_[node(call).id] = true;
  };
  rule_ = kNoId;
  if (syntax_[0].start != kNoId) startAt(syntax_[0].start);
  for (const LayerDecl& layer : syntax_[0].layers) startAt(layer.start);
  checkWaiting();
  overrides();
  // The calls of a statement with an error are unknown.
  const bool calls_known = sink_.errorCount() == 0;
  for (uint32_t r = 0; r < program_.rules.size() && !sink_.full(); ++r) {
    if (rule_state_[r] != 0) continue;
    const Rule& rule = program_.rules[r];
    if (rule.module == 0 && calls_known && layers_known_ && !program_.layers.empty())
      sink_.warning(rule.span, codes::kUnusedRule, join({"nothing derives `", text(rule.name), "`"}),
                    "call it in a rule, or remove it");
    rule_types_[r] = typesOf(rule.alternatives[0].formals);
    checkRule(r);
  }
  checkUnusedValues();
  for (uint32_t r = 0; r < program_.rules.size(); ++r)
    if (start_rules_[r])
      for (const Alternative& a : program_.rules[r].alternatives) markLayerLevel(a.body);
  for (uint32_t o = 0; o < program_.overrides.size(); ++o) {
    const IdRange steps = program_.overrides[o].steps;
    if (steps.count != 1) continue;
    const auto& heads = program_.rules[program_.path_steps[steps.first].rule].alternatives;
    markOverride(o, std::any_of(heads.begin(), heads.end(), [&](const Alternative& a) { return cutsDomain(a.body); }));
  }
  if (sink_.errorCount() > 0) return;  // cannot be judged after errors
  for (const Rule& rule : program_.rules)
    for (const Alternative& a : rule.alternatives) idleCuts(a.body, false);
  for (uint32_t o = 0; o < program_.overrides.size(); ++o) {
    const StmtId body = program_.overrides[o].body;
    room_overrides_.contains(o) ? idleCutsIn(body) : idleCuts(body, false);
  }
}

/// Callers give the same values to all heads, so one range applies to them.
void Checker::headRanges(const Rule& rule, const Alternative& head) {
  for (uint32_t i = 0; i < head.formals.count; ++i) {
    const FormalNode& first = program_.ast.formals[rule.alternatives[0].formals.first + i];
    const FormalNode& here = program_.ast.formals[head.formals.first + i];
    if (!here.ranged || (first.ranged && first.low == here.low && first.high == here.high && first.dim == here.dim))
      continue;
    const std::string what = join({"`", text(here.name), "` of `", text(rule.name), "`"});
    sink_
        .error(here.span, codes::kParamRange,
               first.ranged ? join({"the range of ", what, " differs from that in the first head"})
                            : join({what, " has a range here and none in the first head"}),
               "the range in the first head holds for all heads")
        .notes.push_back(join({"the first head is at ", sink_.place(rule.alternatives[0].span)}));
  }
}

void Checker::checkWaiting() {
  for (; next_waiting_ < waiting_.size() && !sink_.full(); ++next_waiting_) checkRule(waiting_[next_waiting_]);
}

/// Checks unused lets and fields as well.
void Checker::checkUnusedValues() {
  std::set<std::pair<Ref, uint32_t>> used;
  for (const auto& [key, type] : known_) used.emplace(std::get<0>(key), std::get<1>(key));
  scope_ = {};
  auto check = [&](Ref ref, uint32_t index, IdRange formals, ExprId body) {
    if (used.count({ref, index}) == 0 && !sink_.full()) letOrField(body, ref, index, typesOf(formals));
  };
  for (uint32_t i = 0; i < program_.lets.size(); ++i)
    check(Ref::let, i, program_.lets[i].formals, program_.lets[i].body);
  for (uint32_t i = 0; i < program_.fields.size(); ++i)
    if (!program_.fields[i].local) check(Ref::field, i, program_.fields[i].formals, program_.fields[i].body);
}

void Checker::checkRule(uint32_t rule) {
  rule_state_[rule] = 2;
  // If a rule is checked again, with a dimension found later, drop its earlier calls.
  if (!checked_.insert(rule).second) {
    std::erase_if(calls_, [&](const RuleCall& call) { return call.from == rule; });
    std::erase_if(asked_, [&](const AskedLayer& asked) { return asked.rule == rule; });
  }
  ordinal_ = draws_ = 0;
  for (uint32_t a = 0; a < program_.rules[rule].alternatives.size(); ++a) checkAlternative(rule, a);
  const auto& heads = program_.rules[rule].alternatives;
  const bool never = std::ranges::all_of(heads, [&](const Alternative& head) {
    return head.weight != kNoId && fold(head.weight, 0) == std::optional(0.0);
  });
  if (never)
    sink_.error(node(heads[0].weight).span, codes::kValueRange,
                join({"all heads of `", text(program_.rules[rule].name), "` have weight 0, so none is ever drawn"}),
                "give one of them a weight above 0");
}

void Checker::checkAlternative(uint32_t rule, uint32_t alternative) {
  rule_ = rule;
  alternative_ = alternative;
  known_local_.clear();
  scope_ = {};
  scope_.module = program_.rules[rule].module;
  scope_.rule = true;
  scope_.draws = &draws_;
  Alternative& head = program_.rules[rule].alternatives[alternative];
  head.size_slot = kNoId;  // a second check may know better which parameter is a length
  scales_.clear();
  for (uint32_t i = 0; i < head.formals.count; ++i) {
    FormalNode& formal = program_.ast.formals[head.formals.first + i];
    formal.type = rule_types_[rule][i];
    declareLocal(formal.name, formal.span, {formal.name, i, formal.type, kNoId, 0});
    if (head.size_slot == kNoId && formal.type.kind == ValueKind::number && formal.type.dim == kLength)
      head.size_slot = i;
  }
  scope_.next_slot = scope_.slot_count = head.formals.count;
  if (head.when != kNoId) demand(head.when, ValueKind::boolean, kRatio, "a guard");
  if (head.weight != kNoId) {
    demand(head.weight, ValueKind::number, kRatio, "a weight");
    if (const std::optional<double> weight = fold(head.weight, 0); weight && *weight < 0)
      sink_.error(node(head.weight).span, codes::kValueRange,
                  join({"a weight is 0 or more, and this is ", numberText(*weight)}), kWeightHint);
  }
  if (head.depth != kNoId) demand(head.depth, ValueKind::number, kRatio, "a depth");
  constexpr double kDeepest = 64;  // DeriveLimits::depth
  if (head.depth != kNoId && node(head.depth).kind == ExprKind::number && node(head.depth).value > kDeepest)
    sink_.warning(node(head.depth).span, codes::kValueRange, "rules may be nested at most 64 deep",
                  "a cell that goes deeper is not derived at all");
  if (head.depth_call != kNoId) callRule(head.depth_call, true, false);
  if (head.minsize != kNoId) demand(head.minsize, ValueKind::number, kLength, "a least size");
  if (head.minsize_call != kNoId) callRule(head.minsize_call, true, false);
  if (head.lod != kNoId) demand(head.lod, ValueKind::number, kLength, "a level of detail");
  statement(head.body, false);
  program_.rules[rule].alternatives[alternative].slot_count = scope_.slot_count;
}

void Checker::declareLocal(NameId name, const Span& span, Local local) {
  const std::string_view word = text(name);
  if (word == "cell" || word == "scope" || word == "p" || word == "q" || word == "u") {
    sink_.error(span, codes::kShadowsBuiltin, join({"`", word, "` is a value of the language"}),
                join({"choose another name, such as `", word, "_`"}));
    return;
  }
  for (const Local& known : scope_.locals)
    if (known.name == name) {
      sink_.error(span, codes::kDuplicate, join({"`", word, "` is declared twice in this rule"}), "rename one of them");
      return;
    }
  scope_.locals.push_back(local);
  scope_.slot_count = std::max(scope_.slot_count, scope_.next_slot);
}

void Checker::callRule(ExprId call, bool escape, bool shrunk) {
  ExprNode& n = node(call);
  if (n.children.count > 0 && !resolveCallee(call, true)) {
    sink_.error(n.span, codes::kWrongUse, join({"`", text(n.name), "` is not a shape"}), kShapeHint);
    return;
  }
  resolveCallee(call, true);
  if (n.ref == Ref::primitive) return primitiveCall(call);
  if (n.ref != Ref::rule) {
    if (n.ref != Ref::none)
      sink_.error(n.span, codes::kWrongUse, join({"`", text(n.name), "` gives a value and is not a shape"}),
                  std::string(shapeHint(n)));
    for (uint32_t i = 0; i < n.args.count; ++i) expression(program_.ast.args[n.args.first + i].value);
    return;
  }
  const uint32_t rule = n.id;
  std::vector<uint32_t> bound;
  if (!bind(call, text(n.name), viewOf(program_.rules[rule].alternatives[0].formals), false, bound)) return;
  if (n.bound.count == 0) n.bound = store(bound);
  std::vector<Type> types;
  for (uint32_t b : bound) types.push_back(expression(b));
  bool good = true;
  for (size_t i = 0; i < bound.size(); ++i) {
    const std::string what = join({"an argument of `", text(n.name), "`"});
    deriveOnly(bound[i], what);
    types[i].sample = false;
    if (types[i].kind == ValueKind::boolean || types[i].kind == ValueKind::number ||
        types[i].kind == ValueKind::vector || types[i].kind == ValueKind::cell || types[i].kind == ValueKind::face ||
        types[i].kind == ValueKind::segment || types[i].kind == ValueKind::plan || types[i].kind == ValueKind::unknown)
      continue;
    good = false;
    sink_.error(node(bound[i]).span, codes::kTypeMismatch, join({what, " cannot be a ", typeName(types[i])}),
                "rules take numbers, vectors, conditions, cells, faces and segments");
  }
  if (!good) return;
  if (rule_ != kNoId) calls_.push_back({rule_, alternative_, rule, call, escape, shrunk, scales_});
  // It adds no cycle of calls: in its own block no override applies again.
  if (override_ != kNoId) override_calls_[override_].push_back(rule);
  if (rule_state_[rule] == 0) {
    rule_state_[rule] = 1;
    demandRanged(program_.rules[rule].alternatives[0].formals, bound, types, text(n.name));
    rule_types_[rule] = types;
    waiting_.push_back(rule);
    return;
  }
  for (size_t i = 0; i < types.size(); ++i) {
    Type& formal = rule_types_[rule][i];
    const NameId formal_name = program_.ast.formals[program_.rules[rule].alternatives[0].formals.first + i].name;
    if (formal.kind == ValueKind::unknown || (formal.any_dim && !types[i].any_dim && formal.kind == types[i].kind)) {
      // The literal 0 left the dimension open; now it is known, and the body is checked with it.
      if (formal == types[i]) continue;
      formal = types[i];
      if (rule_state_[rule] == 2) {
        rule_state_[rule] = 1;
        waiting_.push_back(rule);
      }
      continue;
    }
    demandType(bound[i], types[i], formal.kind, formal.dim,
               join({"`", text(formal_name), "` of `", text(n.name), "`"}));
  }
}

void Checker::statement(StmtId id, bool shrunk) {
  if (id == kNoId || sink_.full()) return;
  StmtNode& s = program_.ast.stmts[id];
  s.ordinal = ordinal_++;
  const StmtNode copy = s;
  switch (copy.kind) {
    case StmtKind::block: {
      const size_t locals = scope_.locals.size();
      blockStatements(copy, shrunk);
      scope_.locals.resize(locals);
      uint16_t material = 0, tag = 0;
      for (uint32_t i = 0; i < copy.children.count; ++i) {
        const StmtNode& child_node = program_.stmt(program_.idAt(copy.children, i));
        uint16_t* slot = child_node.kind == StmtKind::mat   ? &material
                         : child_node.kind == StmtKind::tag ? &tag
                                                            : nullptr;
        if (slot == nullptr) continue;
        if (*slot != 0)
          sink_.error(
              child_node.span, codes::kDuplicate,
              child_node.kind == StmtKind::mat ? "this block has a second `mat`" : "this block has a second `tag`",
              "it holds for the whole block; open another block for the other");
        *slot = static_cast<uint16_t>(child_node.extra);
      }
      program_.ast.stmts[id].material = material;
      program_.ast.stmts[id].tag = tag;
      return;
    }
    case StmtKind::call:
      return callRule(copy.expr, false, shrunk);
    case StmtKind::sum:
      if (!sumLeaf(copy.body)) return;
      [[fallthrough]];
    case StmtKind::unite:
    case StmtKind::cut:
    case StmtKind::meet:
      demand(copy.amount, ValueKind::number, kLength, "the width of a smooth join");
      return statement(copy.body, shrunk);
    case StmtKind::morph:
      return morphStatement(copy, shrunk);
    case StmtKind::displace:
      demand(copy.expr, ValueKind::number, kLength, "a displacement", true);
      demand(copy.amount, ValueKind::number, kLength, "the bound of a displacement");
      return statement(copy.body, shrunk);
    case StmtKind::warp:
      demand(copy.expr, ValueKind::vector, kLength, "a warp", true);
      demand(copy.amount, ValueKind::number, kLength, "the bound of a warp");
      return statement(copy.body, shrunk);
    case StmtKind::transform: {
      const size_t outside = scales_.size();
      const bool shrinks = xforms(copy.xforms, false);
      statement(copy.body, shrunk || shrinks);
      scales_.resize(outside);
      return;
    }
    case StmtKind::repeat: {
      demand(copy.expr, ValueKind::number, kRatio, "a count");
      const size_t outside = scales_.size();
      xforms(copy.xforms, true);
      statement(copy.body, shrunk);
      scales_.resize(outside);
      return;
    }
    case StmtKind::for_each:
      return forEach(id, copy, shrunk);
    case StmtKind::scatter:
      return scatterStatement(copy, shrunk);
    case StmtKind::split:
      return splitStatement(copy);
    case StmtKind::snap:
      return snapStatement(copy, shrunk);
    case StmtKind::comp:
      return partStatements(copy);
    case StmtKind::treemap:
      return treemap(copy);
    case StmtKind::wfc:
      return wave(copy);
    case StmtKind::let: {
      Type type = expression(copy.expr);
      deriveOnly(copy.expr, "a let");
      type.sample = false;
      const uint32_t slot = scope_.next_slot++;
      program_.ast.stmts[id].slot = slot;
      return declareLocal(copy.name, copy.span, {copy.name, slot, type, kNoId, 0});
    }
    case StmtKind::field:
      return localField(copy);
    case StmtKind::mat:
      program_.ast.stmts[id].extra = tableIndex(program_.materials, copy.name, copy.span);
      return;
    case StmtKind::tag:
      program_.ast.stmts[id].extra = tableIndex(program_.tags, copy.name, copy.span);
      return;
    case StmtKind::anchor:
      program_.ast.stmts[id].extra = tableIndex(program_.names, copy.name, copy.span);
      program_.ast.stmts[id].extra2 = copy.name2 == kNoId ? 0 : tableIndex(program_.names, copy.name2, copy.span);
      return;
    case StmtKind::detail:
      return detail(copy, shrunk);
    case StmtKind::footprint:
      return footprint(id, copy);
    case StmtKind::extrude:
      return extrude(copy, shrunk);
    case StmtKind::roof:
      return roof(copy);
    case StmtKind::fit:
      return fit(copy);
    case StmtKind::inner:
    case StmtKind::link:    // checked by its treemap
    case StmtKind::border:  // by its wfc
      return;
  }
}

void Checker::blockStatements(const StmtNode& node, bool shrunk) {
  for (uint32_t i = 0; i < node.children.count; ++i) statement(program_.idAt(node.children, i), shrunk);
}

bool Checker::sumLeaf(StmtId id) {
  const StmtNode& s = program_.stmt(id);
  if (s.kind == StmtKind::cut || s.kind == StmtKind::meet || s.kind == StmtKind::displace || s.kind == StmtKind::warp ||
      s.kind == StmtKind::roof || s.kind == StmtKind::fit) {
    sink_.error(s.span, codes::kWrongUse, "a sum has leaves only: spheres, blobs and other primitives",
                "cut, displace or warp the sum as a whole");
    return false;
  }
  if (s.kind == StmtKind::extrude && s.body != kNoId) return sumLeaf(s.body);
  if (s.kind != StmtKind::block) return true;
  for (uint32_t i = 0; i < s.children.count; ++i)
    if (!sumLeaf(program_.idAt(s.children, i))) return false;
  return true;
}

void Checker::morphStatement(const StmtNode& node_in, bool shrunk) {
  demand(node_in.expr, ValueKind::number, kRatio, "the t of a morph", true);
  for (uint32_t i = 0; i < 2; ++i) {
    const StmtId operand = program_.idAt(node_in.children, i);
    statement(operand, shrunk);
    if (!node_in.power) continue;
    const StmtNode& s = program_.stmt(operand);
    const bool good = s.kind == StmtKind::call && node(s.expr).ref == Ref::primitive &&
                      roundOrBox(static_cast<Primitive>(node(s.expr).id));
    const bool understood = s.kind != StmtKind::call || node(s.expr).ref != Ref::none;
    if (!good && understood)
      sink_.error(s.span, codes::kWrongUse, "`power` morphs spheres, ellipsoids, superquadrics and boxes",
                  "leave `power` out for a linear morph");
  }
}

void Checker::localField(const StmtNode& s) {
  Field& field = program_.fields[s.extra];
  for (uint32_t i = 0; i < field.formals.count; ++i)
    program_.ast.formals[field.formals.first + i].slot = scope_.next_slot++;
  const Local local{field.name, 0, {}, s.extra, scope_.locals.size()};
  declareLocal(field.name, field.span, local);
  scope_.slot_count = std::max(scope_.slot_count, scope_.next_slot);
  field.slot_count = scope_.slot_count;
  if (field.formals.count > 0) return;
  // Without parameters it can be checked here, used or not.
  const size_t locals = scope_.locals.size();
  scope_.locals.resize(local.depth);
  const bool in_field = std::exchange(scope_.field, true);
  Type type = expression(field.body);
  scope_.field = in_field;
  if (type.kind != ValueKind::number && type.kind != ValueKind::vector && type.kind != ValueKind::boolean &&
      type.kind != ValueKind::unknown)
    sink_.error(node(field.body).span, codes::kTypeMismatch,
                join({"a field gives a number or a vector, not a ", typeName(type)}), "name it with `let` instead");
  if (locals > local.depth) scope_.locals.push_back(local);
}

}  // namespace sgm
