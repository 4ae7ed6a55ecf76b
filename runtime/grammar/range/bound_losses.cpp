#include "grammar/range/bound_losses.h"

namespace sgm {

void BoundLosses::add(const BoundLoss& loss) {
  constexpr size_t kMaxKept = 256;
  const bool zero = loss.cause == BoundLoss::Cause::divisor && loss.divisor == Interval{0, 0};
  if (zero && zeros_.size() < kMaxKept) zeros_.push_back(loss);
  if (latest_ != 0) return;
  if (losses_.size() < kMaxKept) losses_.push_back(loss);
  latest_ = static_cast<uint32_t>(losses_.size() - 1);
}

}  // namespace sgm
