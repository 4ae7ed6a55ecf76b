// Choice among a rule's alternatives, and calls.

#include <algorithm>
#include <cmath>

#include "derive/draws.h"
#include "derive/interpret/interpreter.h"

namespace sgm {
namespace {

constexpr uint32_t kInsteadOrdinal = 0xFFFFFFFEu;  ///< of the call that `depth` or `minsize` makes

std::vector<Value> frameOf(const Alternative& alternative, const std::vector<Value>& arguments) {
  std::vector<Value> slots = arguments;
  slots.resize(std::max<size_t>(alternative.slot_count, arguments.size()));
  return slots;
}

}  // namespace

void Interpreter::call(ExprId id, uint32_t ordinal, const Env& env, ShapeList& out) {
  if (failed() || id == kNoId) return;
  const ExprNode& node = program_.expr(id);
  if (!step(1, node.span, env.activation)) return;
  if (node.ref == Ref::rule) {
    callRule(node.id, node, ordinal, env, out);
  } else if (node.ref == Ref::primitive) {
    primitive(static_cast<Primitive>(node.id), node, ordinal, env, out);
  }
}

bool Interpreter::passes(const Alternative& alternative, Env& env, std::vector<Value>& arguments) {
  if (alternative.guard != Guard::when) return true;
  // Conditions in a head depend only on the arguments: no frame is created for them.
  env.slots = &arguments;
  const bool holds = evaluate(alternative.when, env).truth();
  env.slots = nullptr;
  return holds;
}

const Alternative* Interpreter::choose(const std::vector<const Alternative*>& from, Env& env,
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
      weight = real(a->weight, env);
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

void Interpreter::callRule(uint32_t index, const ExprNode& node, uint32_t ordinal, const Env& env, ShapeList& out) {
  const Rule& rule = program_.rules[index];
  std::vector<Value> arguments;
  for (uint32_t i = 0; i < node.bound.count; ++i) arguments.push_back(evaluate(boundAt(node, i), env));
  if (failed()) return;
  if (!withinBytes(node.span, env.activation)) return;
  if (depth_ >= limits_.depth) {
    fail("rules are nested more than " + std::to_string(limits_.depth) + " deep (give them a smaller `depth`)",
         node.span, env.activation);
    return;
  }
  Activation activation;
  activation.rule = index;
  activation.qualifier = node.qualifier;
  activation.parent = env.activation;
  activation.start = env.place;
  if (env.activation != kNone) {
    std::vector<uint32_t>& counts = activations_[env.activation].child_counts;
    size_t at = 0;
    while (at < counts.size() && counts[at] != index) at += 2;
    if (at == counts.size()) counts.insert(counts.end(), {index, 0});
    activation.index = counts[at + 1]++;
  }
  Env inner = env;
  inner.key = env.key.child(rule.name_hash, ordinal);
  inner.activation = static_cast<uint32_t>(activations_.size());
  inner.slots = nullptr;
  inner.cut_detail = 0;
  inner.top = env.activation == kNone;
  activations_.push_back(std::move(activation));

  const size_t before = out.size(), cuts_before = layer_cuts_.size(), anchors_before = anchors_.size();
  const size_t watched = watched_.size();
  if (index == watched_rule_) watched_.push_back({inner.activation, {}, {}, anchors_before, anchors_before});

  const std::vector<uint32_t> edits = enterPaths(inner.activation);
  if (!step(edits.size(), node.span, env.activation)) return;
  use({&rule, &arguments, nullptr, edits, edits.size(), nullptr, {}}, edits.size(), inner, out);
  if (index != watched_rule_) return;
  // A rule's block appends to the shapes before its call and does not change them.
  WatchedCall& call = watched_[watched];
  call.shapes.assign(out.begin() + static_cast<std::ptrdiff_t>(before), out.end());
  call.layer_cuts.assign(layer_cuts_.begin() + static_cast<std::ptrdiff_t>(cuts_before), layer_cuts_.end());
  call.end_anchor = anchors_.size();
}

void Interpreter::alternatives(const Rule& rule, Env env, std::vector<Value>& arguments, ShapeList& out) {
  // Alternatives with `lod` coexist with those without; each set is for its own range of levels.
  std::vector<const Alternative*> plain;
  std::vector<std::pair<int32_t, std::vector<const Alternative*>>> coarse;
  for (const Alternative& a : rule.alternatives) {
    if (a.lod == kNoId) {
      plain.push_back(&a);
      continue;
    }
    env.slots = &arguments;
    const int32_t from = std::max(1, toUnits(real(a.lod, env)));
    env.slots = nullptr;
    auto at = std::find_if(coarse.begin(), coarse.end(), [&](const auto& entry) { return entry.first == from; });
    if (at == coarse.end()) at = coarse.insert(coarse.end(), {from, {}});
    at->second.push_back(&a);
  }
  std::sort(coarse.begin(), coarse.end(), [](const auto& l, const auto& r) { return l.first < r.first; });

  const auto run = [&](const Alternative* chosen, int32_t coarsest, int32_t detail_edge) {
    if (chosen == nullptr || failed() || skips(detail_edge, env)) return;
    const size_t first = out.size(), first_cut = layer_cuts_.size();
    derive(rule, *chosen, env, arguments, out);
    limitLevels(out, first, coarsest, detail_edge);
    limitLevels(layer_cuts_, first_cut, coarsest, detail_edge);
  };
  run(choose(plain, env, arguments, 0), 0, coarse.empty() ? 0 : std::max(1, coarse[0].first - 1));
  // Gameplay points are the same at every level: only one set may emit them.
  if (!plain.empty()) env.anchors = false;
  for (size_t i = 0; i < coarse.size(); ++i) {
    const int32_t end = i + 1 < coarse.size() ? coarse[i + 1].first - 1 : 0;
    run(choose(coarse[i].second, env, arguments, i + 1), coarse[i].first, end);
    env.anchors = false;
  }
}

void Interpreter::derive(const Rule& rule, const Alternative& chosen, Env& env, std::vector<Value>& arguments,
                         ShapeList& out) {
  // The cost of a frame with many slots is that of filling it.
  if (!step(chosen.slot_count, chosen.span, env.activation)) return;
  std::vector<Value> slots = frameOf(chosen, arguments);
  Env inner = env;
  inner.slots = &slots;
  const uint32_t index = activations_[env.activation].rule;
  const auto count = [&] { return static_cast<double>(active_[index]); };
  const Nested deeper(depth_);
  if (chosen.depth != kNoId && count() >= real(chosen.depth, inner)) {
    call(chosen.depth_call, kInsteadOrdinal, inner, out);
    return;
  }
  if (chosen.minsize != kNoId) {
    const Vec3 edges = inner.scope;
    const double size =
        chosen.size_slot < slots.size() ? slots[chosen.size_slot].real() : std::max({edges.x, edges.y, edges.z});
    if (size * inner.place.scale < real(chosen.minsize, inner)) {
      call(chosen.minsize_call, kInsteadOrdinal, inner, out);
      return;
    }
  }
  const Nested active(active_[index]);
  // A morphic rule must produce one node; others produce all shapes of their block.
  const size_t first = out.size();
  statement(chosen.body, inner, out);
  if (rule.morphic && out.size() > first + 1) {
    const ShapeList parts(out.begin() + static_cast<std::ptrdiff_t>(first), out.end());
    out.resize(first);
    out.push_back(united(parts, program_.stmt(chosen.body), inner));
  }
}

}  // namespace sgm
