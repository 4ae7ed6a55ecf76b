#pragma once
// Shares the workers between planning and meshing, for all worlds of a runtime. Planning comes first, since it decides
// what to mesh, but it must not keep workers from meshing, however often engines update and however many worlds exist.
//
// A world that wants a plan waits for its turn, first come, first served. A turn comes at once if a worker is idle.
// Otherwise a plan must be paid for by earlier meshing: a quarter of that time counts. Elapsed time pays a little, too,
// so that planning continues if an engine's job system runs no meshing for a while. While there is enough to mesh,
// planning takes less than a quarter of the workers' time.

#include <chrono>
#include <memory>
#include <mutex>
#include <vector>

#include "base/jobs.h"

namespace sgm {

/// Thread-safe. Holds no mutex while it calls the caller's functions.
class PlanTurns {
 public:
  using Clock = std::chrono::steady_clock;
  /// The share of meshing time that pays for planning.
  static constexpr double kShare = 0.25;
  /// The share of elapsed time that pays, but only for debts.
  static constexpr double kTrickle = 0.05;
  /// The most credit, in seconds, that can accumulate.
  static constexpr double kMostCredit = 0.01;

  /// A world's membership, owned by the world.
  class Member {
   public:
    /// Begins a plan; does nothing if the owner has ended.
    void (*begin)(const std::shared_ptr<void>& owner) noexcept = nullptr;
    std::shared_ptr<void> owner;

   private:
    friend class PlanTurns;
    bool plans_ = false;
    bool is_free_ = false;  ///< a worker was idle when the plan began
    size_t mesh_jobs_ = 0;
    double expected_ = 0.001;  ///< seconds that its last plan took
  };

  /// jobs must outlive this.
  explicit PlanTurns(const JobSystem& jobs) : jobs_(jobs) {}

  /// Throws std::bad_alloc.
  void join(Member& member);
  /// Subtracts the member's jobs, and begins the plans of members that waited for those workers. No other call for the
  /// member may run concurrently or follow.
  void leave(Member& member) noexcept;

  /// The member waits until startDue(), called by any thread, begins its plan. Precondition: it neither waits nor
  /// plans.
  void request(Member& member) noexcept;
  /// Begins plans whose turn has come. If another thread is in this call, or within begin(), it does nothing, since the
  /// running call checks again.
  void startDue(Clock::time_point now = Clock::now());
  /// Call when the plan has ended, or could not begin (0 seconds).
  void endPlan(Member& member, double seconds) noexcept;

  /// Sets how many of the member's jobs are meshing or wait for a worker.
  void setMeshJobs(Member& member, size_t count) noexcept;
  /// Adds the time that a job has meshed.
  void earn(double seconds) noexcept;

  double credit() const;  ///< seconds of planning that are paid for; negative: debt

 private:
  /// Precondition: the mutex is held.
  void pass(Clock::time_point now);

  const JobSystem& jobs_;
  mutable std::mutex mutex_;      ///< guards the following, and the private part of members
  std::vector<Member*> waiting_;  ///< longest waiting first; has capacity for all
  size_t members_ = 0;
  size_t busy_ = 0;                   ///< jobs of members that run or wait for a worker
  double credit_ = 0, expected_ = 0;  ///< expected_: the expected seconds of running plans
  Clock::time_point passed_until_{};
  bool starting_ = false;  ///< a thread is in startDue()
};

}  // namespace sgm
