#include "stream/field_switch.h"

#include <algorithm>
#include <utility>

namespace sgm {

namespace {

/// Number of chunks that one job compares. If none of their cells is cached, the comparison takes some milliseconds.
constexpr size_t kComparedAtOnce = 64;

}  // namespace

void FieldSwitch::want(std::shared_ptr<const WorldField> next) {
  const std::lock_guard lock(mutex_);
  next_.swap(next);
  ++turn_.wanted;
}

bool FieldSwitch::settled(bool viewed) const {
  const std::lock_guard lock(mutex_);
  return !comparing_ && (!viewed || (!open_ && next_ == nullptr && back_ == nullptr));
}

bool FieldSwitch::busy() const {
  const std::lock_guard lock(mutex_);
  return comparing_;
}

FieldSwitch::Turn FieldSwitch::turn() const {
  const std::lock_guard lock(mutex_);
  return turn_;
}

bool FieldSwitch::begin(const Progress& progress) {
  const std::lock_guard lock(mutex_);
  if (comparing_ || !progress.viewed) return false;
  if (open_ && state_ != 0) {
    const bool failed = progress.failed >= state_;
    if (progress.drawn < state_ && !failed) return false;
    open_ = false;
    const Clock::time_point now = Clock::now();
    not_before_ = now + (now - begun_);
    if (progress.drawn >= state_) {
      turn_.drawn = turn_begun_;
    } else {
      back_ = before_;
    }
    before_ = nullptr;
  }
  if (!open_) {
    const bool unseen = !progress.shown && turn_.drawn > 0;
    const bool waits = !progress.at_rest && (unseen || Clock::now() < not_before_);
    if (back_ == nullptr && (next_ == nullptr || waits)) return false;
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
    // Memory ran out: the comparison restarts later, with the same field or with the newest field that was requested
    // since. If the world was returning to an earlier field, it still does so before it uses any requested field.
    std::shared_ptr<const WorldField>& again = going_back_ ? back_ : next_;
    if (again == nullptr) again = to_;
    comparing_ = open_ = false;
    throw;
  }
}

bool FieldSwitch::compareSome(const DrawnFrame& drawn, WorldEdits& edits, JobSystem& jobs) {
  if (change_ == nullptr) {
    {
      const std::lock_guard lock(mutex_);
      going_back_ = back_ != nullptr;
      to_ = std::exchange(going_back_ ? back_ : next_, nullptr);
      turn_begun_ = going_back_ ? turn_.drawn : turn_.wanted;
    }
    from_ = edits.state().field;
    change_ = std::make_shared<const FieldChange>(from_, to_, sharp_);
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
  before_ = std::move(from_);
  state_ = state;
  return false;
}

}  // namespace sgm
