#include "grammar/check/recursion.h"

#include <algorithm>

#include "base/math.h"
#include "grammar/range/extent.h"
#include "grammar/range/reach_values.h"
#include "grammar/text/codes.h"

namespace sgm {

namespace {

/// Finds recursive rules for which no bound can be proven. To this end it finds the calls that certainly make progress
/// towards an end of the recursion.
class RecursionCheck {
 public:
  RecursionCheck(const Program& program, const std::vector<RuleCall>& calls, uint32_t steps, DiagnosticSink& sink)
      : program_(program),
        calls_(calls),
        sink_(sink),
        out_(program.rules.size()),
        component_(program.rules.size(), 0),
        steps_(steps),
        values_(program, steps_) {}

  void run(Program& marked) {
    for (uint32_t c = 0; c < calls_.size(); ++c) out_[calls_[c].from].push_back(c);
    components();
    for (const RuleCall& call : calls_)
      marked.ast.exprs[call.call].circular = component_[call.from] == component_[call.to];
    // Every cycle of calls must contain a call that certainly makes progress towards an end.
    std::vector<uint8_t> mark(program_.rules.size(), 0);
    for (uint32_t root = 0; root < program_.rules.size(); ++root) {
      if (mark[root] != 0) continue;
      std::vector<std::pair<uint32_t, size_t>> stack{{root, 0}};
      mark[root] = 1;
      while (!stack.empty()) {
        auto& [rule, next] = stack.back();
        if (next == out_[rule].size()) {
          mark[rule] = 2;
          stack.pop_back();
          continue;
        }
        const RuleCall& call = calls_[out_[rule][next++]];
        if (component_[call.from] != component_[call.to] || ends(call)) continue;
        if (mark[call.to] == 1) {
          report(call);
        } else if (mark[call.to] == 0) {
          mark[call.to] = 1;
          stack.emplace_back(call.to, 0);
        }
      }
    }
  }

 private:
  /// Finds the strongly connected components of the calls by Tarjan's algorithm, without recursion.
  void components() {
    const size_t count = program_.rules.size();
    std::vector<uint32_t> index(count, kNoId), low(count, 0), path;
    std::vector<bool> on_path(count, false);
    uint32_t next_index = 0, next_component = 0;
    for (uint32_t root = 0; root < count; ++root) {
      if (index[root] != kNoId) continue;
      std::vector<std::pair<uint32_t, size_t>> stack{{root, 0}};
      while (!stack.empty()) {
        const uint32_t rule = stack.back().first;
        if (stack.back().second == 0) {
          index[rule] = low[rule] = next_index++;
          path.push_back(rule);
          on_path[rule] = true;
        }
        bool descended = false;
        while (stack.back().second < out_[rule].size()) {
          const uint32_t to = calls_[out_[rule][stack.back().second++]].to;
          if (index[to] == kNoId) {
            stack.emplace_back(to, 0);
            descended = true;
            break;
          }
          if (on_path[to]) low[rule] = std::min(low[rule], index[to]);
        }
        if (descended) continue;
        if (low[rule] == index[rule]) {
          for (;;) {
            const uint32_t member = path.back();
            path.pop_back();
            on_path[member] = false;
            component_[member] = next_component;
            if (member == rule) break;
          }
          ++next_component;
        }
        stack.pop_back();
        if (!stack.empty()) low[stack.back().first] = std::min(low[stack.back().first], low[rule]);
      }
    }
  }

  RangeFrame freeFrame(const Alternative& head) const {
    RangeFrame frame;
    frame.slots.resize(head.slot_count);
    return frame;
  }

  /// Returns an upper bound of the factor by which the `scale` transforms around a call enlarge its scope.
  double enlarged(const RuleCall& call, const RangeFrame& frame) {
    double most = 1;
    for (const ScaleAround& scale : call.scales) {
      const double factor = scaleFactor(values_.number(scale.factor, frame)).hi;
      // In a repeat, the scale applies i times to copy i: the first copy is not scaled, and the last one is enlarged
      // without bound if the factor exceeds 1.
      most *= !scale.copied ? factor : factor <= 1 ? 1 : kInfinity;
    }
    return most;
  }

  /// Whether an argument is certainly smaller than the formal in `slot`, here called a. Understands the forms a with
  /// larger <= 0.999, a * f and f * a with abs(f) * larger <= 0.999, a / f with larger / f <= 0.999, and a - f with
  /// f > 0.001 and larger <= 1. larger: upper bound of the factor by which the scales around the call enlarge the
  /// argument.
  bool shrinks(ExprId id, uint32_t slot, const Alternative& head, double larger = 1) {
    const ExprNode& n = program_.expr(id);
    constexpr double kSurely = 0.999;
    if (n.ref == Ref::local && n.id == slot) return larger <= kSurely;
    if (n.kind != ExprKind::binary) return false;
    const ExprId left = program_.idAt(n.children, 0), right = program_.idAt(n.children, 1);
    auto isSlot = [&](ExprId e) { return program_.expr(e).ref == Ref::local && program_.expr(e).id == slot; };
    const RangeFrame frame = freeFrame(head);
    if (n.binary == BinaryOp::multiply && (isSlot(left) || isSlot(right)))
      return values_.number(isSlot(left) ? right : left, frame).magnitude() * larger <= kSurely;
    if (n.binary == BinaryOp::divide && isSlot(left)) return values_.number(right, frame).lo >= larger / kSurely;
    return n.binary == BinaryOp::subtract && isSlot(left) && larger <= 1 && values_.number(right, frame).lo > 1e-3;
  }

