#pragma once
// The precedence of operators, common to parser and printer.

#include "grammar/syntax/ast.h"

namespace sgm {

/// Operators with a larger value bind tighter.
enum Precedence : int {
  kLoosest = 0,  ///< precedence of `if` and of ranges a..b
  kOr,
  kAnd,
  kComparison,  ///< precedence of comparisons, and of the operand of `not`
  kSum,
  kProduct,
  kUnary,
  kPostfix,
};

constexpr Precedence precedenceOf(BinaryOp op) {
  switch (op) {
    case BinaryOp::add:
    case BinaryOp::subtract:
      return kSum;
    case BinaryOp::multiply:
    case BinaryOp::divide:
      return kProduct;
    case BinaryOp::logical_and:
      return kAnd;
    case BinaryOp::logical_or:
      return kOr;
    default:
      return kComparison;
  }
}

}  // namespace sgm
