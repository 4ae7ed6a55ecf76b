#pragma once
// A tighter proof where plain intervals lose too much: they ignore that a value used twice is the same both times, so
// that `r / (0.3*r)` and a displacement by a part of its operand look worse than they are. Over short pieces of the
// range of such a value little is lost; together the pieces cover the range.

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "grammar/range/extent.h"
#include "grammar/reach/step_budget.h"

namespace sgm::reach {

/// Owns the mode by which the current attempt divides ranges into pieces, and the number of splits around the current
/// statement, on which the division of sizes depends.
class RangePieces {
 public:
  /// The ranges that are evaluated in pieces: none, those without a bound, or all.
  enum class Mode : uint8_t { none, lost, all };

  void setMode(Mode mode) { mode_ = mode; }
  bool isDividing() const { return mode_ != Mode::none; }

  /// The extent for all possible values, each in pieces if that helps. extent: evaluates with their current ranges,
  /// which this changes meanwhile.
  Extent boundOver(const std::vector<RangeValue*>& values, const std::function<Extent()>& extent,
                   const StepBudget& budget) const;
  /// The extent over all pieces of a range, with the certain reach of `whole`: that applies to the whole range, as
  /// without pieces. nullopt if the range has no pieces, or if some piece has no bound, however short it is.
  std::optional<Extent> divide(RangeValue& value, const Extent& whole, const std::function<Extent()>& extent,
                               const StepBudget& budget) const;

  /// Whether splits divide the sizes of their parts here.
  bool dividesSizes() const { return !divides_few_sizes_ || splits_ < kSplitsInPieces; }
  bool dividesFewSizes() const { return divides_few_sizes_; }
  /// Divides sizes only in the outermost splits from now on: nested pieces would use up all steps.
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
