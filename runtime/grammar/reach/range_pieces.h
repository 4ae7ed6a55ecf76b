#pragma once
// Tightens the proof by subdividing ranges. Interval arithmetic ignores that a value used twice is the same both times
// (the dependency problem). So `r / (0.3*r)`, or a displacement in proportion to its operand's size, gets too wide a
// range. For short pieces of r's range the error is small, and the union of the results for all pieces is a valid
// result for the whole range.

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "grammar/range/extent.h"
#include "grammar/reach/step_budget.h"

namespace sgm::reach {

/// Selects the ranges that the current attempt divides. Also counts the split statements that enclose the current
/// statement: after divideFewSizes(), ranges of sizes are divided only in a split that few others enclose.
class RangePieces {
 public:
  /// Selects the ranges that are evaluated in pieces: no range, only ranges that lead to a missing bound, or all
  /// ranges.
  enum class Mode : uint8_t { none, lost, all };

  void setMode(Mode mode) { mode_ = mode; }
  bool isDividing() const { return mode_ != Mode::none; }

  /// Returns the extent for all possible values; divides the range of each value if that tightens the result. extent:
  /// computes the extent for the current ranges of `values`, which are changed during the call and then restored.
  Extent boundOver(const std::vector<RangeValue*>& values, const std::function<Extent()>& extent,
                   const StepBudget& budget) const;
  /// Divides the range of a value into pieces, and returns the union of the extents for all pieces. `whole` is the
  /// extent computed for the undivided range; the result takes sure_lo and sure_hi from `whole`, since these hold for
  /// the whole range. Returns nullopt if the range cannot be divided, if some piece has no bound even when it cannot be
  /// divided further, or if the step budget is used up.
  std::optional<Extent> divide(RangeValue& value, const Extent& whole, const std::function<Extent()>& extent,
                               const StepBudget& budget) const;

  /// Whether the ranges of the sizes of a split's parts are divided, for a split at the current nesting depth.
  bool dividesSizes() const { return !divides_few_sizes_ || splits_ < kSplitsInPieces; }
  bool dividesFewSizes() const { return divides_few_sizes_; }
  /// From now on only the outermost splits divide the ranges of sizes, since nested division would exhaust the step
  /// budget.
  void divideFewSizes() { divides_few_sizes_ = true; }
  void enterSplit() { ++splits_; }
  void leaveSplit() { --splits_; }

 private:
  static constexpr int kSplitsInPieces = 4;

  bool divide(RangeValue& value, int depth, const std::function<Extent()>& extent, const StepBudget& budget,
              std::optional<Extent>& out) const;

  Mode mode_ = Mode::none;
  bool divides_few_sizes_ = false;
  int splits_ = 0;
};

}  // namespace sgm::reach
