#pragma once
// Tightens the proof by subdividing ranges. Interval arithmetic ignores that a value used twice is the same both times
// (the dependency problem), so `r / (0.3*r)`, or a displacement in proportion to its operand's size, gets too wide a
// range. For short pieces of r's range the error is small; the union of all pieces covers the range.

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "grammar/range/extent.h"
#include "grammar/reach/step_budget.h"

namespace sgm::reach {

/// Selects which ranges the current attempt divides, and counts the splits that enclose the current statement, which
/// limits the division of sizes.
class RangePieces {
 public:
  /// The ranges that are evaluated in pieces: none, only those that lead to a missing bound, or all.
  enum class Mode : uint8_t { none, lost, all };

  void setMode(Mode mode) { mode_ = mode; }
  bool isDividing() const { return mode_ != Mode::none; }

  /// Returns the extent for all possible values; divides the range of each value if that tightens the result. extent:
  /// computes the extent for the current ranges of `values`, which are changed during the call and then restored.
  Extent boundOver(const std::vector<RangeValue*>& values, const std::function<Extent()>& extent,
                   const StepBudget& budget) const;
  /// Returns the union of the extents over all pieces of a value's range. `whole` is the extent without division; its
  /// sure_lo and sure_hi are kept, since they hold for the whole range. nullopt if the range cannot be divided, or if
  /// some piece has no bound even at the smallest length.
  std::optional<Extent> divide(RangeValue& value, const Extent& whole, const std::function<Extent()>& extent,
                               const StepBudget& budget) const;

  /// Whether the sizes of parts are divided in a split at the current nesting depth.
  bool dividesSizes() const { return !divides_few_sizes_ || splits_ < kSplitsInPieces; }
  bool dividesFewSizes() const { return divides_few_sizes_; }
  /// From now on divides sizes only in the outermost splits, since nested division would exhaust the step budget.
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
