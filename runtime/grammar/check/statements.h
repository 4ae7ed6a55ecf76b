#pragma once
// Rules, their heads and their statements.
//
// statements.cpp: the dispatch, blocks, morphs, local fields. rule_bodies.cpp: rules, overrides and calls.
// placement.cpp: loops, point sets, details. parts.cpp: split, snap and the parts of scopes. Statements without bodies
// are functions (leaf_statements.h).

#include <cstdint>
#include <vector>

#include "grammar/check/rule_types.h"
#include "grammar/check/types.h"

namespace sgm {

/// The body of a rule or an override that is being checked: its statements and draws so far, the scales around the
/// current statement, and the rules and layers that it uses.
class Statements {
 public:
  /// uses: receives the calls of rules, and the layers that they ask.
  Statements(CheckContext& check, Symbols& symbols, Types& types, RuleTypes& rules, RuleUses& uses)
      : check_(check), symbols_(symbols), types_(types), rules_(rules), rule_uses_(uses) {}
  Statements(const Statements&) = delete;  // the scope points into it
  Statements& operator=(const Statements&) = delete;

  /// Checks the call with which a layer starts.
  void start(ExprId call);
  /// Checks the rules that wait, and those that they call.
  void checkWaiting();
  /// Checks the heads and bodies of one rule, with the types that RuleTypes has for it.
  void checkRule(uint32_t rule);
  /// Checks the block of an override whose path is resolved, and returns the rules and layers that it uses.
  RuleUses checkOverride(uint32_t index);

 private:
  void checkAlternative(uint32_t rule, uint32_t alternative);
  void checkHead(const Alternative& head);
  void enterBody(StmtId body, uint32_t module);
  void callRule(ExprId call, bool escape, bool shrunk);
  bool checkPassed(const ExprNode& call, const std::vector<uint32_t>& bound, std::vector<Type>& types);

  /// shrunk: the statement is inside of a scope that a split, a part or `size` makes smaller.
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

  uint32_t rule_ = kNoId;  ///< kNoId: the block of an override, or a start
  uint32_t alternative_ = 0;
  StmtId body_ = kNoId;
  uint32_t ordinal_ = 0, draws_ = 0;  ///< counted through all heads of a rule
  std::vector<ScaleAround> scales_;   ///< around the current statement, from the outside in
  RuleUses uses_;                     ///< of this body
};

}  // namespace sgm
