#pragma once
// The limits that bound the time and the stack of a proof: grammar text is untrusted.

#include <algorithm>
#include <cstdint>
#include <utility>

namespace sgm::reach {

/// Owns the steps that are left for all layers together, the steps that were spent, the statements on the call stack,
/// and whether one of these limits cut the current attempt short: then nothing is proven.
class StepBudget {
 public:
  /// attempt_steps: steps of one attempt.
  explicit StepBudget(uint32_t attempt_steps) : attempt_steps_(attempt_steps), left_(attempt_steps) {}

  /// The rest, for a RangeEvaluator, which counts it down as well.
  uint32_t& left() { return left_; }
  uint32_t left() const { return left_; }
  void refill() { left_ = attempt_steps_; }

  /// Cuts the attempt short if a limit is reached. Returns whether it is cut short.
  bool cutAtLimit() {
    cut_short_ = cut_short_ || left_ == 0 || depth_ >= kDeepestStatement;
    return cut_short_;
  }
  bool isCutShort() const { return cut_short_; }
  /// Forgets that the attempt was cut short. Returns whether it was.
  bool clearCut() { return std::exchange(cut_short_, false); }

  /// Takes a step for a statement or a rule. Precondition: cutAtLimit() returned false.
  void enter() {
    --left_;
    ++depth_;
  }
  void leave() { --depth_; }

  /// Adds the steps since `before` were left to those spent; none if a refill has exceeded that.
  void addSpent(uint32_t before) { spent_ += before - std::min(before, left_); }
  void clearSpent() { spent_ = 0; }
  /// Whether more steps were spent since clearSpent() than some attempts have.
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
