#pragma once
// Derives calls of rules, and chooses among their alternatives.

#include <cstdint>
#include <vector>

#include "derive/interpret/env.h"
#include "derive/interpret/rule_watch.h"
#include "grammar/syntax/program.h"

namespace sgm::interpret {

struct CellContext;

/// Calls rules. Counts the activations on the current path, in total and of each rule, to limit the recursion.
class RuleRunner {
 public:
  /// watch: records the calls of one rule; may be null. Both arguments must outlive the runner.
  RuleRunner(CellContext& context, RuleWatch* watch);

  /// Derives a call of a rule with its overrides, and appends its shapes to `out`. node: the call.
  void call(uint32_t rule, const ExprNode& node, uint32_t ordinal, const Env& env, ShapeList& out);
  /// Derives an activation of a rule, without its overrides. For the finest levels, derives one of the alternatives
  /// without `lod`. The cell edge of each `lod` begins a range of coarser levels; for each range, derives one of the
  /// alternatives with this `lod`.
  void runAlternatives(const Rule& rule, Env env, std::vector<Value>& arguments, ShapeList& out);

 private:
  bool passes(const Alternative& alternative, Env& env, std::vector<Value>& arguments);
  const Alternative* choose(const std::vector<const Alternative*>& from, Env& env, std::vector<Value>& arguments,
                            uint64_t draw);
  void derive(const Rule& rule, const Alternative& chosen, Env& env, std::vector<Value>& arguments, ShapeList& out);

  CellContext& c_;
  RuleWatch* const watch_;
  std::vector<uint32_t> active_;  ///< number of activations on the current path, by rule index
  uint32_t depth_ = 0;
};

}  // namespace sgm::interpret
