#include "grammar/check/check.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "grammar/check/arguments.h"
#include "grammar/check/declared_constants.h"
#include "grammar/check/idle_cuts.h"
#include "grammar/check/layer_level.h"
#include "grammar/check/layers.h"
#include "grammar/check/overrides.h"
#include "grammar/text/codes.h"

namespace sgm {

namespace {

/// Requires that all heads of a rule declare the same parameter ranges, since a call passes the same values to each
/// head.
void checkHeadRanges(CheckContext& check, const Rule& rule, const Alternative& head) {
  for (uint32_t i = 0; i < head.formals.count; ++i) {
    const FormalNode& first = check.program.ast.formals[rule.alternatives[0].formals.first + i];
    const FormalNode& here = check.program.ast.formals[head.formals.first + i];
    if (!here.ranged || (first.ranged && first.low == here.low && first.high == here.high && first.dim == here.dim))
      continue;
    const std::string what = join({"`", check.text(here.name), "` of `", check.text(rule.name), "`"});
    check.sink
        .error(here.span, codes::kParamRange,
               first.ranged ? join({"the range of ", what, " differs from that in the first head"})
                            : join({what, " has a range here and none in the first head"}),
               "the range in the first head holds for all heads")
        .notes.push_back(join({"the first head is at ", check.sink.place(rule.alternatives[0].span)}));
  }
}

/// Requires that the heads of a rule are consistent: parameters, ranges and guards.
void checkHeads(CheckContext& check) {
  for (const Rule& rule : check.program.rules) {
    bool when = false, otherwise = false;
    for (const Alternative& a : rule.alternatives) {
      when = when || a.guard == Guard::when;
      otherwise = otherwise || a.guard == Guard::otherwise;
      if (a.formals.count != rule.alternatives[0].formals.count)
        check.sink
            .error(a.span, codes::kArgumentCount,
                   join({"`", check.text(rule.name), "` has ", std::to_string(rule.alternatives[0].formals.count),
                         rule.alternatives[0].formals.count == 1 ? " parameter" : " parameters",
                         " in its first head and ", std::to_string(a.formals.count), " in this one"}),
                   "the heads of a rule have the same parameters")
            .notes.push_back(join({"the first is at ", check.sink.place(rule.alternatives[0].span)}));
      else
        checkHeadRanges(check, rule, a);
    }
    const bool lod = std::any_of(rule.alternatives.begin(), rule.alternatives.end(),
                                 [](const Alternative& a) { return a.lod != kNoId; });
    if (otherwise && !when && !lod && !check.syntax[rule.module].mayDeclare(rule.name))
      check.sink.error(rule.span, codes::kGuards, join({"`", check.text(rule.name), "` has an `else` and no `when`"}),
                       "add a head with `when`, or leave `else` out");
  }
}

/// Checks rules that cannot be reached from any start, and warns of them. This includes rules that are called only by
/// such rules.
void checkUnreached(CheckContext& check, const Symbols& symbols, RuleTypes& rules, Statements& statements) {
  // No warnings after errors: a statement with an error may contain the call that uses the rule.
  const bool warns = check.sink.errorCount() == 0 && symbols.areLayersKnown() && !check.program.layers.empty();
  std::vector<uint32_t> unreached;
  for (uint32_t r = 0; r < check.program.rules.size(); ++r)
    if (!rules.isReached(r)) unreached.push_back(r);
  for (const uint32_t r : unreached) {
    if (check.sink.full()) return;
    const Rule& rule = check.program.rules[r];
    if (rule.module == 0 && warns)
      check.sink.warning(rule.span, codes::kUnusedRule, join({"nothing derives `", check.text(rule.name), "`"}),
                         "call it in a rule, or remove it");
    if (rules.isReached(r)) continue;  // meanwhile, the check of another unreached rule has found a call of this rule
    rules.assume(r, typesOf(check.program, rule.alternatives[0].formals));
    statements.checkRule(r);
    statements.checkWaiting();
  }
}

void warnOfCuts(const CheckContext& check, const Overrides& overrides) {
  const Program& program = check.program;
  for (const Rule& rule : program.rules)
    for (const Alternative& head : rule.alternatives) warnOfIdleCuts(program, head.body, false, check.sink);
  for (uint32_t o = 0; o < program.overrides.size(); ++o)
    warnOfIdleCuts(program, program.overrides[o].body, overrides.mayBeInRoom(o), check.sink);
}

/// Checks rules and overrides. Returns their calls of rules, and their accesses to other layers (probes and queries).
RuleUses checkRules(CheckContext& check, Symbols& symbols, Types& types) {
  RuleUses uses;
  const uint32_t before = check.sink.errorCount();
  checkHeads(check);
  if (check.sink.errorCount() > before) return uses;
  RuleTypes rules(check.program.rules.size());
  Statements statements(check, symbols, types, rules, uses);
  // Checks starts first, then rules in the order of their first calls, since types flow from callers to callees.
  if (check.syntax[0].start != kNoId) statements.start(check.syntax[0].start);
  for (const LayerDecl& layer : check.syntax[0].layers) statements.start(layer.start);
  statements.checkWaiting();
  Overrides overrides(check, symbols, rules, statements, uses);
  overrides.run();
  checkUnreached(check, symbols, rules, statements);
  types.checkUnused();
  LayerLevel(check).mark();
  // after errors, statements may be missing, so that cuts would wrongly seem to have no effect
  if (check.sink.errorCount() == 0) warnOfCuts(check, overrides);
  return uses;
}

/// Sets Rule::calls: the rules that each rule may call.
void keepCalls(Program& program, const std::vector<RuleCall>& calls) {
  for (const RuleCall& call : calls) program.rules[call.from].calls.push_back(call.to);
  for (Rule& rule : program.rules) {
    std::sort(rule.calls.begin(), rule.calls.end());
    rule.calls.erase(std::unique(rule.calls.begin(), rule.calls.end()), rule.calls.end());
  }
}

}  // namespace

CheckFindings checkProgram(Program& program, NameTable& names, const std::vector<ModuleSyntax>& syntax,
                           const CompileLimits& limits, DiagnosticSink& sink, bool library) {
  const uint32_t before = sink.errorCount();
  CheckContext check{program, names, syntax, limits, sink, library, before > 0};
  Symbols symbols(check);
  Types types(check, symbols);
  checkFormalLiterals(check);
  symbols.collect();
  numberAssetMaterials(check);
  if (sink.errorCount() > before) return {{}, symbols.usesWhatIsLost()};
  checkFormalRanges(check, types);
  checkParams(check, types);
  checkSeed(check, types);
  checkDomain(check, types);
  checkLayers(check, symbols, types);
  if (sink.full()) return {{}, symbols.usesWhatIsLost()};
  RuleUses uses = checkRules(check, symbols, types);
  keepCalls(program, uses.calls);
  checkAskedLayers(check, uses);
  checkExpectations(check, symbols, types);
  return {std::move(uses.calls), symbols.usesWhatIsLost()};
}

}  // namespace sgm
