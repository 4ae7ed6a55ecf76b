#include "derive/interpret/rule_runner.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <string>
#include <utility>

#include "derive/draws.h"
#include "derive/interpret/cell_context.h"
#include "derive/interpret/overrides.h"
#include "derive/interpret/statements.h"

namespace sgm::interpret {
namespace {

/// ordinal of the call that replaces a rule's body when a `depth` or `minsize` limit is reached
constexpr uint32_t kInsteadOrdinal = 0xFFFFFFFEu;

std::vector<Value> frameOf(const Alternative& alternative, const std::vector<Value>& arguments) {
  std::vector<Value> slots = arguments;
  slots.resize(std::max<size_t>(alternative.slot_count, arguments.size()));
  return slots;
}

}  // namespace

RuleRunner::RuleRunner(CellContext& context, RuleWatch* watch)
    : c_(context), watch_(watch), active_(context.program.rules.size()) {}

bool RuleRunner::passes(const Alternative& alternative, Env& env, std::vector<Value>& arguments) {
  if (alternative.guard != Guard::when) return true;
  // Conditions in a rule's head depend only on the arguments, so slots for local variables are not needed.
  env.slots = &arguments;
  const bool holds = c_.evaluator.evaluate(alternative.when, env).truth();
  env.slots = nullptr;
  return holds;
}

const Alternative* RuleRunner::choose(const std::vector<const Alternative*>& from, Env& env,
                                      std::vector<Value>& arguments, uint64_t draw) {
  std::vector<const Alternative*> passing;
  for (const Alternative* a : from) {
    if (a->guard != Guard::otherwise && passes(*a, env, arguments)) passing.push_back(a);
  }
  if (passing.empty()) {
    for (const Alternative* a : from) {
      if (a->guard == Guard::otherwise) passing.push_back(a);
    }
  }
  if (passing.size() < 2) return passing.empty() ? nullptr : passing[0];
  std::vector<double> weights;
  double total = 0;
  for (const Alternative* a : passing) {
    double weight = 1;
    if (a->weight != kNoId) {
      env.slots = &arguments;
      weight = c_.evaluator.real(a->weight, env);
      env.slots = nullptr;
    }
    weights.push_back(weight > 0 && std::isfinite(weight) ? weight : 0.0);
    total += weights.back();
  }
  double left = total * env.key.unit(kWeightDraw + draw);
  const Alternative* last = nullptr;
  for (size_t i = 0; i < passing.size(); ++i) {
    if (weights[i] == 0) continue;
    last = passing[i];
    left -= weights[i];
    if (left < 0) break;
  }
  return last;
}

void RuleRunner::call(uint32_t index, const ExprNode& node, uint32_t ordinal, const Env& env, ShapeList& out) {
  const Rule& rule = c_.program.rules[index];
  std::vector<Value> arguments;
  for (uint32_t i = 0; i < node.bound.count; ++i)
    arguments.push_back(c_.evaluator.evaluate(c_.evaluator.boundAt(node, i), env));
  if (c_.budget.failed()) return;
  if (!c_.budget.withinBytes(node.span, env.activation)) return;
  if (depth_ >= c_.in.limits.depth) {
    c_.budget.fail(
        "rules are nested more than " + std::to_string(c_.in.limits.depth) + " deep (give them a smaller `depth`)",
        node.span, env.activation);
    return;
  }
  Activation activation;
  activation.rule = index;
  activation.qualifier = node.qualifier;
  activation.parent = env.activation;
  activation.start = env.place;
  if (env.activation != kNone) activation.index = c_.activations.countChild(env.activation, index);
  Env inner = env;
  inner.key = env.key.child(rule.name_hash, ordinal);
  inner.activation = c_.activations.add(std::move(activation));
  inner.slots = nullptr;
  inner.cut_detail = 0;
  inner.top = env.activation == kNone;

  const bool watched = watch_ != nullptr && watch_->watches(index);
  const size_t before = out.size(), cuts_before = c_.sink.layerCuts().size();
  const size_t number = watched ? watch_->begin(inner.activation, c_.sink.anchors().size()) : 0;

  const std::vector<uint32_t> edits = c_.path_overrides.enter(inner.activation);
  if (!c_.budget.step(edits.size(), node.span, env.activation)) return;
  runUnderEdits({&rule, &arguments, nullptr, edits, edits.size(), nullptr, {}}, edits.size(), c_, inner, out);
  if (!watched) return;
  // The shapes of this call are those that were appended to `out` and to the layer's cuts since the call began.
  const ShapeList& cuts = c_.sink.layerCuts();
  watch_->end(number, std::span(out).subspan(before), std::span(cuts).subspan(cuts_before), c_.sink.anchors().size());
}

void RuleRunner::runAlternatives(const Rule& rule, Env env, std::vector<Value>& arguments, ShapeList& out) {
  // Alternatives with the same `lod` (the cell edge from which they apply) form a group. One alternative of each group
  // is derived, for that group's range of levels.
  std::vector<const Alternative*> plain;
  std::vector<std::pair<int32_t, std::vector<const Alternative*>>> coarse;
  for (const Alternative& a : rule.alternatives) {
    if (a.lod == kNoId) {
      plain.push_back(&a);
      continue;
    }
    env.slots = &arguments;
    const int32_t from = std::max(1, toUnits(c_.evaluator.real(a.lod, env)));
    env.slots = nullptr;
    auto at = std::find_if(coarse.begin(), coarse.end(), [&](const auto& entry) { return entry.first == from; });
    if (at == coarse.end()) at = coarse.insert(coarse.end(), {from, {}});
    at->second.push_back(&a);
  }
  std::sort(coarse.begin(), coarse.end(), [](const auto& l, const auto& r) { return l.first < r.first; });

  const auto run = [&](const Alternative* chosen, int32_t coarsest, int32_t detail_edge) {
    if (chosen == nullptr || c_.budget.failed() || c_.skips(detail_edge, env)) return;
    const size_t first = out.size(), first_cut = c_.sink.layerCuts().size();
    derive(rule, *chosen, env, arguments, out);
    c_.sink.limitLevels(out, first, coarsest, detail_edge);
    c_.sink.limitLevels(c_.sink.layerCuts(), first_cut, coarsest, detail_edge);
  };
  run(choose(plain, env, arguments, 0), 0, coarse.empty() ? 0 : std::max(1, coarse[0].first - 1));
  // Anchors are the same at every level, so only the first derived group of alternatives emits them.
  if (!plain.empty()) env.anchors = false;
  for (size_t i = 0; i < coarse.size(); ++i) {
    const int32_t end = i + 1 < coarse.size() ? coarse[i + 1].first - 1 : 0;
    run(choose(coarse[i].second, env, arguments, i + 1), coarse[i].first, end);
    env.anchors = false;
  }
}

void RuleRunner::derive(const Rule& rule, const Alternative& chosen, Env& env, std::vector<Value>& arguments,
                        ShapeList& out) {
  // Setting up the slots takes time in proportion to their number, so it counts as steps.
  if (!c_.budget.step(chosen.slot_count, chosen.span, env.activation)) return;
  std::vector<Value> slots = frameOf(chosen, arguments);
  Env inner = env;
  inner.slots = &slots;
  const uint32_t index = c_.activations[env.activation].rule;
  const auto count = [&] { return static_cast<double>(active_[index]); };
  const Nested deeper(depth_);
  if (chosen.depth != kNoId && count() >= c_.evaluator.real(chosen.depth, inner)) {
    runCall(chosen.depth_call, kInsteadOrdinal, c_, inner, out);
    return;
  }
  if (chosen.minsize != kNoId) {
    const Vec3 edges = inner.scope;
    const double size =
        chosen.size_slot < slots.size() ? slots[chosen.size_slot].real() : std::max({edges.x, edges.y, edges.z});
    if (size * inner.place.scale < c_.evaluator.real(chosen.minsize, inner)) {
      runCall(chosen.minsize_call, kInsteadOrdinal, c_, inner, out);
      return;
    }
  }
  const Nested active(active_[index]);
  // A morphic rule must produce exactly one shape, so if its body has several shapes, they are united into one. Other
  // rules keep all shapes of their block.
  const size_t first = out.size();
  runStatement(chosen.body, c_, inner, out);
  if (rule.morphic && out.size() > first + 1) {
    const ShapeList parts(out.begin() + static_cast<std::ptrdiff_t>(first), out.end());
    out.resize(first);
    out.push_back(c_.sink.unite(parts, c_.program.stmt(chosen.body), inner));
  }
}

}  // namespace sgm::interpret
