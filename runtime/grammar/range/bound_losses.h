#pragma once
// Records where values lose their bounds, for messages.

#include <cstdint>
#include <utility>
#include <vector>

#include "grammar/range/interval.h"
#include "grammar/syntax/program.h"

namespace sgm {

/// An expression whose value has no finite bound although its operands may have.
struct BoundLoss {
  enum class Cause : uint8_t { none, divisor, parameter } cause = Cause::none;
  ExprId expr = kNoId;  ///< the expression without a bound: a division, or the name of an unbounded parameter
  /// if `expr` is in the standard library: the author's call into it (CallPath::writtenCaller); otherwise kNoId
  ExprId caller = kNoId;
  Interval divisor;
};

/// Stores the losses (expressions without a finite bound) found so far, and the latest one, which is the reason for the
/// latest unbounded value. Indices of losses start at 1; 0 means no loss.
class BoundLosses {
 public:
  const BoundLoss& operator[](uint32_t index) const { return losses_[index]; }
  /// divisions whose divisor is certainly 0
  const std::vector<BoundLoss>& zeroDivisions() const { return zeros_; }

  /// Stores a loss and makes it the latest one, unless there is a latest one already. When the list is full, its last
  /// entry is used instead of the new loss. Stores a division by 0 in zeroDivisions() in any case.
  void add(const BoundLoss& loss);
  /// Returns and clears the latest loss; 0 if all values since the last call are bounded.
  uint32_t takeLatest() { return std::exchange(latest_, 0); }
  /// Makes an earlier entry of the list the latest loss again; does nothing for index 0.
  void restoreLatest(uint32_t index) {
    if (index != 0) latest_ = index;
  }

 private:
  std::vector<BoundLoss> losses_ = std::vector<BoundLoss>(1);  ///< [0] is unused, since index 0 means no loss
  std::vector<BoundLoss> zeros_;
  uint32_t latest_ = 0;
};

}  // namespace sgm
