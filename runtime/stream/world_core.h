#pragma once
// The part of a streamed world that the world shares with its jobs (world.h): a mailbox behind one mutex, a planning
// job, and meshing jobs. If chunks may come from a server, threads of the world (lookers) fetch them, so that no job
// waits for a server.
//
// Jobs may start late, so they own only a gate, which closes when the world is destroyed. No job takes longer than one
// plan, one chunk or one device batch, so that the engine's own jobs are not delayed. world_core.cpp contains planning
// and occasional work, world_meshing.cpp meshing and prefetching.

#include <algorithm>
#include <array>
#include <chrono>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <thread>
#include <vector>

#include "backend/backend.h"
#include "chunk/world_measures.h"
#include "stream/edits/world_edits.h"
#include "stream/field_switch.h"
#include "stream/make/chunk_cache.h"
#include "stream/make/collider.h"
#include "stream/make/surface_pool.h"
#include "stream/plan/plan_turns.h"
#include "stream/plan/planner.h"
#include "stream/plan/work_queue.h"
#include "stream/world_settings.h"
#include "stream/world_times.h"
#include "world/world_field.h"

namespace sgm {

/// Returns the maximum size of a chunk in bytes: every cell is cut in the worst way, and there are six seams. Texture
/// coordinates double it, as do sharp features in every second cell; a chunk with more features fails.
inline size_t largestChunk(const WorldSettings& settings) {
  return size_t{5} << (20 + (settings.texture ? 1 : 0) + (settings.sharp ? 1 : 0));
}

class WorldCore {
 public:
  static constexpr unsigned kPrefetchers = 4;

  /// lookers: threads that may wait for a server; null: all stores are nearby. turns: shared by all worlds on these
  /// jobs.
  WorldCore(std::shared_ptr<const WorldField> field, Backend& backend, JobSystem& jobs,
            std::shared_ptr<PlanTurns> turns, const WorldSettings& settings, std::unique_ptr<JobSystem> prefetchers,
            std::pmr::memory_resource* memory);
  ~WorldCore() { turns_->leave(turn_); }
  WorldCore(const WorldCore&) = delete;
  WorldCore& operator=(const WorldCore&) = delete;

  /// Schedules planning at the world's turn (plan_turns.h). If a plan is running, another one follows.
  void schedulePlanner();
  /// True if a plan would have new input.
  bool planIsDue() const;
  /// Begins plans of any world whose turn has come.
  void startDuePlans() { turns_->startDue(); }
  /// Schedules a write of the journal, unless the last one was less than kBetweenFlushes ago.
  void scheduleJournal();
  /// Schedules the switch to the next requested field, if its turn has come.
  void scheduleFieldSwitch();
  /// Schedules meshing of requests that have waited too long for their prefetch.
  void scheduleOverdue();
  /// Waits for running jobs, after which no job accesses the core. Writes the journal. Call once, before destruction.
  void stop() noexcept;

  /// True if all that the current viewers need is drawn, including edits. Precondition: the mutex is held.
  bool settled() const;
  /// True if a plan or a chunk is being made. Precondition: the mutex is held.
  bool atWork() const { return planning_ || mesh_jobs > 0 || isLooking(); }
  /// True if all planned requests are being prefetched or wait for a prefetch. Precondition: the mutex is held.
  bool isLooking() const;

  const Profiler profiler;  ///< the profiler of the world's first field
  Backend& backend;
  JobSystem& jobs;
  const WorldSettings settings;
  WorldEdits edits;
  FieldSwitch fields;
  std::unique_ptr<DiskCache> cache;  ///< null: no cache; set before the first job starts

  mutable std::mutex mutex;  ///< guards the following members; held for short work only
  std::condition_variable changed;
  std::vector<Viewer> viewers;
  uint64_t viewers_set = 0;  ///< number of changes of the viewers
  WorkQueue queue;
  std::vector<FailedChunk> failed;
  std::vector<ColliderChange> collider_changes;  ///< in the order in which they must be reported
  std::shared_ptr<const FrameStep> step;
  std::array<uint64_t, 2> in_hand{};  ///< same as PlanInput::in_hand
  uint64_t applied = 0;
  std::shared_ptr<const DrawnFrame> drawn;  ///< the frame with the number `applied`
  uint64_t edits_drawn = 0;                 ///< number of the state that `drawn` shows
  /// number of the current generation of requests; results of earlier generations are dropped
  uint64_t generation = 0;
  uint64_t plans = 0;
  size_t mesh_jobs = 0;           ///< number of mesh jobs submitted or running
  bool is_out_of_memory = false;  ///< true if memory ran out, and no chunk could be made since
  PlannerStats planner_stats;
  MadeMeasures made;  ///< measures of finished work, if the settings request them
  WorldTimes times;
  size_t collider_bytes = 0;

