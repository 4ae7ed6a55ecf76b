// Finds the levels of detail that show the content of each rule. Contents flow from callees to callers, repeatedly
// until nothing changes, since rules may call each other.

#include "grammar/check/layer_contents.h"

#include <algorithm>
#include <limits>
#include <utility>
#include <vector>

#include "grammar/range/reach_values.h"

namespace sgm {

namespace {

struct Contents {
  int32_t coarsest_cell = 0;  ///< largest cell edge, in units, of a level that shows the content; 0: no level shows it
  bool by_level = false;      ///< some shapes are visible only at some levels (as Layer::by_level)
  bool anchors = false;

  static Contents shape() { return {std::numeric_limits<int32_t>::max(), false, false}; }
  void add(const Contents& other) {
    coarsest_cell = std::max(coarsest_cell, other.coarsest_cell);
    by_level = by_level || other.by_level;
    anchors = anchors || other.anchors;
  }
  friend bool operator==(const Contents&, const Contents&) = default;
};

/// Finds the contents of each rule as a least fixed point: starts with empty contents and adds until nothing changes,
/// so that rules may call each other.
class RuleContents {
 public:
  RuleContents(const Program& program, uint32_t steps)
      : program_(program),
        steps_(steps),
        values_(program, steps_),
        of_rule_(program.rules.size()),
        ordered_(program.rules.size(), false) {
    IntervalVector anything;
    anything.fill(Interval::everything());
    values_.setCell(anything, false);
    frame_.scope = frame_.place.offset = frame_.start.offset = anything;
    frame_.place.scale = frame_.start.scale = Interval::everything();
    for (const Layer& layer : program.layers) orderFrom(layer.start);
    for (bool changed = true; changed;) {
      changed = false;
      for (const uint32_t r : order_) {
        const Contents found = ofRule(program.rules[r]);
        changed = changed || found != of_rule_[r];
        of_rule_[r] = found;
      }
    }
  }

  Contents ofCall(ExprId id) {
    if (id == kNoId) return {};
    const ExprNode& n = program_.expr(id);
    if (n.ref == Ref::rule) return of_rule_[n.id];
    if (n.ref != Ref::primitive || static_cast<Primitive>(n.id) != Primitive::ca) return Contents::shape();
    return {AutomatonLimits::coarsestCell(mostOf(program_.idAt(n.bound, 0))), true, false};
  }

 private:
  /// Appends the rule that `start` refers to, and the rules that it calls, to the order. Callees precede callers,
  /// except in cycles. Without cycles, one pass over the rules in this order finds all contents, and a second pass
  /// confirms that nothing changes.
  void orderFrom(ExprId start) {
    if (start == kNoId || program_.expr(start).ref != Ref::rule || ordered_[program_.expr(start).id]) return;
    std::vector<std::pair<uint32_t, size_t>> path{{program_.expr(start).id, 0}};
    ordered_[path[0].first] = true;
    while (!path.empty()) {
      auto& [rule, next] = path.back();
      const auto& calls = program_.rules[rule].calls;
      if (next == calls.size()) {
        order_.push_back(rule);
        path.pop_back();
      } else if (const uint32_t called = calls[next++]; !ordered_[called]) {
        ordered_[called] = true;
        path.emplace_back(called, 0);
      }
    }
  }

  Contents ofRule(const Rule& rule) {
    Contents all;
    for (const Alternative& a : rule.alternatives) {
      all.by_level = all.by_level || a.lod != kNoId;
      frame_.slots.assign(a.slot_count, RangeValue::unknown());
      all.add(ofStatement(a.body));
      all.add(ofCall(a.depth_call));
      all.add(ofCall(a.minsize_call));
    }
    for (const uint32_t o : rule.overrides) {
      frame_.slots.assign(program_.overrides[o].slot_count, RangeValue::unknown());
      all.add(ofStatement(program_.overrides[o].body));
    }
    return all;
  }

  Contents ofStatement(StmtId id) {
    if (id == kNoId) return {};
    if (steps_ == 0) return {std::numeric_limits<int32_t>::max(), true, true};
    --steps_;
    const StmtNode& s = program_.stmt(id);
    Contents all = ofStatement(s.body);
    for (uint32_t i = 0; i < s.children.count; ++i) all.add(ofStatement(program_.idAt(s.children, i)));
    switch (s.kind) {
      case StmtKind::call:
        return ofCall(s.expr);
      case StmtKind::anchor:
        return {0, false, true};
      case StmtKind::extrude:
      case StmtKind::roof:
      case StmtKind::treemap:
      case StmtKind::fit:
        all.add(Contents::shape());
        break;
      case StmtKind::detail:
        all.coarsest_cell = std::min(all.coarsest_cell, mostOf(s.expr));
        all.by_level = true;
        break;
      case StmtKind::block:
      case StmtKind::unite:
      case StmtKind::cut:
      case StmtKind::meet:
      case StmtKind::sum:
      case StmtKind::morph:
      case StmtKind::displace:
      case StmtKind::warp:
      case StmtKind::transform:
      case StmtKind::repeat:
      case StmtKind::for_each:
      case StmtKind::scatter:
      case StmtKind::let:
      case StmtKind::field:
      case StmtKind::mat:
      case StmtKind::tag:
      case StmtKind::split:
      case StmtKind::snap:
      case StmtKind::comp:
      case StmtKind::link:
      case StmtKind::footprint:
      case StmtKind::inner:
      case StmtKind::wfc:
      case StmtKind::border:
        break;
    }
    return all;
  }

  /// Returns an upper bound of the value of a length expression, in units. The result is at least 1.
  int32_t mostOf(ExprId length) {
    const double most = values_.number(length, frame_).hi * kUnitsPerMetre + 1;
    constexpr int32_t kLargest = std::numeric_limits<int32_t>::max();
    if (most < 1) return 1;
    return most < kLargest ? static_cast<int32_t>(most) : kLargest;
  }

  const Program& program_;
  uint32_t steps_;
  RangeEvaluator values_;
  RangeFrame frame_;  ///< the frame for evaluating lengths; arguments, scope, place and cell may have any value in it
  std::vector<Contents> of_rule_;
  std::vector<bool> ordered_;
  std::vector<uint32_t> order_;
};

}  // namespace

void findLayerContents(Program& program, const CompileLimits& limits) {
  RuleContents rules(program, limits.bound_steps);
  for (Layer& layer : program.layers) {
    const Contents contents = rules.ofCall(layer.start);
    layer.coarsest_cell = std::min(layer.coarsest_cell, contents.coarsest_cell);
    layer.by_level = contents.by_level;
    layer.anchors = contents.anchors;
  }
}

}  // namespace sgm
