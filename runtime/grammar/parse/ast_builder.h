#pragma once
// Adds nodes to the arrays of a syntax tree.

#include <cstdint>
#include <memory_resource>
#include <string_view>
#include <vector>

#include "grammar/parse/token_stream.h"
#include "grammar/syntax/ast.h"
#include "grammar/syntax/name_table.h"

namespace sgm::parse {

/// The syntax tree to which the nodes of one file are added, and the depths of that file's expressions.
class AstBuilder {
 public:
  /// most_nodes: of expressions and statements together, those of other files included.
  AstBuilder(Ast& ast, NameTable& names, TokenStream& tokens, uint32_t most_nodes);

  /// Add a node that spans the tokens from `begin` to the one that was taken last. kNoId if the tree is full; the error
  /// is reported once.
  ExprId addExpr(ExprNode node, const Span& begin);
  StmtId addStmt(StmtNode node, const Span& begin);

  /// Adds a node to another table of the tree, such as &Ast::roofs, and returns its index.
  template <typename Node>
  uint32_t add(std::pmr::vector<Node> Ast::*table, const Node& node) {
    (ast_.*table).push_back(node);
    return static_cast<uint32_t>((ast_.*table).size() - 1);
  }
  template <typename Node>
  IdRange addRange(std::pmr::vector<Node> Ast::*table, const std::vector<Node>& nodes) {
    const IdRange range{static_cast<uint32_t>((ast_.*table).size()), static_cast<uint32_t>(nodes.size())};
    (ast_.*table).insert((ast_.*table).end(), nodes.begin(), nodes.end());
    return range;
  }
  IdRange addIds(const std::vector<uint32_t>& ids) { return addRange(&Ast::ids, ids); }

  NameId addName(std::string_view name) { return names_.intern(name); }

  /// Valid until the next expression is added.
  ExprNode& expr(ExprId id) { return ast_.exprs[id]; }

 private:
  /// Returns false, after an error, if the limit is reached.
  bool hasRoom();

  Ast& ast_;
  NameTable& names_;
  TokenStream& tokens_;
  uint32_t most_nodes_;
  size_t first_expr_;            ///< of this file
  std::vector<uint16_t> depth_;  ///< of each expression of this file: trees that loops build have a limit, too
};

}  // namespace sgm::parse
