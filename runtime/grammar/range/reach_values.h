#pragma once
// Evaluates expressions over intervals: their possible values for all seeds, cells and parameter settings.
//
// reach_values.cpp: operators, names, functions of the grammar. range_builtins.cpp: built-in functions and members.

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "grammar/range/argument_ranges.h"
#include "grammar/range/bound_losses.h"
#include "grammar/range/call_path.h"
#include "grammar/range/range_value.h"

namespace sgm {

/// The query that looks farthest out of the cell, along the axes that are divided into cells.
struct Observation {
  double distance_m = 0;
  ExprId query = kNoId;
};

/// The parts of a rule's frame on which a result depends. If place is false, the result holds for all places; if scale
/// is false, for all scales of the scope.
struct Dependence {
  bool place = false, scale = false;
};

/// Evaluates expressions over intervals. State: the ranges of parameters and of the cell, and records of what
/// evaluations depended on.
class RangeEvaluator {
 public:
  /// steps: the caller's variable with the remaining budget, which must outlive this object. Each evaluation decrements
  /// it; at 0 every value is unknown.
  RangeEvaluator(const Program& program, uint32_t& steps);

  /// Sets the edges of a cell, metres. centred: the origin of the start rule's scope is the cell's centre, otherwise
  /// its low corner.
  void setCell(const IntervalVector& edges, bool centred) {
    cell_ = edges;
    low_ = centred ? -0.5 : 0.0;
  }
  /// The possible values of Program::params[index]; initially the parameter's whole range.
  Interval& parameter(uint32_t index) { return parameters_[index]; }
  /// Sets whether a function call whose value has no bound is evaluated again, once for each piece of an argument's
  /// range.
  void takePieces(bool takes) { pieces_ = takes; }

  RangeValue evaluate(ExprId id, const RangeFrame& frame);
  Interval number(ExprId id, const RangeFrame& frame);
  IntervalVector vector(ExprId id, const RangeFrame& frame);
  /// Returns [0, 0] if the condition is certainly false, [1, 1] if it is certainly true, otherwise a wider range.
  Interval condition(ExprId id, const RangeFrame& frame);

  /// Narrows the slots of a frame to the values for which a condition is true (or false, if `holds` is false).
  /// Understands comparisons of a local with a value, joined by `and` (for false: by `or`).
  void refine(ExprId condition, bool holds, RangeFrame& frame);
  /// Compares the arguments of a call with the ranges of its formals (Misfits::compare). Does nothing while
  /// takePieces(true) is in effect. given: value ranges of the bound arguments.
  void compareArguments(ExprId call, IdRange formals, std::span<const RangeValue> given);

  /// The parts of the rule's frame on which the results since the last reset depend. The caller resets it.
  Dependence& dependence() { return dependence_; }
  /// The query since the last reset that looked farthest out of the cell. The caller resets it by assignment.
  Observation& observation() { return observation_; }
  const std::vector<bool>& usedParameters() const { return used_parameters_; }
  CallPath& calls() { return calls_; }
  BoundLosses& losses() { return losses_; }
  const BoundLosses& losses() const { return losses_; }
  Misfits& misfits() { return misfits_; }

 private:
  RangeValue evaluateNode(ExprId id, const RangeFrame& frame);
  RangeValue query(ExprId id, const RangeFrame& frame);
  RangeValue binary(ExprId id, const RangeFrame& frame);
  RangeValue call(ExprId id, const RangeFrame& frame);
  RangeValue builtin(const ExprNode& n, const RangeFrame& frame);
  RangeValue applied(ExprId id, const RangeFrame& frame);
  /// Evaluates a function once for each piece of an argument's range and merges the results; nullopt if some piece has
  /// no bound.
  std::optional<RangeValue> inPieces(ExprId body, RangeFrame& frame, uint32_t slot, Interval range, int depth);
  RangeValue member(const ExprNode& n, const RangeFrame& frame);
  /// Returns the position of a point relative to the scope with which the rule starts. from_cell: the point relative to
  /// the low corner of the derived cell, in edges of the cell.
  RangeValue point(const IntervalVector& from_cell, const RangeFrame& frame);
  uint32_t child(const ExprNode& n, uint32_t i) const { return program_.idAt(n.children, i); }

  const Program& program_;
  uint32_t& steps_;
  IntervalVector cell_{};
  double low_ = 0;  ///< the cell's low corner relative to the origin, in cells: -0.5 or 0
  int depth_ = 0;
  bool pieces_ = false;
  std::vector<Interval> parameters_;
  std::vector<bool> used_parameters_;
  Dependence dependence_;
  Observation observation_;
  CallPath calls_;
  BoundLosses losses_;
  Misfits misfits_;
};

}  // namespace sgm
