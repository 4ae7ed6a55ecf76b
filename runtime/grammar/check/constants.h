#pragma once
// Evaluates constant expressions.

#include <map>
#include <optional>

#include "grammar/syntax/program.h"

namespace sgm {

/// Evaluates constants; caches the values of lets without parameters, so that each is computed only once.
class Constants {
 public:
  explicit Constants(const Program& program) : program_(program) {}

  /// Returns the value of a checked expression that consists of numbers, arithmetic and lets without parameters.
  /// Returns nullopt if the expression contains anything else, divides by zero or is nested too deep.
  std::optional<double> fold(ExprId id) { return fold(id, 0); }

 private:
  std::optional<double> fold(ExprId id, int depth);

  const Program& program_;
  std::map<uint32_t, double> lets_;  ///< cached values; keys are indices into Program::lets
};

/// Whether an expression consists only of number literals and arithmetic; false if it contains a name.
bool isLiteral(const Program& program, ExprId id);

}  // namespace sgm
