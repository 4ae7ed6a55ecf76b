#include <algorithm>
#include <cmath>

#include "grammar/reach/reach_check.h"
#include "grammar/text/codes.h"

namespace sgm {

namespace {

constexpr int kDeepestStatement = 400;  // statements on the call stack

}  // namespace

bool ReachCheck::tooFar() {
  cut_short_ = cut_short_ || steps_ == 0 || depth_ >= kDeepestStatement;
  return cut_short_;
}

/// The extent of a call of a rule or primitive, in the caller's scope.
Extent ReachCheck::callExtent(ExprId id, const RangeFrame& frame, Call call) {
  if (id == kNoId) return Extent::nothing();
  const ExprNode& n = program_.expr(id);
  if (call == Call::written && rules_ == 1) {
    if (only_ != kNoId && id != only_) return Extent::nothing();
    if (collects_ && std::find(top_calls_.begin(), top_calls_.end(), id) == top_calls_.end()) top_calls_.push_back(id);
  }
  if (n.ref == Ref::primitive) {
    const bool automaton_of = static_cast<Primitive>(n.id) == Primitive::ca;
    Extent e = automaton_of ? automaton(n, frame) : primitiveExtent(program_, n, values_, frame);
    e.attribute(id);
    return e;
  }
  if (n.ref != Ref::rule) return Extent::nothing();
  std::vector<RangeValue> args;
  for (uint32_t i = 0; i < n.bound.count; ++i) args.push_back(values_.evaluate(program_.idAt(n.bound, i), frame));
  values_.compareArguments(id, program_.rules[n.id].alternatives[0].formals, args);
  values_.calls().enter(id);
  Extent e = pieces_ == Pieces::none ? ruleExtent(n.id, args, frame, call == Call::start)
                                     : ruleInPieces(n.id, args, frame, call == Call::start);
  values_.calls().leave();
  // Name the outermost call: the one in the start rule.
  if (call == Call::written && !e.empty) e.attribute(id);
  // The author cannot change the library: report its caller.
  if (e.largest_contributor != kNoId && call != Call::start &&
      isStandard(program_, program_.expr(e.largest_contributor).span.file) && !isStandard(program_, n.span.file)) {
    e.inside = e.largest_contributor;
    e.largest_contributor = id;
  }
  return e;
}

Extent ReachCheck::ruleExtent(uint32_t rule, const std::vector<RangeValue>& args, const RangeFrame& caller, bool top) {
  const EditState outside = edits_;
  const std::vector<uint32_t> edits = enter(rule);
  const Extent out = remembered(rule, args, caller, top, edits);
  edits_ = outside;
  return out;
}

Extent ReachCheck::remembered(uint32_t rule, const std::vector<RangeValue>& args, const RangeFrame& caller, bool top,
                              const std::vector<uint32_t>& edits) {
  const auto note = [](Key& key, Interval i) {
    std::get<2>(key).push_back(i.lo);
    std::get<2>(key).push_back(i.hi);
  };
  Key key{rule, top, {}, {counts_.begin(), counts_.end()}, editKey(edits)};
  for (const RangeValue& arg : args) {
    for (const Interval& part : arg.v) note(key, part);
    for (const Interval& part : arg.at) note(key, part);
  }
  for (const Interval& edge : caller.scope) note(key, edge);
  Key scaled = key;
  note(scaled, caller.place.scale);
  Key placed = scaled;
  for (const Interval& part : caller.place.offset) note(placed, part);
  std::get<2>(placed).push_back(caller.place.turned ? 1 : 0);

  Dependence& asked = values_.dependence();
  if (const auto known = known_.find(key); known != known_.end()) return known->second;
  if (const auto known = scaled_.find(scaled); known != scaled_.end()) {
    asked.scale = true;
    return known->second;
  }
  if (const auto known = placed_.find(placed); known != placed_.end()) {
    asked.place = true;
    return known->second;
  }
  // A recursive call with the same ranges is unbounded. Its place makes no progress towards an end.
  if (tooFar() || !open_.insert(scaled).second) return Extent::unbounded();
  --steps_;
  const Dependence before = asked;
  asked = {};
  ++active_[rule];
  ++rules_;
  if (counted_[rule]) ++counts_[rule];
  ++depth_;
  RangeFrame frame = caller;
  frame.top = top;
  const Extent out = use({rule, args, edits, nullptr, nullptr, 0, edits_, nullptr}, edits.size(), frame, nullptr);
  --depth_;
  if (counted_[rule] && --counts_[rule] == 0) counts_.erase(rule);
  --rules_;
  --active_[rule];
  open_.erase(scaled);
  (asked.place ? placed_ : asked.scale ? scaled_ : known_)[asked.place ? placed : asked.scale ? scaled : key] = out;
  asked = {asked.place || before.place, asked.scale || before.scale};
  return out;
}

Extent ReachCheck::alternatives(uint32_t rule, const std::vector<RangeValue>& args, const RangeFrame& caller,
                                bool top) {
  Extent out = Extent::nothing();
  bool surely_taken = false, first = true, levels = false, complete = false, weighted = false;
  std::vector<ExprId> refused;
  const std::pmr::vector<Alternative>& heads = program_.rules[rule].alternatives;
  derived_[rule].resize(heads.size(), false);
  for (const Alternative& head : heads) {
    RangeFrame frame;
    frame.scope = caller.scope;
    frame.place = frame.start = caller.place;
    frame.top = top;
    frame.slots = args;
    frame.slots.resize(std::max<size_t>(head.slot_count, args.size()));
    if (head.guard == Guard::when) {
      const Interval holds = values_.condition(head.when, frame);
      if (holds.hi == 0) continue;
      if (holds.lo == 1) surely_taken = true;
      refused.push_back(head.when);
      values_.refine(head.when, true, frame);
    } else if (head.guard == Guard::otherwise) {
      if (surely_taken) continue;
      for (ExprId when : refused) values_.refine(when, false, frame);
    }
    if (head.weight != kNoId) {
      const Interval weight = values_.number(head.weight, frame);
      judgeWeight(head.weight, weight);
      if (weight.hi <= 0 && head.guard == Guard::none) weighted = true;
      weighted = weighted || !(weight.lo > 0 && weight.bounded());
    }
    derived_[rule][static_cast<size_t>(&head - heads.data())] = true;
    complete = complete || head.guard != Guard::when;
    levels = levels || head.lod != kNoId;
    const double count = out.count;
    const Extent part = alternativeExtent(rule, head, frame);
    if (first)
      out = part;
    else
      out.either(part);
    // Alternatives by level are derived independently.
    if (levels) out.count = count + part.count;
    first = false;
  }
  if (weighted || levels || !(complete || surely_taken)) out.certain = false;
  return out;
}

/// Derivation treats negative weights as 0, which is never intended.
void ReachCheck::judgeWeight(ExprId id, Interval weight) {
  if (pieces_ != Pieces::none || only_ != kNoId || weight.lo >= 0 || !weight.bounded()) return;
  const ExprId caller = values_.calls().writtenCaller(id);
  const Span& span = program_.expr(caller != kNoId ? caller : id).span;
  if (weight.hi < 0)
    sink_.error(span, codes::kValueRange, join({"a weight is 0 or more, and this is at most ", numberText(weight.hi)}),
                "write how often this head is drawn relative to the others, such as weight 2");
  else
    sink_.warning(span, codes::kValueRange, join({"this weight may be as low as ", numberText(weight.lo)}),
                  "below 0 it counts as 0: bound what it depends on, or write max(..., 0)");
}

/// Warns of heads of the root's rules that no call derives, whatever the parameters are.
void ReachCheck::idleHeads() {
  for (uint32_t r = 0; r < program_.rules.size(); ++r) {
    const Rule& rule = program_.rules[r];
    if (rule.module != 0) continue;
    for (size_t h = 0; h < derived_[r].size(); ++h) {
      if (derived_[r][h]) continue;
      const Alternative& head = rule.alternatives[h];
      const bool otherwise = head.guard == Guard::otherwise;
      sink_.warning(otherwise ? head.span : program_.expr(head.when).span, codes::kIdleHead,
                    join({"this head of `", program_.text(rule.name), "` never applies: ",
                          otherwise ? "another one's guard always holds" : "its guard never holds"}),
                    "this holds for all parameters within their ranges: correct the guard, or remove the head");
    }
  }
}

Extent ReachCheck::alternativeExtent(uint32_t rule, const Alternative& head, RangeFrame& frame) {
  Extent out = Extent::nothing();
  bool several = false;
  const auto instead = [&](ExprId call) {
    const Extent part = callExtent(call, frame, Call::instead);
    if (several)
      out.either(part);
    else
      out = part;
    several = true;
  };
  if (head.depth != kNoId) {
    const Interval most = values_.number(head.depth, frame);
    const double activations = active_[rule] - 1;
    if (activations >= most.lo) instead(head.depth_call);
    if (activations >= most.hi) return out;
  }
  if (head.minsize != kNoId) {
    // Use final sizes, however the scope is scaled.
    values_.dependence().scale = true;
    const Interval scale = frame.place.scale, least = values_.number(head.minsize, frame);
    Interval size{};
    for (const Interval& edge : frame.scope) size = maximum(size, edge);
    if (head.size_slot != kNoId) size = frame.slots[head.size_slot].v[0];
    if ((size * scale).lo < least.hi) instead(head.minsize_call);
    if ((size * scale).hi < least.lo) return out;
    if (head.size_slot != kNoId && scale.lo > 0) {
      Interval& slot = frame.slots[head.size_slot].v[0];
      slot.lo = std::min(std::max(slot.lo, least.lo / (least.lo > 0 ? scale.hi : scale.lo) * (1 - 1e-12)), slot.hi);
    }
  }
  const Extent own = statement(head.body, frame);
  if (!several) return own;
  out.either(own);
  return out;
}

}  // namespace sgm
