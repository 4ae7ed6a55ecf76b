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

/// Adds the nodes of one file to the syntax tree, and limits the depth of its expressions.
class AstBuilder {
 public:
  /// max_nodes: the maximum number of expressions and statements in the whole tree, other files included.
  AstBuilder(Ast& ast, NameTable& names, TokenStream& tokens, uint32_t max_nodes);

  /// Add a node whose span reaches from `begin` to the last token taken. Return kNoId if the tree is full, which is
  /// reported as an error only once.
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

  /// The reference is valid until the next expression is added.
  ExprNode& expr(ExprId id) { return ast_.exprs[id]; }

 private:
  /// Returns false, after reporting an error, if the tree is full.
  bool hasRoom();

  Ast& ast_;
  NameTable& names_;
  TokenStream& tokens_;
  uint32_t max_nodes_;
  size_t first_expr_;  ///< the index in Ast::exprs of this file's first expression
  /// height of the tree of each expression of this file. The height is limited separately from the nesting: the parser
  /// reads `a + b + ...` in a loop, without recursion, but each further operand makes the tree higher
  std::vector<uint16_t> depth_;
};

}  // namespace sgm::parse
