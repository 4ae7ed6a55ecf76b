#include "grammar/reach/reach_rules.h"

#include <algorithm>
#include <cmath>

#include "grammar/range/reach_shapes.h"
#include "grammar/reach/reach_statements.h"
#include "grammar/text/codes.h"

namespace sgm::reach {

namespace {

/// Warns of weights that may be negative: derivation treats these as 0, which is never intended.
void checkWeight(ExprId id, Interval weight, ReachContext& context) {
  if (context.pieces.isDividing() || context.start_calls.isRestricted() || weight.lo >= 0 || !weight.bounded()) return;
  const ExprId caller = context.values.calls().writtenCaller(id);
  const Span& span = context.program.expr(caller != kNoId ? caller : id).span;
  if (weight.hi < 0)
    context.sink.error(span, codes::kValueRange,
                       join({"a weight is 0 or more, and this is at most ", numberText(weight.hi)}),
                       "write how often this head is drawn relative to the others, such as weight 2");
  else
    context.sink.warning(span, codes::kValueRange, join({"this weight may be as low as ", numberText(weight.lo)}),
                         "below 0 it counts as 0: bound what it depends on, or write max(..., 0)");
}

/// Returns the extent of a head: the union of the extents of its block, and of the calls that replace the block when
/// the head's depth or minsize limit is reached.
Extent boundAlternative(uint32_t rule, const Alternative& head, RangeFrame& frame, ReachContext& context) {
  RangeEvaluator& values = context.values;
  std::optional<Extent> out;
  const auto addInstead = [&](ExprId call) { addAlternative(out, boundCall(call, CallSite::instead, frame, context)); };
  if (head.depth != kNoId) {
    const Interval most = values.number(head.depth, frame);
    const double activations = context.rules.activations(rule) - 1;
    if (activations >= most.lo) addInstead(head.depth_call);
    if (activations >= most.hi) return out.value_or(Extent::nothing());
  }
  if (head.minsize != kNoId) {
    // `minsize` is compared with the final size, so the result depends on the scale of the scope.
    values.dependence().scale = true;
    const Interval scale = frame.place.scale, least = values.number(head.minsize, frame);
    Interval size{};
    for (const Interval& edge : frame.scope) size = maximum(size, edge);
    if (head.size_slot != kNoId) size = frame.slots[head.size_slot].v[0];
    if ((size * scale).lo < least.hi) addInstead(head.minsize_call);
    if ((size * scale).hi < least.lo) return out.value_or(Extent::nothing());
    if (head.size_slot != kNoId && scale.lo > 0) {
      Interval& slot = frame.slots[head.size_slot].v[0];
      slot.lo = std::min(std::max(slot.lo, least.lo / (least.lo > 0 ? scale.hi : scale.lo) * (1 - 1e-12)), slot.hi);
    }
  }
  addAlternative(out, boundStatement(head.body, frame, context));
  return *out;
}

/// Returns the extent of a use of a rule, from the cache if possible. replacing: the overrides by path whose blocks may
/// replace this use.
Extent boundUse(uint32_t rule, const std::vector<RangeValue>& args, const RangeFrame& caller, bool top,
                const std::vector<uint32_t>& replacing, ReachContext& context) {
  RuleExtents& rules = context.rules;
  Dependence& dependence = context.values.dependence();
  const RuleExtents::Use use = rules.describe(rule, top, args, caller, context.overrides.key(replacing));
  if (const Extent* known = rules.find(use, dependence)) return *known;
  if (context.budget.cutAtLimit() || !rules.begin(use)) return Extent::unbounded();
  const Dependence before = std::exchange(dependence, {});
  context.budget.enter();
  RangeFrame frame = caller;
  frame.top = top;
  const Extent out = context.overrides.boundUse(rule, args, replacing, frame, context);
  context.budget.leave();
  rules.end(use, dependence, out);
  dependence = {dependence.place || before.place, dependence.scale || before.scale};
  return out;
}

Extent boundRule(uint32_t rule, const std::vector<RangeValue>& args, const RangeFrame& caller, bool top,
                 ReachContext& context) {
  const OverrideExtents::State outside = context.overrides.state();
  const std::vector<uint32_t> replacing = context.overrides.enter(rule);
  const Extent out = boundUse(rule, args, caller, top, replacing, context);
  context.overrides.restore(outside);
  return out;
}

Extent boundRuleInPieces(uint32_t rule, std::vector<RangeValue> args, const RangeFrame& caller, bool top,
                         ReachContext& context) {
  std::vector<RangeValue*> values;
  for (RangeValue& arg : args) values.push_back(&arg);
  return context.pieces.boundOver(
      values, [&] { return boundRule(rule, args, caller, top, context); }, context.budget);
}

}  // namespace

Extent boundCall(ExprId id, CallSite site, const RangeFrame& frame, ReachContext& context) {
  if (id == kNoId) return Extent::nothing();
  const Program& program = context.program;
  RangeEvaluator& values = context.values;
  const ExprNode& n = program.expr(id);
  const bool in_own_rule = site == CallSite::statement && context.rules.isInOwnRule();
  if (in_own_rule && !context.start_calls.admit(id)) return Extent::nothing();
  if (n.ref == Ref::primitive) {
    const bool automaton = static_cast<Primitive>(n.id) == Primitive::ca;
    Extent e = automaton ? boundAutomaton(n, frame, context) : primitiveExtent(program, n, values, frame);
    e.attribute(id);
    return e;
  }
  if (n.ref != Ref::rule) return Extent::nothing();
  std::vector<RangeValue> args;
  for (uint32_t i = 0; i < n.bound.count; ++i) args.push_back(values.evaluate(program.idAt(n.bound, i), frame));
  values.compareArguments(id, program.rules[n.id].alternatives[0].formals, args);
  values.calls().enter(id);
  const bool top = site == CallSite::start;
  Extent e = context.pieces.isDividing() ? boundRuleInPieces(n.id, args, frame, top, context)
                                         : boundRule(n.id, args, frame, top, context);
  values.calls().leave();
  // Messages name the outermost call, that is, the call in the start rule, unless an inner call has already lost the
  // bound (Extent::attribute).
  if (site == CallSite::statement && !e.empty) e.attribute(id);
  // The author cannot change the standard library, so messages name the author's call into it.
  if (e.largest_contributor != kNoId && !top && isStandard(program, program.expr(e.largest_contributor).span.file) &&
      !isStandard(program, n.span.file)) {
    e.inside = e.largest_contributor;
    e.largest_contributor = id;
  }
  return e;
}

Extent boundAlternatives(uint32_t rule, const std::vector<RangeValue>& args, const RangeFrame& caller,
                         ReachContext& context) {
  RangeEvaluator& values = context.values;
  std::optional<Extent> out;
  bool surely_taken = false, levels = false, complete = false, weighted = false;
  std::vector<ExprId> refused;
  const std::pmr::vector<Alternative>& heads = context.program.rules[rule].alternatives;
  context.heads.addRule(rule, heads.size());
  for (const Alternative& head : heads) {
    RangeFrame frame;
    frame.scope = caller.scope;
    frame.place = frame.start = caller.place;
    frame.top = caller.top;
    frame.slots = args;
    frame.slots.resize(std::max<size_t>(head.slot_count, args.size()));
    if (head.guard == Guard::when) {
      const Interval holds = values.condition(head.when, frame);
      if (holds.hi == 0) continue;
      if (holds.lo == 1) surely_taken = true;
      refused.push_back(head.when);
      values.refine(head.when, true, frame);
    } else if (head.guard == Guard::otherwise) {
      if (surely_taken) continue;
      for (ExprId when : refused) values.refine(when, false, frame);
    }
    if (head.weight != kNoId) {
      const Interval weight = values.number(head.weight, frame);
      checkWeight(head.weight, weight, context);
      if (weight.hi <= 0 && head.guard == Guard::none) weighted = true;
      weighted = weighted || !(weight.lo > 0 && weight.bounded());
    }
    context.heads.addHead(rule, static_cast<size_t>(&head - heads.data()));
    complete = complete || head.guard != Guard::when;
    levels = levels || head.lod != kNoId;
    const double count = out ? out->count : 0;
    const Extent part = boundAlternative(rule, head, frame, context);
    addAlternative(out, part);
    // Alternatives with a `lod` clause are derived in addition to those without it, not instead of them, so the two
    // counts of shapes are added.
    if (levels) out->count = count + part.count;
  }
  if (!out) out = Extent::nothing();
  if (weighted || levels || !(complete || surely_taken)) out->certain = false;
  return *out;
}

}  // namespace sgm::reach
