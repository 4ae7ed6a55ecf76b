#pragma once
// Calls of rules, and the choice among their alternatives.

#include <cstdint>
#include <vector>

#include "derive/interpret/env.h"
#include "derive/interpret/rule_watch.h"
#include "grammar/syntax/program.h"

namespace sgm::interpret {

struct CellContext;

/// The rules that are being derived at the moment: how many in all, and how many activations of each.
class RuleRunner {
 public:
  /// watch: is told of the calls of its rule; may be null. Both must outlive the runner.
  RuleRunner(CellContext& context, RuleWatch* watch);

  /// Derives a call of a rule with its overrides, and appends its shapes. node: the call.
  void call(uint32_t rule, const ExprNode& node, uint32_t ordinal, const Env& env, ShapeList& out);
  /// Derives an activation of a rule without its overrides: one alternative for each range of levels.
  void runAlternatives(const Rule& rule, Env env, std::vector<Value>& arguments, ShapeList& out);

 private:
  bool passes(const Alternative& alternative, Env& env, std::vector<Value>& arguments);
  const Alternative* choose(const std::vector<const Alternative*>& from, Env& env, std::vector<Value>& arguments,
                            uint64_t draw);
  void derive(const Rule& rule, const Alternative& chosen, Env& env, std::vector<Value>& arguments, ShapeList& out);

  CellContext& c_;
  RuleWatch* const watch_;
  std::vector<uint32_t> active_;  ///< for each rule: number of its activations on the path
  uint32_t depth_ = 0;
};

}  // namespace sgm::interpret
