#pragma once
// Prints expressions, calls and statements as one line of text: the part of the printer without layout.

#include <string>
#include <string_view>

#include "grammar/syntax/program.h"

namespace sgm {

/// The operator with the spaces that the formatter writes around it: " + ", "*".
std::string_view binaryText(BinaryOp op);

class LinePrinter {
 public:
  /// meaning: print numbers by value, and omit redundant parentheses, for texts that are compared by meaning.
  LinePrinter(const Program& program, bool meaning) : program_(program), meaning_(meaning) {}

  /// Prints an expression or a range a..b. lowest: the lowest Precedence that needs no parentheses.
  void expr(std::string& out, ExprId id, int lowest = 0) const;
  void formals(std::string& out, IdRange range) const;
  void args(std::string& out, IdRange range, std::string_view callee) const;
  void xforms(std::string& out, IdRange range) const;
  /// Prints a statement up to its body, without a trailing space; a statement without a body is printed completely.
  void head(std::string& out, const StmtNode& node) const;
  /// Prints part i of a split, a comp, a treemap or a wfc up to its statement, with a trailing space.
  void part(std::string& out, const StmtNode& node, uint32_t i) const;
  /// Whether a repeated group of parts begins before part i (opensGroup) or ends after it (closesGroup).
  bool opensGroup(const StmtNode& node, uint32_t i) const;
  bool closesGroup(const StmtNode& node, uint32_t i) const;
  /// Prints the whole statement on one line.
  void statement(std::string& out, StmtId id) const;
  void ruleHead(std::string& out, const Rule& rule, const Alternative& alternative) const;
  void overrideHead(std::string& out, const Override& edit) const;
  /// Prints a morphic rule: `morphic R(a) : A -> B by t power;`.
  void morphic(std::string& out, const Rule& rule, const Alternative& alternative) const;
  void field(std::string& out, const Field& field) const;
  void fitZone(std::string& out, const FitZoneNode& zone) const;

 private:
  void morphOperand(std::string& out, StmtId id) const;
  void footprint(std::string& out, const FootprintNode& node) const;
  /// Prints the labels of a tile's sides. before: the text to print in front of the first side.
  void sockets(std::string& out, const TileNode& tile, std::string_view before) const;
  void roof(std::string& out, const StmtNode& node) const;
  void fit(std::string& out, const StmtNode& node) const;
  void scatter(std::string& out, const ScatterNode& node) const;

  const Program& program_;
  bool meaning_;
};

}  // namespace sgm
