#pragma once
// Prints expressions, calls and statements as one line of text: the part of the printer without layout.

#include <string>
#include <string_view>

#include "grammar/syntax/program.h"

namespace sgm {

/// With spaces around it if the formatter writes them: " + ", "*".
std::string_view binaryText(BinaryOp op);

class LinePrinter {
 public:
  /// meaning: print numbers by value, and omit parentheses that are in the source only for clarity.
  LinePrinter(const Program& program, bool meaning) : program_(program), meaning_(meaning) {}

  /// Prints a range as a..b.
  void expr(std::string& out, ExprId id, int lowest = 0) const;
  void formals(std::string& out, IdRange range) const;
  void args(std::string& out, IdRange range, std::string_view callee) const;
  void xforms(std::string& out, IdRange range) const;
  /// Prints the part before a statement's body, without a space at the end; without a body, the whole statement.
  void head(std::string& out, const StmtNode& node) const;
  /// Prints the part before the statement of part i of a split, a comp, a treemap or a wfc, with a space at the end.
  void part(std::string& out, const StmtNode& node, uint32_t i) const;
  /// Whether a repeated group begins before part i, or ends after it.
  bool opensGroup(const StmtNode& node, uint32_t i) const;
  bool closesGroup(const StmtNode& node, uint32_t i) const;
  /// Prints the whole statement on one line.
  void statement(std::string& out, StmtId id) const;
  void ruleHead(std::string& out, const Rule& rule, const Alternative& alternative) const;
  void overrideHead(std::string& out, const Override& edit) const;
  /// `morphic R(a) : A -> B by t power;`
  void morphic(std::string& out, const Rule& rule, const Alternative& alternative) const;
  void field(std::string& out, const Field& field) const;
  void fitZone(std::string& out, const FitZoneNode& zone) const;

 private:
  void morphOperand(std::string& out, StmtId id) const;
  void footprint(std::string& out, const FootprintNode& node) const;
  /// before: text before the first socket.
  void sockets(std::string& out, const TileNode& tile, std::string_view before) const;
  void roof(std::string& out, const StmtNode& node) const;
  void fit(std::string& out, const StmtNode& node) const;
  void scatter(std::string& out, const ScatterNode& node) const;

  const Program& program_;
  bool meaning_;
};

}  // namespace sgm
