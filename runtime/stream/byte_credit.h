#pragma once
// Limits how many bytes of surfaces one update delivers to the engine. Every surface is delivered eventually, however
// small the budgets are.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace sgm {

/// Decides which items an update may deliver. An item is admitted if it fits into the rest of the update's budget, or
/// if it is the first item of an update without debt. In the latter case the item's excess becomes a debt, which
/// reduces the budgets of later updates. Invariant: any series of successive updates admits at most the sum of their
/// budgets plus one item.
class ByteCredit {
 public:
  /// Begins an update with a new budget. The unused rest of the previous budget is lost.
  void begin(size_t budget) {
    constexpr auto kMost = static_cast<size_t>(std::numeric_limits<int64_t>::max());
    // Keeps a debt, but drops an unused rest. So left_ never exceeds one budget, and cannot overflow.
    left_ = std::min<int64_t>(left_, 0) + static_cast<int64_t>(std::min(budget, kMost));
    is_first_ = true;
  }
  bool admits(size_t bytes) const { return left_ > 0 && (is_first_ || bytes <= static_cast<size_t>(left_)); }
  /// Subtracts the size of a delivered item from the budget. Precondition: admits(bytes).
  void take(size_t bytes) {
    left_ -= static_cast<int64_t>(bytes);
    is_first_ = false;
  }

 private:
  int64_t left_ = 0;  ///< bytes left in this update's budget; negative: debt
  bool is_first_ = true;
};

}  // namespace sgm
