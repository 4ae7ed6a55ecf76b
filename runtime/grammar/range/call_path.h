#pragma once
// The stack of calls around the evaluated expression, for messages: the author of a grammar cannot change the standard
// library, so messages about the library point at the author's call into it.

#include <cstdint>
#include <vector>

#include "grammar/syntax/program.h"

namespace sgm {

/// Whether a file (Span::file) belongs to the standard library and was imported.
bool isStandard(const Program& program, uint32_t file);

/// A stack of the calls of rules and functions that enclose the current evaluation, outermost first.
class CallPath {
 public:
  explicit CallPath(const Program& program) : program_(program) {}

  void enter(ExprId call) { calls_.push_back(call); }
  void leave() { calls_.pop_back(); }
  /// For an expression in the standard library, returns the innermost enclosing call that is written outside of the
  /// library. Returns kNoId for other expressions.
  ExprId writtenCaller(ExprId id) const;

 private:
  const Program& program_;
  std::vector<ExprId> calls_;
};

}  // namespace sgm
