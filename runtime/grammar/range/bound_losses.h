#pragma once
// The places where values lose their bounds, for messages.

#include <cstdint>
#include <utility>
#include <vector>

#include "grammar/range/interval.h"
#include "grammar/syntax/program.h"

namespace sgm {

/// The place where a value loses its bound.
struct BoundLoss {
  enum class Cause : uint8_t { none, divisor, parameter } cause = Cause::none;
  ExprId expr = kNoId;    ///< the quotient, or the use of the parameter
  ExprId caller = kNoId;  ///< CallPath::writtenCaller of it
  Interval divisor;
};

/// Owns the losses that evaluations met, and which of them is the reason for the latest value without a bound. An
/// index of a loss is at least 1; 0 means none.
class BoundLosses {
 public:
  const BoundLoss& operator[](uint32_t index) const { return losses_[index]; }
  /// Divisions by a value that is certainly 0.
  const std::vector<BoundLoss>& zeroDivisions() const { return zeros_; }

  /// Keeps a loss and makes it the latest one, unless there is a latest one already. Beyond the limit of kept losses,
  /// the last kept one stands for it.
  void add(const BoundLoss& loss);
  /// Takes the latest loss; 0 if all values since the last call are bounded.
  uint32_t takeLatest() { return std::exchange(latest_, 0); }
  /// Makes an earlier loss the latest one again, unless it is 0.
  void restoreLatest(uint32_t index) {
    if (index != 0) latest_ = index;
  }

 private:
  std::vector<BoundLoss> losses_ = std::vector<BoundLoss>(1);  ///< index 0 is none
  std::vector<BoundLoss> zeros_;
  uint32_t latest_ = 0;
};

}  // namespace sgm
