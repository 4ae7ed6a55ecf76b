#include "grammar/parse/ast_builder.h"

#include <algorithm>
#include <string>

#include "grammar/text/codes.h"

namespace sgm::parse {

AstBuilder::AstBuilder(Ast& ast, NameTable& names, TokenStream& tokens, uint32_t max_nodes)
    : ast_(ast), names_(names), tokens_(tokens), max_nodes_(max_nodes), first_expr_(ast.exprs.size()) {}

bool AstBuilder::hasRoom() {
  if (tokens_.isExhausted()) return false;
  if (ast_.exprs.size() + ast_.stmts.size() < max_nodes_) return true;
  tokens_.exhaust(codes::kTooLarge,
                  join({"the text has more than ", std::to_string(max_nodes_), " expressions and statements"}),
                  "use loops and rules to say the same in fewer");
  return false;
}

ExprId AstBuilder::addExpr(ExprNode node, const Span& begin) {
  // Maximum height of an expression tree. The limit on nesting does not bound it: the parser reads `a + b + c ...` in a
  // loop, without nesting, but each further operand makes the tree higher.
  constexpr uint16_t kDeepestTree = 128;
  if (!hasRoom()) return kNoId;
  node.span = tokens_.since(begin);
  uint16_t depth = 0;
  const auto include = [&](ExprId child) {
    if (child != kNoId && child >= first_expr_) depth = std::max(depth, depth_[child - first_expr_]);
  };
  for (uint32_t i = 0; i < node.children.count; ++i) include(ast_.ids[node.children.first + i]);
  for (uint32_t i = 0; i < node.args.count; ++i) include(ast_.args[node.args.first + i].value);
  if (++depth > kDeepestTree) {
    tokens_.fail(node.span, codes::kTooDeep,
                 join({"the expression has more than ", std::to_string(kDeepestTree), " steps"}),
                 "name a part of it with let");
    depth = kDeepestTree;
  }
  depth_.push_back(depth);
  return add(&Ast::exprs, node);
}

StmtId AstBuilder::addStmt(StmtNode node, const Span& begin) {
  if (!hasRoom()) return kNoId;
  node.span = tokens_.since(begin);
  return add(&Ast::stmts, node);
}

}  // namespace sgm::parse