  struct Work {
    size_t queued = 0, in_work = 0;
    size_t stale = 0;  ///< number of these that were planned for previous viewers
  };
  /// Returns the amount of work. Precondition: the mutex is held.
  Work work() const;
  /// Adds the time until now to times.clock_seconds and times.job_seconds. Precondition: the mutex is held.
  void countWork();
  const SurfacePool& surfaces() const { return *surfaces_; }

 private:
  using Clock = std::chrono::steady_clock;
  /// Short enough that a std::string needs no allocation for it.
  static constexpr const char* kOutOfMemory = "out of memory";

  /// The maximum number of mesh jobs. A device that meshes batches needs few: one job prepares its chunks, one finishes
  /// them.
  size_t maxMeshJobs() const {
    const size_t most = std::max(1u, jobs.concurrency() - 1);
    return backend.batch() > 1 ? std::min<size_t>(most, 3) : most;
  }
  /// Returns the bytes of the limit that are neither used nor reserved by jobs.
  size_t room() const {
    const size_t used = surfaces_->bytes() + planner_stats.record_bytes + collider_bytes + reserved_;
    return settings.mesh_bytes - std::min(settings.mesh_bytes, used);
  }
  bool hasRoom() const { return room() >= largestChunk(settings); }
  /// True if more requests may be prefetched: not while too little memory is free for one chunk, regardless of
  /// reservations.
  bool mayPrefetch() const {
    return !is_out_of_memory && settings.mesh_bytes >= surfaces_->bytes() + planner_stats.record_bytes +
                                                           collider_bytes + largestChunk(settings);
  }
  /// True if jobs could mesh requests that have waited too long for their prefetch.
  bool isOverdue() const;

  /// The object that jobs own instead of the core.
  struct JobGate {
    explicit JobGate(WorldCore& core_in) : core(core_in) {}
    /// Delays the end of the core until leave(). Returns false if the core has ended.
    bool enter() noexcept;
    void leave() noexcept;

    WorldCore& core;
    std::mutex mutex;  ///< guards the following members
    std::condition_variable ended;
    bool closed = false;  ///< true if the core has ended or is about to
    size_t running = 0;   ///< number of running jobs
  };

  /// Submits a job. Returns false if memory runs out.
  bool submit(JobSystem& to, void (*function)(void*), int priority) noexcept;
  bool submit(void (*function)(void*), int priority) noexcept { return submit(jobs, function, priority); }
  /// Called when it is the world's turn to plan. owner: the world's gate.
  static void beginPlan(const std::shared_ptr<void>& owner) noexcept;
  /// Precondition: the mutex is held.
  void setMeshJobs(size_t count) { turns_->setMeshJobs(turn_, mesh_jobs = count); }
  void scheduleMeshing();
  /// Starts lookers if fewer are running than there are requests to prefetch.
  void schedulePrefetch();
  PlanInput planInput();
  void publish(Plan&& plan);
  void resetPlanner();
  /// Returns the frame from which the planner must restart; null if it need not.
  std::shared_ptr<const DrawnFrame> frameToRestartFrom();
  /// Makes and publishes a plan. Returns false if memory ran out.
  bool makePlan();
  void planOnce();
  void makeColliders();
  /// The work of a looker: prefetches requests as long as there are any.
  void prefetch();
  ChunkMesher mesherOf(const WorldState& under) const;
  void meshOnce();
  void meshAgain();
  /// Ends a mesh job that submits no successor.
  void endMeshJob();
  /// Calls `job`, which submits another job of the same kind. Some job systems run a submitted job at once, inside the
  /// call: then isResubmitting() is true in it and it does nothing, so that no call does more than one job's work. Does
  /// nothing if memory runs out.
  template <class Submit>
  void resubmit(const Submit& job);
  /// True if this thread is inside resubmit(). Precondition: the mutex is held.
  bool isResubmitting() const;
  /// Takes as many items of the queue as one job meshes, at most `batch`; the vector has capacity for them.
  /// Precondition: the mutex is held.
  void takeItems(size_t batch, std::vector<WorkItem>& items);
  void surfaceOne(Result<MeshedChunk>& chunk, const WorldState& under, FinishedChunk& done) const;
  /// Meshes the items, and returns their measures.
  MadeMeasures meshItems(std::span<const WorkItem> items, const WorldState& under, const Progress& progress,
                         std::span<FinishedChunk> done) const;
  void flushOnce();
  void compareOnce();
  /// Reports that memory ran out. The next update tries again, with a single job at first.
  void reportOutOfMemory() noexcept;
  /// Sends a warning. Thread-safe, takes no lock.
  void warn(const char* message) const noexcept;

