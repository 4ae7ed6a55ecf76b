#include "store/outage.h"

#include <algorithm>
#include <utility>

namespace sgm::store {

Outage::Look Outage::look(Clock::time_point now) {
  const std::lock_guard lock(mutex_);
  if (!is_away_) return Look::there;
  if (is_asked_ || now < until_) return Look::away;
  is_asked_ = true;
  return Look::find_out;
}

bool Outage::failed(Clock::time_point begun, Clock::time_point now) {
  const std::lock_guard lock(mutex_);
  // The request began before the last failure became known, so it failed in the same outage, and does not lengthen the
  // delay.
  if (is_away_ && begun <= failed_at_) return false;
  const bool is_new = !is_away_;
  const bool goes_on = rest_.count() != 0 && (!is_new || now - answered_at_ < kLongestRest);
  rest_ = goes_on ? std::min(2 * rest_, kLongestRest) : kFirstRest;
  is_away_ = true;
  is_asked_ = false;
  failed_at_ = now;
  until_ = now + rest_;
  if (!is_new || (was_ever_told_ && now - told_at_ < kLongestRest)) return false;
  is_told_ = was_ever_told_ = true;
  told_at_ = now;
  return true;
}

bool Outage::answered(Clock::time_point begun, Clock::time_point now) {
  const std::lock_guard lock(mutex_);
  // The request began before the last failure became known, so its answer does not show that the server works again.
  if (!is_away_ || begun <= failed_at_) return false;
  is_away_ = is_asked_ = false;
  answered_at_ = now;
  return std::exchange(is_told_, false);
}

void Outage::gaveUp() {
  const std::lock_guard lock(mutex_);
  is_asked_ = false;
}

}  // namespace sgm::store
