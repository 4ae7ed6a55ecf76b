#pragma once
// How tightly operators bind, for the parser and the printer.

#include "grammar/syntax/ast.h"

namespace sgm {

/// Binds tighter where larger.
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
