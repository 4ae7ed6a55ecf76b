#pragma once
// The limits that bound the time and the stack of a proof: grammar text is untrusted.

#include <algorithm>
#include <cstdint>
#include <utility>

namespace sgm::reach {

/// Counts the remaining steps of the current attempt to prove an extent, the steps spent in total, and the depth of
/// nested statements. If a limit is reached, the attempt is cut short and proves nothing.
class StepBudget {
 public:
  /// attempt_steps: the maximum number of steps of one attempt to prove an extent.
  explicit StepBudget(uint32_t attempt_steps) : attempt_steps_(attempt_steps), left_(attempt_steps) {}

  /// The remaining steps. Returned by reference since a RangeEvaluator decrements the same counter.
  uint32_t& left() { return left_; }
  uint32_t left() const { return left_; }
  void refill() { left_ = attempt_steps_; }

  /// If the limit of steps or of nesting is reached, marks the current proof attempt as cut short. Returns whether it
  /// is marked, now or earlier.
  bool cutAtLimit() {
    cut_short_ = cut_short_ || left_ == 0 || depth_ >= kDeepestStatement;
    return cut_short_;
  }
  bool isCutShort() const { return cut_short_; }
  /// Clears the mark that the proof attempt was cut short. Returns whether the mark was set.
  bool clearCut() { return std::exchange(cut_short_, false); }

  /// Enters a statement or a rule: takes one step from the budget, and increases the nesting depth. Precondition:
  /// cutAtLimit() returned false.
  void enter() {
    --left_;
    ++depth_;
  }
  void leave() { --depth_; }

  /// Adds to the spent steps those that were consumed since left() was `before`. Adds 0 if a refill has raised left()
  /// above `before` since then.
  void addSpent(uint32_t before) { spent_ += before - std::min(before, left_); }
  void clearSpent() { spent_ = 0; }
  /// Whether the steps spent since clearSpent() exceed the steps of this number of full attempts.
  bool hasSpentMoreThan(uint64_t attempts) const { return spent_ > attempts * attempt_steps_; }

 private:
  static constexpr int kDeepestStatement = 400;

  const uint32_t attempt_steps_;
  uint32_t left_;
  uint64_t spent_ = 0;
  int depth_ = 0;
  bool cut_short_ = false;
};

}  // namespace sgm::reach
