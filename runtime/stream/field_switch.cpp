#include "stream/field_switch.h"

#include <algorithm>

namespace sgm {

namespace {

/// Chunks that one job compares: some milliseconds' work where nothing of their cells is known.
constexpr size_t kComparedAtOnce = 64;

}  // namespace

void FieldSwitch::want(std::shared_ptr<const WorldField> next) {
  const std::lock_guard lock(mutex_);
  next_.swap(next);
}

bool FieldSwitch::settled() const {
  const std::lock_guard lock(mutex_);
  return next_ == nullptr && !comparing_ && (!open_ || state_ != 0);
}

bool FieldSwitch::begin(const Progress& progress) {
  const std::lock_guard lock(mutex_);
  if (comparing_) return false;
  if (open_ && state_ != 0) {
    if (progress.viewed && progress.drawn < state_) return false;
    open_ = false;
    const Clock::time_point now = Clock::now();
    not_before_ = now + (now - begun_);
  }
  if (!open_) {
    if (next_ == nullptr || (!progress.at_rest && Clock::now() < not_before_)) return false;
    open_ = true;
    state_ = 0;
    begun_ = Clock::now();
  }
  comparing_ = true;
  return true;
}

void FieldSwitch::giveUp() {
  const std::lock_guard lock(mutex_);
  comparing_ = false;
}

bool FieldSwitch::compare(const std::shared_ptr<const DrawnFrame>& drawn, WorldEdits& edits, JobSystem& jobs) {
  try {
    const bool more = compareSome(*drawn, edits, jobs);
    const std::lock_guard lock(mutex_);
    comparing_ = false;
    return more;
  } catch (const std::bad_alloc&) {
    change_ = nullptr;
    const std::lock_guard lock(mutex_);
    if (next_ == nullptr) next_ = to_;
    comparing_ = open_ = false;
    throw;
  }
}

bool FieldSwitch::compareSome(const DrawnFrame& drawn, WorldEdits& edits, JobSystem& jobs) {
  if (change_ == nullptr) {
    {
      const std::lock_guard lock(mutex_);
      to_ = std::move(next_);
    }
    change_ = std::make_shared<const FieldChange>(edits.state().field, to_);
    left_.clear();
    for (const ChunkKey& leaf : drawn.tree.leaves()) left_.push_back(leaf);
  }
  const size_t some = std::min(left_.size(), kComparedAtOnce);
  const auto keys = std::span(left_).last(some);
  parallelFor(jobs, some, [&](size_t i) { change_->touches(keys[i]); });
  left_.resize(left_.size() - some);
  if (!left_.empty()) return true;
  const uint64_t state = edits.setField(std::move(change_));
  change_ = nullptr;
  to_ = nullptr;
  const std::lock_guard lock(mutex_);
  state_ = state;
  return false;
}

}  // namespace sgm