  /// Whether the condition requires that the value in `slot` exceeds a bound that is finite for all values of the other
  /// names. positive: set to whether the bound is certainly above 0.
  bool bounds(ExprId id, uint32_t slot, bool& positive, const Alternative& head) {
    const ExprNode& n = program_.expr(id);
    if (n.kind != ExprKind::binary) return false;
    const ExprId left = program_.idAt(n.children, 0), right = program_.idAt(n.children, 1);
    if (n.binary == BinaryOp::logical_and)
      return bounds(left, slot, positive, head) || bounds(right, slot, positive, head);
    const bool greater = n.binary == BinaryOp::greater || n.binary == BinaryOp::greater_equal;
    const bool less = n.binary == BinaryOp::less || n.binary == BinaryOp::less_equal;
    if (!greater && !less) return false;
    const ExprNode& local = program_.expr(greater ? left : right);
    if (local.ref != Ref::local || local.id != slot) return false;
    const Interval bound = values_.number(greater ? right : left, freeFrame(head));
    if (!bound.bounded()) return false;
    positive = bound.lo > 0;
    return true;
  }

  bool ends(const RuleCall& call) {
    if (call.escape) return false;
    const Alternative& head = program_.rules[call.from].alternatives[call.alternative];
    if (head.depth != kNoId) return true;
    if (call.from != call.to) return false;
    const ExprNode& n = program_.expr(call.call);
    if (head.minsize != kNoId) {
      // minsize is compared with the final size, which includes all scales around the call.
      const double larger = enlarged(call, freeFrame(head));
      if (head.size_slot == kNoId && (larger < 0.999 || (call.shrunk && larger <= 1))) return true;
      if (head.size_slot != kNoId && head.size_slot < n.bound.count &&
          shrinks(program_.idAt(n.bound, head.size_slot), head.size_slot, head, larger))
        return true;
    }
    if (head.guard != Guard::when) return false;
    for (uint32_t slot = 0; slot < head.formals.count && slot < n.bound.count; ++slot) {
      bool positive = false;
      const ExprId arg = program_.idAt(n.bound, slot);
      if (!bounds(head.when, slot, positive, head) || !shrinks(arg, slot, head)) continue;
      // Repeated subtraction passes every bound. Repeated multiplication may converge to 0 without ever reaching a
      // bound of 0, so in this case the bound must be positive.
      if (program_.expr(arg).binary == BinaryOp::subtract || positive) return true;
    }
    return false;
  }

  /// Returns a hint how the author can bound the recursion.
  std::string remedy(const RuleCall& call, const std::string& name) const {
    if (call.from != call.to) return join({"bound it: `rule ", name, " ... depth 8 -> Leaf`"});
    const Alternative& head = program_.rules[call.from].alternatives[call.alternative];
    if (head.minsize == kNoId || call.escape)
      return join({"bound it: `rule ", name,
                   " ... depth 8 -> Leaf`, `minsize 1m -> Leaf`, or a guard `when n > 0` with n - 1"});
    if (head.size_slot == kNoId)
      return "`minsize` ends it where the scope becomes smaller with each call: put it into a part of a split, or "
             "after `size` or `scale(0.7)`; else bound it by `depth 8 -> Leaf`";
    const std::string_view size = program_.text(program_.ast.formals[head.formals.first + head.size_slot].name);
    return join({"`minsize` ends it where `", size, "` becomes smaller with each call, such as 0.7*", size,
                 "; else bound it by `depth 8 -> Leaf`"});
  }

  void report(const RuleCall& call) {
    const std::string name(program_.text(program_.rules[call.to].name));
    Diagnostic& d = sink_.error(program_.expr(call.call).span, codes::kUnboundedRecursion,
                                call.from == call.to ? join({"`", name, "` may call itself without end"})
                                                     : join({"`", program_.text(program_.rules[call.from].name),
                                                             "` and `", name, "` may call each other without end"}),
                                remedy(call, name));
    if (call.from != call.to)
      d.notes.push_back("only `depth` bounds rules that call each other");
    else if (call.escape)
      d.notes.push_back("the call after `->` must not lead back");
  }

  const Program& program_;
  const std::vector<RuleCall>& calls_;
  DiagnosticSink& sink_;
  std::vector<std::vector<uint32_t>> out_;
  std::vector<uint32_t> component_;
  uint32_t steps_;  ///< remaining steps for all interval evaluations together
  RangeEvaluator values_;
};

}  // namespace

void checkRecursion(Program& program, const std::vector<RuleCall>& calls, const CompileLimits& limits,
                    DiagnosticSink& sink) {
  RecursionCheck(program, calls, limits.bound_steps, sink).run(program);
}

}  // namespace sgm
