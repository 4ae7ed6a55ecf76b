// The proof of reach: an abstract interpretation of each layer's rules over intervals. Rules are evaluated once for
// each tuple of argument ranges and remembered, so that recursion costs its depth and not its leaves.

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>
#include <vector>

#include "grammar/check.h"
#include "grammar/codes.h"
#include "grammar/reach_shapes.h"

namespace sgm {

namespace {

constexpr int kDeepest = 400;       // statements on the stack
constexpr double kSumGrowth = 0.6;  // a kernel of support 1.6 inner radii ends that far outside of its leaf
constexpr double kUnit = 1.0 / kUnitsPerMetre;

class ReachCheck {
 public:
  ReachCheck(Program& program, const CompileLimits& limits, DiagnosticSink& sink)
      : program_(program), limits_(limits), sink_(sink), values_(program, steps_), active_(program.rules.size(), 0) {
    for (uint32_t r = 0; r < program.rules.size(); ++r)
      for (const Alternative& a : program.rules[r].alternatives)
        if (a.depth != kNoId) {
          counted_.push_back(r);
          break;
        }
  }

  void run() {
    for (Layer& layer : program_.layers) layerReach(layer);
  }

 private:
  using Key = std::tuple<uint32_t, std::vector<double>, std::vector<uint32_t>>;

  void layerReach(Layer& layer) {
    const bool finite = !program_.domain.infinite && layer.cell_expr == kNoId;
    const bool boxed = !program_.domain.box.empty();
    IntervalVector edges;
    for (int axis = 0; axis < 3; ++axis) edges[static_cast<size_t>(axis)] = Interval::exactly(layer.cell[axis] * kUnit);
    if (finite && !boxed) edges.fill({0, 4096});  // unknown until the shapes are bounded
    values_.setCell(edges);
    cell_ = edges;
    known_.clear();
    steps_ = limits_.bound_steps;
    cut_short_ = false;
    RangeFrame frame;
    frame.scope = edges;
    const Extent extent = callExtent(layer.start, frame, true);
    if (sink_.full()) return;
    const bool exhausted = cut_short_;

    IntVector bound_lo{}, bound_hi{};
    double over_may = 0, over_sure = 0;
    for (int axis = 0; axis < 3; ++axis) {
      const size_t i = static_cast<size_t>(axis);
      if (!program_.domain.axes[i] && program_.domain.infinite) continue;
      double low = -layer.reach * kUnit, high = layer.cell[axis] * kUnit + layer.reach * kUnit;
      if (finite) low = program_.domain.box.lo[axis] * kUnit, high = program_.domain.box.hi[axis] * kUnit;
      if (extent.empty) continue;
      over_may = std::max({over_may, low - extent.may[i].lo, extent.may[i].hi - high});
      over_sure = std::max({over_sure, low - extent.sure_lo[i], extent.sure_hi[i] - high});
    }
    for (size_t i = 0; i < 3; ++i) {
      auto units = [](double metres) {
        return saturate(static_cast<int64_t>(std::clamp(metres * kUnitsPerMetre, -3e9, 3e9)));
      };
      bound_lo[i] = extent.empty ? 1 : units(std::floor(extent.may[i].lo * kUnitsPerMetre) * kUnit);
      bound_hi[i] = extent.empty ? 0 : units(std::ceil(extent.may[i].hi * kUnitsPerMetre) * kUnit);
    }
    layer.bound = {{bound_lo[0], bound_lo[1], bound_lo[2]}, {bound_hi[0], bound_hi[1], bound_hi[2]}};
    if (finite && !boxed) return finiteBox(layer, extent, exhausted);
    layer.proven = over_may <= 0;
    if (layer.proven) return;
    report(layer, extent, finite, over_may, over_sure, exhausted);
  }

  std::string nameOf(ExprId culprit) const {
    const std::string_view name = program_.text(program_.expr(culprit).name);
    return name.empty() ? "what this displaces" : join({"`", name, "`"});
  }

