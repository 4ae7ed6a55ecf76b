#pragma once
// The frame of all statements that begin with a word of their own.

#include <cstdint>
#include <memory_resource>
#include <string_view>
#include <vector>

#include "grammar/parse/parse_context.h"

namespace sgm::parse {

/// A statement while it is parsed, from the word that it begins with to its end.
class StmtScope {
 public:
  /// Takes that word.
  StmtScope(ParseContext& in, StmtKind kind)
      : in_(in), begin_(in.tokens.here()), word_(in.tokens.textOf(in.tokens.take())) {
    node_.kind = kind;
  }

  StmtNode* operator->() { return &node_; }
  /// The span and the text of the word.
  const Span& begin() const { return begin_; }
  std::string_view word() const { return word_; }

  /// Ends the statement with the token that was taken last, and adds it. kNoId in panic, or if the tree is full.
  StmtId finish() { return in_.tokens.hasFailed() ? kNoId : in_.build.addStmt(node_, begin_); }
  /// The same, after it has added a node to another table, whose index becomes StmtNode::extra.
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
