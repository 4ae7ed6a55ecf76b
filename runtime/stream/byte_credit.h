#pragma once
// How many bytes an update may hand over. Whatever is to be handed over gets its turn, however small the budgets are.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace sgm {

/// Law: any updates in a row hand over at most the sum of their budgets, and one item. An item passes where it fits
/// into what is left, or as the first of an update that owes nothing; what is then too much is owed by the next ones.
class ByteCredit {
 public:
  /// Of an update. What the one before left is lost.
  void begin(size_t budget) {
    constexpr auto kMost = static_cast<size_t>(std::numeric_limits<int64_t>::max());
    // Never above the budget: so it cannot overflow.
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
  int64_t left_ = 0;  ///< below 0: owed
  bool is_first_ = true;
};

}  // namespace sgm