  void report(const Layer& layer, const Extent& extent, bool finite, double over_may, double over_sure,
              bool exhausted) {
    const ExprId culprit = extent.culprit == kNoId ? layer.start : extent.culprit;
    const std::string shape = nameOf(culprit);
    const std::string name = join({"`", program_.text(layer.name), "`"});
    const double reach = layer.reach * kUnit;
    const bool unbounded = !std::isfinite(over_may);
    // A finite grammar's declared box is its reach; a layer's is measured from its cell.
    const std::string extends = unbounded ? "without bound" : metresText(over_may + (finite ? 0 : reach));
    const std::string from = finite ? " beyond the domain's box" : " from its cell";
    const std::string limit = finite ? "" : join({", layer ", name, " declares reach ", metresText(reach)});
    const Span& span = program_.expr(culprit).span;
    if (unbounded || over_sure > 0) {
      Diagnostic& d = sink_.error(
          span, codes::kReach, join({"cannot prove reach: ", shape, " may extend ", extends, from, limit}),
          unbounded ? "bound what it depends on: a parameter's range, clamp(), or `amp` of displace and warp"
          : finite  ? "make the box larger or the shape smaller"
                    : join({"raise reach to ", metresText(std::ceil(over_may + reach)), " or make the shape smaller"}));
      if (exhausted) d.notes.push_back("the rules are too many to follow all of them; bound their recursion");
      return;
    }
    sink_.warning(span, codes::kReachMaybe, join({shape, " may extend ", extends, from, limit}),
                  "shapes that go farther are left out whole");
  }

  void finiteBox(Layer& layer, const Extent& extent, bool exhausted) {
    IntBox box;
    double largest = 0;
    for (const Interval& side : extent.may) largest = std::max(largest, side.magnitude());
    if (!extent.empty && (!std::isfinite(largest) || largest > 1e6 || exhausted)) {
      const ExprId culprit = extent.culprit == kNoId ? layer.start : extent.culprit;
      sink_.error(program_.expr(culprit).span, codes::kReach,
                  join({"cannot prove reach: ", nameOf(culprit), " may extend without bound"}),
                  exhausted ? "the rules are too many or too deep to follow; bound their recursion"
                            : "give the domain a box: `domain finite box(x, y, z);`");
      return;
    }
    for (int axis = 0; axis < 3; ++axis) {
      const Interval side = extent.empty ? Interval{-1, 1} : extent.may[static_cast<size_t>(axis)];
      // The box is centred, as a written one is.
      const double half = std::max(std::fabs(side.lo), std::fabs(side.hi)) + 1;
      box.hi[axis] = static_cast<int32_t>(std::ceil(half * kUnitsPerMetre));
      box.lo[axis] = -box.hi[axis];
      layer.cell[axis] = 2 * box.hi[axis];
    }
    program_.domain.box = box;
    layer.proven = true;
  }

  /// The extent of a call of a rule or primitive, in the caller's scope.
  Extent callExtent(ExprId id, const RangeFrame& frame, bool start) {
    if (id == kNoId) return Extent::nothing();
    const ExprNode& n = program_.expr(id);
    if (n.ref == Ref::primitive) {
      Extent e = primitiveExtent(program_, n, values_, frame);
      e.blame(id);
      return e;
    }
    if (n.ref != Ref::rule) return Extent::nothing();
    std::vector<RangeValue> args;
    for (uint32_t i = 0; i < n.bound.count; ++i) args.push_back(values_.evaluate(program_.idAt(n.bound, i), frame));
    Extent e = ruleExtent(n.id, args, frame.scope);
    // The outermost call is the one to name: what stands in the start rule.
    if (!start && !e.empty) e.blame(id);
    return e;
  }

  bool tooFar() {
    cut_short_ = cut_short_ || steps_ == 0 || depth_ >= kDeepest;
    return cut_short_;
  }

  Extent ruleExtent(uint32_t rule, const std::vector<RangeValue>& args, const IntervalVector& scope) {
    Key key{rule, {}, {}};
    auto note = [&](const IntervalVector& v) {
      for (const Interval& i : v) {
        std::get<1>(key).push_back(i.lo);
        std::get<1>(key).push_back(i.hi);
      }
    };
    for (const RangeValue& arg : args) note(arg.v);
    note(scope);
    for (uint32_t r : counted_) std::get<2>(key).push_back(active_[r]);
    const auto known = known_.find(key);
    if (known != known_.end()) return known->second;
    if (tooFar()) return Extent::unbounded();
    --steps_;
    // A call of the same rule with the same ranges inside itself is without bound; the answer stands if it is asked.
    known_.emplace(key, Extent::unbounded());
    ++active_[rule];
    ++depth_;
    Extent out = Extent::nothing();
    bool surely_taken = false;
    std::vector<ExprId> refused;
    for (const Alternative& head : program_.rules[rule].alternatives) {
      RangeFrame frame;
      frame.scope = scope;
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
      out.join(alternativeExtent(rule, head, frame));
    }
    --depth_;
    --active_[rule];
    known_[key] = out;
    return out;
  }

