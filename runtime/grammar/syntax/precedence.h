#pragma once
// The precedence of operators, for the parser and the printer.

#include "grammar/syntax/ast.h"

namespace sgm {

/// A larger value binds tighter.
enum Precedence : int {
  kLoosest = 0,  ///< `if`, ranges
  kOr,
  kAnd,
  kComparison,  ///< also the operand of `not`
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
