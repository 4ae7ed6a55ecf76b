#pragma once
// Expressions over intervals: what a value may be, for all seeds, cells and settings of the parameters.

#include <cstdint>
#include <optional>
#include <vector>

#include "grammar/interval.h"
#include "grammar/program.h"

namespace sgm {

/// A number or condition is v[0]; a vector or pair v; a cell or face its offset from the cell being derived, in cells.
struct RangeValue {
  ValueKind kind = ValueKind::unknown;
  IntervalVector v{Interval::everything(), Interval::everything(), Interval::everything()};

  static RangeValue number(Interval i) { return {ValueKind::number, {i, {}, {}}}; }
  static RangeValue condition(Interval i) { return {ValueKind::boolean, {i, {}, {}}}; }
  static RangeValue vector(const IntervalVector& v) { return {ValueKind::vector, v}; }
  static RangeValue unknown() { return {}; }
};

/// What a frame's expressions may refer to.
struct RangeFrame {
  std::vector<RangeValue> slots;
  IntervalVector scope{};  ///< edges of the scope's box
};

class RangeEvaluator {
 public:
  /// steps: what is left of the caller's budget; at 0 every value is unknown.
  RangeEvaluator(const Program& program, uint32_t& steps) : program_(program), steps_(steps) {}

  void setCell(const IntervalVector& edges) { cell_ = edges; }

  RangeValue evaluate(ExprId id, const RangeFrame& frame);
  Interval number(ExprId id, const RangeFrame& frame);
  IntervalVector vector(ExprId id, const RangeFrame& frame);
  /// [0, 0] false, [1, 1] true, otherwise either.
  Interval condition(ExprId id, const RangeFrame& frame);

  /// Narrows the slots of a frame to where a condition holds (or does not): comparisons of a local with a value, joined
  /// by `and` (or, denied, `or`).
  void refine(ExprId condition, bool holds, RangeFrame& frame);

 private:
  RangeValue binary(const ExprNode& n, const RangeFrame& frame);
  RangeValue call(const ExprNode& n, const RangeFrame& frame);
  RangeValue builtin(const ExprNode& n, const RangeFrame& frame);
  RangeValue applied(const ExprNode& n, const RangeFrame& frame);
  RangeValue member(const ExprNode& n, const RangeFrame& frame);
  uint32_t child(const ExprNode& n, uint32_t i) const { return program_.idAt(n.children, i); }

  const Program& program_;
  uint32_t& steps_;
  IntervalVector cell_{};
  int depth_ = 0;
};

}  // namespace sgm