  /// The entry point of jobs; does nothing if the gate is closed.
  template <void (WorldCore::*work)()>
  static void run(void* argument) noexcept;

  std::pmr::memory_resource* memory_;
  const std::unique_ptr<JobSystem> prefetchers_;  ///< null: no store is on a server
  const std::shared_ptr<JobGate> gate_;
  const std::shared_ptr<PlanTurns> turns_;
  PlanTurns::Member turn_;
  std::shared_ptr<SurfacePool> surfaces_;
  const std::unique_ptr<MeasuringPool> measuring_;  ///< null: measures are not requested
  Planner planner_;                                 ///< used by the planning job only, of which at most one runs
  Colliders colliders_;                             ///< also used by the planning job only

  // The following members are guarded by the mutex.
  bool out_of_memory_reported_ = false;  ///< true if low memory was reported since the world was last at rest
  bool passed_over_ = false;             ///< true if memory ran out for a chunk since the last plan
  bool planner_lost_ = false;            ///< true if memory ran out during planning
  struct Seen {
    uint64_t viewers = 0, applied = 0, edits = 0;
  };
  Seen planning_with_, planned_with_;  ///< input of the plan in progress, and of the published plan
  WorldState queue_edits_;             ///< the state under which the queue must be meshed
  std::vector<ChunkKey> begun_;
  std::vector<FinishedChunk> finished_;
  /// number of requests in work when the plan for the current viewers was published, minus those that have ended since
  size_t meshing_before_ = 0;
  size_t meshing_ = 0;       ///< number of requests in work
  size_t meshing_jobs_ = 0;  ///< number of jobs that mesh these requests
  /// countWork() is called before each change of meshing_jobs_
  Clock::time_point counted_at_ = Clock::now();
  std::array<size_t, WorkItem::kRanks> meshing_of_rank_{};  ///< number of requests in work, by WorkItem::Rank
  /// the maximum number of bytes that the requests in work may need
  size_t reserved_ = 0;
  size_t look_jobs_ = 0;                     ///< number of lookers that run or are about to
  std::vector<std::thread::id> submitting_;  ///< threads that are inside resubmit()
  /// true if a plan waits for its turn, is submitted or is running
  bool planning_ = false;
  bool plan_again_ = false;
  bool flushing_ = false;  ///< true if a write of the journal is submitted or running
  bool stopped_ = false;
  bool idle_ = false;
  bool colliders_done_ = true;
  Clock::time_point next_flush_;
  bool flush_failed_ = false;
};

template <void (WorldCore::*work)()>
void WorldCore::run(void* argument) noexcept {
  const std::unique_ptr<std::shared_ptr<JobGate>> owner(static_cast<std::shared_ptr<JobGate>*>(argument));
  JobGate& gate = **owner;
  if (!gate.enter()) return;
  (gate.core.*work)();
  gate.leave();
}

template <class Submit>
void WorldCore::resubmit(const Submit& job) {
  const std::thread::id self = std::this_thread::get_id();
  try {
    const std::lock_guard lock(mutex);
    submitting_.push_back(self);
  } catch (const std::bad_alloc&) {
    return;
  }
  job();
  const std::lock_guard lock(mutex);
  submitting_.erase(std::find(submitting_.begin(), submitting_.end(), self));
}

}  // namespace sgm
