#pragma once
// The values of constant expressions.

#include <map>
#include <optional>

#include "grammar/syntax/program.h"

namespace sgm {

/// The values of lets without parameters, each of which is computed once, however often it is used.
class Constants {
 public:
  explicit Constants(const Program& program) : program_(program) {}

  /// The value of a checked expression of numbers, arithmetic and lets without parameters; nullopt if it contains
  /// anything else, divides by zero or is nested too deep.
  std::optional<double> fold(ExprId id) { return fold(id, 0); }

 private:
  std::optional<double> fold(ExprId id, int depth);

  const Program& program_;
  std::map<uint32_t, double> lets_;  ///< Program::lets
};

/// Whether an expression consists of numbers and arithmetic alone.
bool isLiteral(const Program& program, ExprId id);

}  // namespace sgm
