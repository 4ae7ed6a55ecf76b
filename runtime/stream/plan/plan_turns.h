#pragma once
// Shares the workers between planning and meshing, for all worlds of a runtime.
//
// Planning comes first, because it decides what to mesh. But it must not keep workers from meshing, however often
// engines call update and however many worlds exist. A world that needs a plan waits for its turn; turns are given in
// the order of requests. If a worker is idle, a turn is given immediately. Otherwise a plan must be paid for by time
// credit: a quarter of the time that jobs spend on meshing is credited. A small share of elapsed time is credited too,
// so that planning continues if an engine's job system runs no meshing for a while. As long as there is enough to mesh,
// planning takes less than a quarter of the workers' time.

#include <chrono>
#include <memory>
#include <mutex>
#include <vector>

#include "base/jobs.h"

namespace sgm {

/// The scheduler of plans. Thread-safe. Holds no mutex while it calls the worlds' functions.
class PlanTurns {
 public:
  using Clock = std::chrono::steady_clock;
  /// The share of meshing time that is credited for planning.
  static constexpr double kShare = 0.25;
  /// The share of elapsed time that is credited while the credit is less than the expected time of the running plans.
  static constexpr double kTrickle = 0.05;
  /// The maximum credit in seconds that meshing can earn.
  static constexpr double kMaxCredit = 0.01;

  /// A world's entry in the scheduler. The world owns it.
  class Member {
   public:
    /// Begins a plan of the world; does nothing if the world no longer exists. owner: the member `owner` below.
    void (*begin)(const std::shared_ptr<void>& owner) noexcept = nullptr;
    std::shared_ptr<void> owner;

   private:
    friend class PlanTurns;
    bool plans_ = false;
    bool is_free_ = false;  ///< true if a worker was idle when the plan began
    size_t mesh_jobs_ = 0;
    double expected_ = 0.001;  ///< estimated cost of the world's next plan in seconds: the cost of its last plan
  };

  /// jobs: must outlive this object.
  explicit PlanTurns(const JobSystem& jobs) : jobs_(jobs) {}

  /// Adds a world. Throws std::bad_alloc.
  void join(Member& member);
  /// Removes a world, so that its jobs no longer count, and begins plans of other worlds, which may have waited for the
  /// workers of these jobs. Must not run concurrently with another call for this member, and no other call for the
  /// member may follow.
  void leave(Member& member) noexcept;

  /// Adds the world to the queue of those that wait for a plan. A later call of startDue(), on any thread, begins the
  /// plan. Precondition: the world is neither waiting nor planning.
  void request(Member& member) noexcept;
  /// Begins the plans whose turn has come. Returns immediately if another thread is in this function or in begin(),
  /// because that thread checks the queue again.
  void startDue(Clock::time_point now = Clock::now());
  /// Reports that a plan has ended after `seconds`, or could not begin (seconds = 0).
  void endPlan(Member& member, double seconds) noexcept;

  /// Sets the number of the world's mesh jobs that are running or waiting for a worker.
  void setMeshJobs(Member& member, size_t count) noexcept;
  /// Credits the time in seconds that a job has spent on meshing.
  void earn(double seconds) noexcept;

  double credit() const;  ///< Returns the credit: the time in seconds that plans may still take; negative if plans have
                          ///< taken more than was credited.

 private:
  /// Credits the time elapsed until `now`. Precondition: the caller holds mutex_.
  void pass(Clock::time_point now);

  const JobSystem& jobs_;
  mutable std::mutex mutex_;      ///< guards the members below, and the private members of Member
  std::vector<Member*> waiting_;  ///< worlds that wait for a plan, longest first; has capacity for all worlds
  size_t members_ = 0;
  size_t busy_ = 0;                   ///< number of all worlds' jobs that are running or waiting for a worker
  double credit_ = 0, expected_ = 0;  ///< credit in seconds; expected total cost in seconds of the plans that are
                                      ///< running
  Clock::time_point passed_until_{};
  bool starting_ = false;  ///< true while a thread is in startDue()
};

}  // namespace sgm
