#pragma once
// Limits the bytes of surfaces that one update passes to the engine. Every item passes eventually, however small the
// budgets are.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace sgm {

/// Invariant: any series of successive updates passes at most the sum of their budgets plus one item. An item passes if
/// it fits the rest of the budget, or if it is the first item of an update without debt; its excess becomes a debt of
/// later updates.
class ByteCredit {
 public:
  /// Begins an update. The unused rest of the previous update's budget is lost.
  void begin(size_t budget) {
    constexpr auto kMost = static_cast<size_t>(std::numeric_limits<int64_t>::max());
    // The rest never exceeds the budget, so it cannot overflow.
    left_ = std::min<int64_t>(left_, 0) + static_cast<int64_t>(std::min(budget, kMost));
    is_first_ = true;
  }
  bool admits(size_t bytes) const { return left_ > 0 && (is_first_ || bytes <= static_cast<size_t>(left_)); }
  /// Precondition: admits(bytes).
  void take(size_t bytes) {
    left_ -= static_cast<int64_t>(bytes);
    is_first_ = false;
  }

 private:
  int64_t left_ = 0;  ///< bytes left in this update; negative: debt
  bool is_first_ = true;
};

}  // namespace sgm
