#pragma once
// Checks rules, their heads and their statements.
//
// statements.cpp: dispatch by kind, blocks, morphs, local fields. rule_bodies.cpp: rules, overrides and calls.
// placement.cpp: loops, scatters, details. parts.cpp: split, snap and other statements with parts. Statements without
// bodies are checked by free functions (leaf_statements.h).

#include <cstdint>
#include <vector>

#include "grammar/check/rule_types.h"
#include "grammar/check/types.h"

namespace sgm {

/// Checks the bodies of rules and overrides. While a body is checked, stores the number of its statements and random
/// draws so far, the `scale` transforms around the current statement, and the rules and layers used.
class Statements {
 public:
  /// uses: receives the calls of rules, the probes and the queries.
  Statements(CheckContext& check, Symbols& symbols, Types& types, RuleTypes& rules, RuleUses& uses)
      : check_(check), symbols_(symbols), types_(types), rules_(rules), rule_uses_(uses) {}
  Statements(const Statements&) = delete;  // not copyable: Types::scope() contains pointers to members of this object
  Statements& operator=(const Statements&) = delete;

  /// Checks the start call of a layer.
  void start(ExprId call);
  /// Checks all queued rules (RuleTypes), including those that their calls add to the queue.
  void checkWaiting();
  /// Checks the heads and bodies of a rule, with the parameter types in RuleTypes.
  void checkRule(uint32_t rule);
  /// Checks the block of an override whose path is resolved. Returns the rules and layers that the block uses.
  RuleUses checkOverride(uint32_t index);

 private:
  void checkAlternative(uint32_t rule, uint32_t alternative);
  void checkHead(const Alternative& head);
  void enterBody(StmtId body, uint32_t module);
  void callRule(ExprId call, bool escape, bool shrunk);
  bool checkPassed(const ExprNode& call, const std::vector<uint32_t>& bound, std::vector<Type>& types);

  /// shrunk: the statement is enclosed by a scope that a split, a part or `size` makes smaller.
  void checkStatement(StmtId id, bool shrunk);
  void checkBlock(StmtId id, const StmtNode& s, bool shrunk);
  void checkLet(StmtId id, const StmtNode& s);
  void checkField(const StmtNode& s);
  void checkTransform(const StmtNode& s, bool shrunk);
  void checkMorph(const StmtNode& s, bool shrunk);
  void checkDetail(const StmtNode& s, bool shrunk);
  void checkLoop(StmtId id, const StmtNode& s, bool shrunk);
  void checkScatter(const StmtNode& s, bool shrunk);
  void checkSplit(const StmtNode& s);
  void checkParts(const StmtNode& s);

  CheckContext& check_;
  Symbols& symbols_;
  Types& types_;
  RuleTypes& rules_;
  RuleUses& rule_uses_;

  uint32_t rule_ = kNoId;  ///< the rule being checked; kNoId: the block of an override, or a start call
  uint32_t alternative_ = 0;
  StmtId body_ = kNoId;
  /// next values of StmtNode::ordinal and ExprNode::ordinal; both continue through all heads of a rule
  uint32_t ordinal_ = 0, draws_ = 0;
  std::vector<ScaleAround> scales_;  ///< the `scale` transforms that enclose the current statement, outermost first
  RuleUses uses_;                    ///< rules and layers used by the body being checked
};

}  // namespace sgm
