#pragma once
// The program being checked, and everything else that all parts of the check share.

#include <string_view>
#include <vector>

#include "grammar/syntax/name_table.h"
#include "grammar/syntax/program.h"
#include "grammar/syntax/syntax.h"
#include "grammar/text/limits.h"
#include "grammar/text/sink.h"

namespace sgm {

/// References to the inputs and outputs of one check, with short names for the most frequent ways through the tree.
/// Owns nothing; everything that it names must outlive it.
struct CheckContext {
  Program& program;
  NameTable& names;
  const std::vector<ModuleSyntax>& syntax;  ///< [0] is the root
  const CompileLimits& limits;
  DiagnosticSink& sink;
  bool library = false;  ///< the root is a file for import, and derives nothing
  bool lossy = false;    ///< loading or parsing had errors: a part of the text is missing

  ExprNode& node(ExprId id) const { return program.ast.exprs[id]; }
  std::string_view text(NameId id) const { return program.text(id); }
  uint32_t child(const ExprNode& n, uint32_t i) const { return program.idAt(n.children, i); }
  /// Whether parts of a statement may be missing because they were not parsed.
  bool isLossy(const StmtNode& s) const { return !syntax[s.span.file].complete; }

  /// Appends ids to Ast::ids, and returns where they lie.
  IdRange store(const std::vector<uint32_t>& ids) const;
  /// The index of a name in a table of the program, to which it is added if necessary. Reports an error and returns 0
  /// if the table is full. span: the place of the name.
  uint16_t tableIndex(std::pmr::vector<std::pmr::string>& table, NameId name, const Span& span) const;
};

}  // namespace sgm
