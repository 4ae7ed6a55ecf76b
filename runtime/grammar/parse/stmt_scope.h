#pragma once
// Code that the parsers of all statements with their own keyword share.

#include <cstdint>
#include <memory_resource>
#include <string_view>
#include <vector>

#include "grammar/parse/parse_context.h"

namespace sgm::parse {

/// Builds the node of one statement, from its first word to its end.
class StmtScope {
 public:
  /// Takes the statement's first word. Precondition: it is the current token.
  StmtScope(ParseContext& in, StmtKind kind)
      : in_(in), begin_(in.tokens.here()), word_(in.tokens.textOf(in.tokens.take())) {
    node_.kind = kind;
  }

  StmtNode* operator->() { return &node_; }
  /// The span and the text of the statement's first word.
  const Span& begin() const { return begin_; }
  std::string_view word() const { return word_; }

  /// Adds the statement, whose span ends with the last token taken, to the tree. Returns kNoId in panic mode, or if the
  /// tree is full.
  StmtId finish() { return in_.tokens.hasFailed() ? kNoId : in_.build.addStmt(node_, begin_); }
  /// Like finish(), but first adds `node` to another table of the tree and stores its index in StmtNode::extra.
  template <typename Node>
  StmtId finish(std::pmr::vector<Node> Ast::*table, const Node& node) {
    if (in_.tokens.hasFailed()) return kNoId;
    node_.extra = in_.build.add(table, node);
    return finish();
  }

 private:
  ParseContext& in_;
  Span begin_;
  std::string_view word_;
  StmtNode node_;
};

}  // namespace sgm::parse