  Extent alternativeExtent(uint32_t rule, const Alternative& head, RangeFrame& frame) {
    Extent out = Extent::nothing();
    if (head.depth != kNoId) {
      const Interval most = values_.number(head.depth, frame);
      const double activations = active_[rule] - 1;
      if (activations >= most.lo) out.join(callExtent(head.depth_call, frame, true));
      if (activations >= most.hi) return out;
    }
    if (head.minsize != kNoId) {
      const Interval least = values_.number(head.minsize, frame);
      Interval size{};
      for (const Interval& edge : frame.scope) size = maximum(size, edge);
      if (head.size_slot != kNoId) size = frame.slots[head.size_slot].v[0];
      if (size.lo < least.hi) out.join(callExtent(head.minsize_call, frame, true));
      if (size.hi < least.lo) return out;
      if (head.size_slot != kNoId) {
        Interval& slot = frame.slots[head.size_slot].v[0];
        slot.lo = std::min(std::max(slot.lo, least.lo), slot.hi);
      }
    }
    out.join(statement(head.body, frame));
    return out;
  }

  Extent body(StmtId id, RangeFrame& frame) {
    const IntervalVector scope = frame.scope;
    Extent e = statement(id, frame);
    frame.scope = scope;
    return e;
  }

  Extent statement(StmtId id, RangeFrame& frame) {
    if (id == kNoId) return Extent::nothing();
    if (tooFar()) return Extent::unbounded();
    --steps_;
    ++depth_;
    Extent e = statementKinds(program_.stmt(id), frame);
    --depth_;
    return e;
  }

  Extent statementKinds(const StmtNode& s, RangeFrame& frame) {
    switch (s.kind) {
      case StmtKind::block: {
        Extent out = Extent::nothing();
        for (uint32_t i = 0; i < s.children.count; ++i) {
          const StmtNode& child = program_.stmt(program_.idAt(s.children, i));
          Extent part = statement(program_.idAt(s.children, i), frame);
          if (child.kind == StmtKind::cut && !child.layer_level) {
            // What a nested cut takes away adds nothing, and leaves what stood before it uncertain.
            if (!part.empty) out.uncertain();
            continue;
          }
          out.join(part);
        }
        return out;
      }
      case StmtKind::call:
        return callExtent(s.expr, frame, false);
      case StmtKind::unite:
      case StmtKind::cut: {
        Extent e = body(s.body, frame);
        if (s.amount != kNoId) e.grow(std::max(0.0, values_.number(s.amount, frame).hi));
        return e;
      }
      case StmtKind::meet:
        return meet(s, frame);
      case StmtKind::sum: {
        Extent e = body(s.body, frame);
        e.grow(kSumGrowth * e.inner);
        return e;
      }
      case StmtKind::morph:
        return morph(s, frame);
      case StmtKind::displace:
      case StmtKind::warp: {
        double amplitude = 0;
        if (s.amount != kNoId) {
          amplitude = values_.number(s.amount, frame).magnitude();
        } else if (s.kind == StmtKind::displace) {
          amplitude = values_.number(s.expr, frame).magnitude();
        } else {
          for (const Interval& part : values_.vector(s.expr, frame)) amplitude = std::max(amplitude, part.magnitude());
        }
        Extent e = body(s.body, frame);
        e.grow(amplitude);
        e.shrinkSure(amplitude);
        if (!std::isfinite(amplitude) && !e.empty) {
          e.culprit = s.expr;
          e.culprit_size = amplitude;
        }
        return e;
      }
      case StmtKind::transform:
        return transformed(s.xforms, s.body, frame);
      case StmtKind::repeat:
        return repeated(s, frame);
      case StmtKind::for_each: {
        const ExprNode& source = program_.expr(s.expr);
        RangeValue variable = RangeValue::unknown();
        if (source.kind == ExprKind::range) {
          const Interval low = values_.number(program_.idAt(source.children, 0), frame);
          const Interval high = values_.number(program_.idAt(source.children, 1), frame);
          if (low.lo > high.hi - 1) return Extent::nothing();
          variable = RangeValue::number({low.lo, std::max(low.lo, high.hi - 1)});
        } else {
          variable = values_.evaluate(s.expr, frame);
          variable.kind = ValueKind::face;
        }
        frame.slots[s.slot] = variable;
        return body(s.body, frame);
      }
      case StmtKind::scatter:
        return scattered(s, frame);
      case StmtKind::let:
        frame.slots[s.slot] = values_.evaluate(s.expr, frame);
        return Extent::nothing();
      case StmtKind::detail:
        return body(s.body, frame);
      case StmtKind::field:
      case StmtKind::mat:
      case StmtKind::tag:
      case StmtKind::anchor:
        return Extent::nothing();
    }
    return Extent::unbounded();
  }

