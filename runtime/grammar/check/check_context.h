#pragma once
// The program being checked, and the other state that all parts of the check share.

#include <string_view>
#include <vector>

#include "grammar/syntax/name_table.h"
#include "grammar/syntax/program.h"
#include "grammar/syntax/syntax.h"
#include "grammar/text/limits.h"
#include "grammar/text/sink.h"

namespace sgm {

/// References to the inputs and outputs of one check, with short accessors for the syntax tree. Owns none of the
/// objects; all must outlive it.
struct CheckContext {
  Program& program;
  NameTable& names;
  const std::vector<ModuleSyntax>& syntax;  ///< the parsed files, by module index; [0] is the root file
  const CompileLimits& limits;
  DiagnosticSink& sink;
  bool library = false;  ///< the root is meant for import, so it needs no start
  bool lossy = false;    ///< loading or parsing reported errors, so a part of the text is missing from the tree

  ExprNode& node(ExprId id) const { return program.ast.exprs[id]; }
  std::string_view text(NameId id) const { return program.text(id); }
  uint32_t child(const ExprNode& n, uint32_t i) const { return program.idAt(n.children, i); }
  /// Whether parts of a statement may be missing because its file was not parsed completely.
  bool isLossy(const StmtNode& s) const { return !syntax[s.span.file].complete; }

  /// Appends ids to Ast::ids, and returns the range that they occupy there.
  IdRange store(const std::vector<uint32_t>& ids) const;
  /// Returns the index of a name in one of the program's string tables (materials, tags, names), adding the name if it
  /// is new. Reports an error at `span` and returns 0 if the table is full.
  uint16_t tableIndex(std::pmr::vector<std::pmr::string>& table, NameId name, const Span& span) const;
};

}  // namespace sgm
