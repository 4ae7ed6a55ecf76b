#pragma once
// Shares the workers between planning and meshing, for all worlds of a runtime. Planning comes first, since it decides
// what to mesh, but it must not keep workers from meshing, however often engines update and however many worlds exist.
//
// A world that wants a plan waits for its turn; turns are given in the order of requests. If a worker is idle, the turn
// comes at once. Otherwise a plan must be paid for by earlier meshing: a quarter of the meshing time is credited.
// Elapsed time is credited a little, too, so that planning continues if an engine's job system runs no meshing for a
// while. While there is enough to mesh, planning takes less than a quarter of the workers' time.

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
  /// The share of meshing time that is credited for planning.
  static constexpr double kShare = 0.25;
  /// The share of elapsed time that is credited, but only to reduce debts.
  static constexpr double kTrickle = 0.05;
  /// The maximum credit in seconds.
  static constexpr double kMaxCredit = 0.01;

  /// A world's membership in the turns. The world owns it.
  class Member {
   public:
    /// Begins a plan; does nothing if the world no longer exists. owner: the member below.
    void (*begin)(const std::shared_ptr<void>& owner) noexcept = nullptr;
    std::shared_ptr<void> owner;

   private:
    friend class PlanTurns;
    bool plans_ = false;
    bool is_free_ = false;  ///< a worker was idle when the plan began
    size_t mesh_jobs_ = 0;
    double expected_ = 0.001;  ///< estimated seconds of its next plan: what its last plan took
  };

  /// jobs must outlive this.
  explicit PlanTurns(const JobSystem& jobs) : jobs_(jobs) {}

  /// Adds a member. Throws std::bad_alloc.
  void join(Member& member);
  /// Removes a member and its jobs, and begins plans of members that waited for these workers. Must not run
  /// concurrently with, or be followed by, another call for this member.
  void leave(Member& member) noexcept;

  /// Puts the member in the queue; a call of startDue(), on any thread, will begin its plan. Precondition: the member
  /// is neither waiting nor planning.
  void request(Member& member) noexcept;
  /// Begins the plans whose turn has come. Does nothing if another thread is in this function or inside begin(),
  /// because that call checks again.
  void startDue(Clock::time_point now = Clock::now());
  /// Ends the member's plan. Call it when the plan has ended, or could not begin (seconds = 0).
  void endPlan(Member& member, double seconds) noexcept;

  /// Sets the number of the member's jobs that are meshing or wait for a worker.
  void setMeshJobs(Member& member, size_t count) noexcept;
  /// Credits the time that a job has spent on meshing.
  void earn(double seconds) noexcept;

  double credit() const;  ///< seconds of planning that are paid for; negative: debt

 private:
  /// Credits the time elapsed until `now`. Precondition: the mutex is held.
  void pass(Clock::time_point now);

  const JobSystem& jobs_;
  mutable std::mutex mutex_;      ///< guards the following members, and the private members of Member
  std::vector<Member*> waiting_;  ///< sorted by waiting time, longest first; has capacity for all members
  size_t members_ = 0;
  size_t busy_ = 0;                   ///< number of members' jobs that run or wait for a worker
  double credit_ = 0, expected_ = 0;  ///< credit in seconds; expected total seconds of the plans that are running
  Clock::time_point passed_until_{};
  bool starting_ = false;  ///< true while a thread is in startDue()
};

}  // namespace sgm