  Extent meet(const StmtNode& s, RangeFrame& frame) {
    const StmtNode& inner = program_.stmt(s.body);
    if (inner.kind != StmtKind::block) return body(s.body, frame);
    Extent out = Extent::nothing();
    bool first = true;
    for (uint32_t i = 0; i < inner.children.count; ++i) {
      const StmtNode& child = program_.stmt(program_.idAt(inner.children, i));
      Extent part = statement(program_.idAt(inner.children, i), frame);
      const bool shape = child.kind != StmtKind::let && child.kind != StmtKind::field && child.kind != StmtKind::mat &&
                         child.kind != StmtKind::tag && child.kind != StmtKind::anchor && child.kind != StmtKind::cut;
      if (!shape) continue;
      if (first)
        out = part;
      else
        out.intersect(part);
      first = false;
    }
    return out;
  }

  Extent morph(const StmtNode& s, RangeFrame& frame) {
    Extent a = statement(program_.idAt(s.children, 0), frame);
    const Extent b = statement(program_.idAt(s.children, 1), frame);
    bool apart = false;
    for (size_t i = 0; i < 3 && !a.empty && !b.empty; ++i)
      apart = apart || a.may[i].hi < b.may[i].lo || b.may[i].hi < a.may[i].lo;
    if (apart)
      sink_.warning(s.span, codes::kMorphDisjoint, "the two shapes of this morph lie apart, and may vanish half way",
                    "let them overlap");
    // A blend holds what both hold: only that is certain.
    std::array<double, 3> lo = a.sure_lo, hi = a.sure_hi;
    for (size_t i = 0; i < 3; ++i) {
      lo[i] = std::max(lo[i], b.sure_lo[i]);
      hi[i] = std::min(hi[i], b.sure_hi[i]);
    }
    a.join(b);
    a.sure_lo = lo;
    a.sure_hi = hi;
    return a;
  }

  IntervalVector pointOf(const XformNode& x, const RangeFrame& frame) {
    const RangeValue first = values_.evaluate(x.a, frame);
    if (first.kind == ValueKind::vector) return first.v;
    auto part = [&](ExprId id) { return id == kNoId ? Interval{} : values_.number(id, frame); };
    return {part(x.a), part(x.b), part(x.c)};
  }

  void apply(const XformNode& x, const RangeFrame& frame, Extent& e) {
    switch (x.kind) {
      case XformKind::at:
        return e.move(pointOf(x, frame));
      case XformKind::rot:
        return e.rotate(x.axis, values_.number(x.b, frame));
      case XformKind::scale:
        return e.scale(values_.number(x.a, frame));
      case XformKind::size:
        return;
      case XformKind::mirror:
        return e.mirror(x.axis);
    }
  }

  Extent transformed(IdRange xforms, StmtId inner, RangeFrame& frame) {
    const IntervalVector scope = frame.scope;
    for (uint32_t i = 0; i < xforms.count; ++i) {
      const XformNode& x = program_.ast.xforms[xforms.first + i];
      if (x.kind != XformKind::size) continue;
      const RangeValue first = values_.evaluate(x.a, frame);
      const ExprId parts[3] = {x.a, x.b, x.c};
      for (size_t axis = 0; axis < 3; ++axis)
        if (first.kind == ValueKind::vector)
          frame.scope[axis] = first.v[axis];
        else if (parts[axis] != kNoId)
          frame.scope[axis] = values_.number(parts[axis], frame);
    }
    Extent e = statement(inner, frame);
    frame.scope = scope;
    // The last transform written is the innermost.
    for (uint32_t i = xforms.count; i > 0; --i) apply(program_.ast.xforms[xforms.first + i - 1], frame, e);
    return e;
  }

