#include "stream/plan/plan_turns.h"

#include <algorithm>

namespace sgm {

namespace {

/// In seconds: an upper bound of the rounding error that remains after equal values are added and subtracted.
constexpr double kRounding = 1e-9;

}  // namespace

void PlanTurns::join(Member&) {
  const std::lock_guard lock(mutex_);
  waiting_.reserve(members_ + 1);
  ++members_;
}

void PlanTurns::leave(Member& member) noexcept {
  {
    const std::lock_guard lock(mutex_);
    std::erase(waiting_, &member);
    busy_ -= member.mesh_jobs_ + (member.plans_ ? 1 : 0);
    if (member.plans_) expected_ -= member.expected_;
    --members_;
  }
  // The world that leaves has freed its workers; another world may be waiting for them.
  startDue();
}

void PlanTurns::request(Member& member) noexcept {
  const std::lock_guard lock(mutex_);
  waiting_.push_back(&member);
}

void PlanTurns::startDue(Clock::time_point now) {
  const size_t workers = std::max(2u, jobs_.concurrency()) - 1;
  std::unique_lock lock(mutex_);
  if (starting_) return;
  starting_ = true;
  pass(now);
  while (!waiting_.empty() && (busy_ < workers || credit_ > expected_ - kRounding)) {
    Member& next = *waiting_.front();
    waiting_.erase(waiting_.begin());
    next.plans_ = true;
    next.is_free_ = busy_ < workers;
    ++busy_;
    expected_ += next.expected_;
    // Copy the pointer: `next` may be removed as soon as the mutex is unlocked.
    const std::shared_ptr<void> owner = next.owner;
    const auto begin = next.begin;
    lock.unlock();
    begin(owner);
    lock.lock();
  }
  starting_ = false;
}

void PlanTurns::pass(Clock::time_point now) {
  const double seconds = std::chrono::duration<double>(now - passed_until_).count();
  if (seconds <= 0) return;
  passed_until_ = now;
  // As time passes, the credit grows, but at most to the expected cost of the plans that are running. If the limit were
  // lower and the job system delayed a running plan, this plan would block the plans of other worlds.
  credit_ = std::min(std::max(expected_, credit_), credit_ + kTrickle * seconds);
}

void PlanTurns::endPlan(Member& member, double seconds) noexcept {
  const std::lock_guard lock(mutex_);
  member.plans_ = false;
  --busy_;
  expected_ -= member.expected_;
  if (seconds <= 0) return;
  member.expected_ = seconds;
  // If the plan began because a worker was idle, its cost lowers the credit at most to -seconds.
  credit_ = member.is_free_ ? std::min(credit_, std::max(credit_ - seconds, -seconds)) : credit_ - seconds;
}

void PlanTurns::setMeshJobs(Member& member, size_t count) noexcept {
  const std::lock_guard lock(mutex_);
  busy_ += count - member.mesh_jobs_;
  member.mesh_jobs_ = count;
}

void PlanTurns::earn(double seconds) noexcept {
  const std::lock_guard lock(mutex_);
  credit_ = std::max(credit_, std::min(kMaxCredit, credit_ + kShare * seconds));
}

double PlanTurns::credit() const {
  const std::lock_guard lock(mutex_);
  return credit_;
}

}  // namespace sgm
