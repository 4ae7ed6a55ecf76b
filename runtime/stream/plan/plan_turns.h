#pragma once
// How all worlds of a runtime share the workers between planning and meshing: planning comes first, as it decides what
// to mesh, but must not keep the workers from meshing, however often engines update and however many worlds there are.
//
// A world that wants a plan waits for its turn, first come, first served. A turn comes at once while a worker has
// nothing to do. Otherwise each plan is paid for by what was meshed before: a quarter of that time. Time that passes
// pays a little, too, so that planning goes on where an engine's job system lets nothing be meshed for a while.
// Together planning takes less than a quarter of the workers' time while there is enough to mesh.

#include <chrono>
#include <memory>
#include <mutex>
#include <vector>

#include "base/jobs.h"

namespace sgm {

/// Thread-safe. Calls nothing of the caller's while it holds its mutex.
class PlanTurns {
 public:
  using Clock = std::chrono::steady_clock;
  /// Of the time that jobs meshed.
  static constexpr double kShare = 0.25;
  /// Of the time that passes, which pays debts and nothing more.
  static constexpr double kTrickle = 0.05;
  /// Seconds: who plans little gathers no more than this.
  static constexpr double kMostCredit = 0.01;

  /// A world's place, which the world owns.
  class Member {
   public:
    /// Begins a plan, or does nothing where the owner has ended.
    void (*begin)(const std::shared_ptr<void>& owner) noexcept = nullptr;
    std::shared_ptr<void> owner;

   private:
    friend class PlanTurns;
    bool plans_ = false;
    bool is_free_ = false;  ///< a worker had nothing to do when it began
    size_t mesh_jobs_ = 0;
    double expected_ = 0.001;  ///< seconds: what its last plan took
  };

  /// jobs must outlive this.
  explicit PlanTurns(const JobSystem& jobs) : jobs_(jobs) {}

  /// Throws std::bad_alloc.
  void join(Member& member);
  /// Takes the member's jobs off the count, and begins the plans of other members that waited for those workers. No
  /// other call for the member may run or follow.
  void leave(Member& member) noexcept;

  /// From now on the member waits until startDue(), called by anyone, begins its plan. Precondition: it neither waits
  /// nor plans.
  void request(Member& member) noexcept;
  /// Begins plans whose turn has come. One thread does at one time; to others, and within begin(), this does nothing,
  /// as that thread looks again.
  void startDue(Clock::time_point now = Clock::now());
  /// The plan that was begun has ended, or never began (0 seconds).
  void endPlan(Member& member, double seconds) noexcept;

  /// How many of the member's jobs mesh, or wait for a worker to do so.
  void setMeshJobs(Member& member, size_t count) noexcept;
  /// A job has meshed for so long.
  void earn(double seconds) noexcept;

  double credit() const;  ///< seconds of planning that are paid for; below 0: owed

 private:
  /// Precondition: the mutex is held.
  void pass(Clock::time_point now);

  const JobSystem& jobs_;
  mutable std::mutex mutex_;      ///< guards what follows, and what is private of members
  std::vector<Member*> waiting_;  ///< who has waited longest first; there is room for all
  size_t members_ = 0;
  size_t busy_ = 0;                   ///< jobs of members that work, or wait for a worker
  double credit_ = 0, expected_ = 0;  ///< expected_: what plans that have begun will take
  Clock::time_point passed_until_{};
  bool starting_ = false;  ///< a thread is in startDue()
};

}  // namespace sgm
