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

/// The longest reach of queries out of the cell, along axes that are cut into cells, and the query responsible.
struct Observation {
  double distance_m = 0;
  ExprId query = kNoId;
};

/// The parts of a rule's frame on which results depend. Without `place` they are the same for other places, and without
/// `scale` for other scales.
struct Dependence {
  bool place = false, scale = false;
};

/// Owns the ranges of the parameters and of the cell, and a record of the parts that evaluations used.
class RangeEvaluator {
 public:
  /// steps: the rest of the caller's budget, which must outlive this; at 0 every value is unknown.
  RangeEvaluator(const Program& program, uint32_t& steps);

  /// Sets the edges of a cell. centred: it lies around the origin of the start's scope, otherwise its low corner is
  /// there.
  void setCell(const IntervalVector& edges, bool centred) {
    cell_ = edges;
    low_ = centred ? -0.5 : 0.0;
  }
  /// The possible values of a parameter; at first its whole range.
  Interval& parameter(uint32_t index) { return parameters_[index]; }
  /// Sets whether functions without a bound are evaluated in pieces of their arguments.
  void takePieces(bool takes) { pieces_ = takes; }

  RangeValue evaluate(ExprId id, const RangeFrame& frame);
  Interval number(ExprId id, const RangeFrame& frame);
  IntervalVector vector(ExprId id, const RangeFrame& frame);
  /// [0, 0]: false, [1, 1]: true, otherwise either.
  Interval condition(ExprId id, const RangeFrame& frame);

  /// Narrows the slots of a frame to values for which a condition holds (or not): comparisons of a local with a value,
  /// joined by `and` (if negated, by `or`).
  void refine(ExprId condition, bool holds, RangeFrame& frame);
  /// Compares the arguments of a call with its formals, except in pieces. given: values of the bound arguments.
  void compareArguments(ExprId call, IdRange formals, std::span<const RangeValue> given);

  /// Of the results since the caller cleared it.
  Dependence& dependence() { return dependence_; }
  /// The farthest one since the caller cleared it.
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
  /// Evaluates a function in pieces of one argument's range; nullopt if a piece has no bound either.
  std::optional<RangeValue> inPieces(ExprId body, RangeFrame& frame, uint32_t slot, Interval range, int depth);
  RangeValue member(const ExprNode& n, const RangeFrame& frame);
  /// A point of the cell, relative to the scope with which the rule starts.
  RangeValue point(const IntervalVector& from_cell, const RangeFrame& frame);
  uint32_t child(const ExprNode& n, uint32_t i) const { return program_.idAt(n.children, i); }

  const Program& program_;
  uint32_t& steps_;
  IntervalVector cell_{};
  double low_ = 0;  ///< of the cell, in cells
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