  Extent repeated(const StmtNode& s, RangeFrame& frame) {
    const Interval count = values_.number(s.expr, frame);
    if (count.hi < 1) return Extent::nothing();
    const Interval times{0, std::max(0.0, std::floor(count.hi) - 1)};
    Extent once = body(s.body, frame);
    if (times.hi == 0) return once;
    bool turns = false, scales = false, moves = false;
    for (uint32_t i = 0; i < s.xforms.count; ++i) {
      const XformKind kind = program_.ast.xforms[s.xforms.first + i].kind;
      turns = turns || kind == XformKind::rot || kind == XformKind::mirror;
      scales = scales || kind == XformKind::scale;
      moves = moves || kind == XformKind::at;
    }
    for (uint32_t i = s.xforms.count; i > 0; --i) {
      const XformNode& x = program_.ast.xforms[s.xforms.first + i - 1];
      switch (x.kind) {
        case XformKind::at: {
          IntervalVector by = pointOf(x, frame);
          if (turns || scales) {
            // The steps turn and grow with the copies: each is a step of at most this length in any direction.
            double length = 0;
            for (const Interval& part : by) length += part.magnitude() * part.magnitude();
            by.fill({-std::sqrt(length), std::sqrt(length)});
          }
          for (Interval& part : by) part = part * times;
          once.move(by);
          break;
        }
        case XformKind::rot:
          once.rotate(moves ? 3 : x.axis, values_.number(x.b, frame) * times);
          break;
        case XformKind::scale: {
          const Interval factor = values_.number(x.a, frame);
          if (factor.magnitude() > 1)
            once = Extent::unbounded();
          else
            once.scale(hull(factor, {0, 1}));
          break;
        }
        case XformKind::mirror: {
          Extent other = once;
          other.mirror(x.axis);
          once.join(other);
          break;
        }
        case XformKind::size:
          break;
      }
    }
    return once;
  }

  Extent scattered(const StmtNode& s, RangeFrame& frame) {
    const ScatterNode& scatter = program_.ast.scatters[s.extra];
    Extent e = body(s.body, frame);
    IntervalVector at{};
    auto edge = [&](ExprId id) {
      const double half = std::max(0.0, values_.number(id, frame).hi) / 2;
      return Interval{-half, half};
    };
    switch (scatter.area) {
      case ScatterArea::cell:
        for (size_t i = 0; i < 3; ++i) at[i] = {0, cell_[i].hi};
        break;
      case ScatterArea::shell: {
        const Interval r = values_.number(scatter.a, frame);
        at.fill({-r.magnitude(), r.magnitude()});
        if (scatter.b != kNoId) {
          // The upper share of a sphere by height.
          const Interval share = values_.number(scatter.b, frame);
          at[1].lo = std::clamp(1 - 2 * share.hi, -1.0, 1.0) * (share.hi > 0.5 ? r.hi : r.lo);
        }
        break;
      }
      case ScatterArea::disc: {
        const Interval r = values_.number(scatter.a, frame);
        at[0] = at[2] = {-r.magnitude(), r.magnitude()};
        break;
      }
      case ScatterArea::box: {
        const RangeValue first = values_.evaluate(scatter.a, frame);
        if (first.kind == ValueKind::vector)
          for (size_t i = 0; i < 3; ++i) at[i] = {-std::max(0.0, first.v[i].hi) / 2, std::max(0.0, first.v[i].hi) / 2};
        else
          at = {edge(scatter.a), edge(scatter.b), edge(scatter.c)};
        break;
      }
    }
    if (scatter.probe != 0) {
      const double far = values_.number(scatter.distance, frame).magnitude();
      at[1] = scatter.probe > 0 ? at[1] + Interval{0, far} : at[1] + Interval{-far, 0};
    }
    e.move(at);
    return e;
  }

  using IntVector = std::array<int32_t, 3>;

  Program& program_;
  const CompileLimits& limits_;
  DiagnosticSink& sink_;
  uint32_t steps_ = 0;
  RangeEvaluator values_;
  IntervalVector cell_{};
  std::map<Key, Extent> known_;
  std::vector<uint32_t> active_;   ///< activations of each rule on the path
  std::vector<uint32_t> counted_;  ///< rules whose activations matter
  int depth_ = 0;
  bool cut_short_ = false;  ///< the budget or the depth was not enough: nothing is proven
};

}  // namespace

void checkReach(Program& program, const CompileLimits& limits, DiagnosticSink& sink) {
  ReachCheck(program, limits, sink).run();
}

}  // namespace sgm
