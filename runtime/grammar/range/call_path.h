#pragma once
// The calls around an evaluation, for messages: the author of a grammar cannot change the standard library, so a
// message about it names the author's own call.

#include <cstdint>
#include <vector>

#include "grammar/syntax/program.h"

namespace sgm {

/// Whether a file (Span::file) belongs to the standard library and was imported.
bool isStandard(const Program& program, uint32_t file);

/// Owns the calls of rules and functions around the current evaluation, outermost first.
class CallPath {
 public:
  explicit CallPath(const Program& program) : program_(program) {}

  void enter(ExprId call) { calls_.push_back(call); }
  void leave() { calls_.pop_back(); }
  /// For an expression in the standard library: the innermost call around it outside of the library; else kNoId.
  ExprId writtenCaller(ExprId id) const;

 private:
  const Program& program_;
  std::vector<ExprId> calls_;
};

}  // namespace sgm
