#pragma once
// The part of a streamed world that its jobs share with the engine's thread (world.h): data behind one mutex, a
// planning job, and meshing jobs. If chunks may come from a server, prefetching threads of the world load them, so that
// no job waits for a server.
//
// A job system may run a job late, after the world is destroyed. So jobs own only a gate, which is closed when the
// world is destroyed. No job takes longer than one plan, one chunk or one device batch, so that the engine's own jobs
// are not delayed.
//
// world_core.cpp contains planning and occasional work, world_meshing.cpp meshing and prefetching.

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

/// Returns the maximum size of a chunk's surface in bytes: the size if every cell has the largest number of triangles
/// and there are six seams. Texture coordinates double this size. So do sharp features, if every second cell has one; a
/// chunk with more of them fails.
inline size_t largestChunk(const WorldSettings& settings) {
  return size_t{5} << (20 + (settings.texture ? 1 : 0) + (settings.sharp ? 1 : 0));
}

class WorldCore {
 public:
  static constexpr unsigned kPrefetchers = 4;

  /// prefetchers: threads that may wait for a server; null: all stores are on this machine. turns: the scheduler of
  /// plans, shared by all worlds that use this job system.
  WorldCore(std::shared_ptr<const WorldField> field, Backend& backend, JobSystem& jobs,
            std::shared_ptr<PlanTurns> turns, const WorldSettings& settings, std::unique_ptr<JobSystem> prefetchers,
            std::pmr::memory_resource* memory);
  ~WorldCore() { turns_->leave(turn_); }
  WorldCore(const WorldCore&) = delete;
  WorldCore& operator=(const WorldCore&) = delete;

  /// Requests a plan, which begins when it is the world's turn (plan_turns.h). If a plan is already running, another
  /// plan follows it.
  void schedulePlanner();
  /// True if there is new input for a plan.
  bool planIsDue() const;
  /// Begins the plans of all worlds whose turn has come.
  void startDuePlans() { turns_->startDue(); }
  /// Submits a job that writes the journal, unless the last write was less than kBetweenFlushes ago.
  void scheduleJournal();
  /// Submits a job for the switch to the next requested field, if its turn has come.
  void scheduleFieldSwitch();
  /// Submits meshing jobs for requests that have waited too long for their prefetch.
  void scheduleOverdue();
  /// Closes the JobGate, so that no further job begins to use the core, and waits for running jobs; afterwards no job
  /// accesses the core. Then writes the journal. Call it once, before destruction.
  void stop() noexcept;

  /// True if everything that the current viewers need is drawn, including edits. Precondition: the caller holds the
  /// mutex.
  bool settled() const;
  /// True if a plan or a chunk is in progress. Precondition: the caller holds the mutex.
  bool atWork() const { return planning_ || mesh_jobs > 0 || isLooking(); }
  /// True if requests are planned, and all of them are being prefetched or wait for a prefetch. Precondition: the
  /// caller holds the mutex.
  bool isLooking() const;

  const Profiler profiler;  ///< profiler of the world's first field
  Backend& backend;
  JobSystem& jobs;
  const WorldSettings settings;
  WorldEdits edits;
  FieldSwitch fields;
  std::unique_ptr<DiskCache> cache;  ///< disk cache, set before the first job starts; null: none

  mutable std::mutex mutex;  ///< guards the members below; held only briefly
  std::condition_variable changed;
  std::vector<Viewer> viewers;
  uint64_t viewers_set = 0;  ///< number of times that the viewers were set
  WorkQueue queue;
  std::vector<FailedChunk> failed;
  std::vector<ColliderChange> collider_changes;  ///< pending collider changes, in the order in which they must be
                                                 ///< delivered
  std::shared_ptr<const FrameStep> step;
  std::array<uint64_t, 2> in_hand{};  ///< numbers of frames that the engine may still draw (PlanInput::in_hand)
  uint64_t applied = 0;
  std::shared_ptr<const DrawnFrame> drawn;  ///< the frame with the number `applied`
  uint64_t edits_drawn = 0;                 ///< number of the world state that `drawn` shows
  /// number that identifies the current queue of requests; cancel() increases it, and results with an older number are
  /// dropped
  uint64_t generation = 0;
  uint64_t plans = 0;
  size_t mesh_jobs = 0;           ///< number of mesh jobs that are submitted or running
  bool is_out_of_memory = false;  ///< true if memory ran out, and no chunk was meshed since
  PlannerStats planner_stats;
  MadeMeasures made;  ///< sums of the measures of finished work, if the settings request them
  WorldTimes times;
  size_t collider_bytes = 0;

  struct Work {
    size_t queued = 0, in_work = 0;
    size_t stale = 0;  ///< number of queued and running requests that were planned before the viewers were last set
  };
  /// Returns the current amount of work. Precondition: the caller holds the mutex.
  Work work() const;
  /// Adds the time until now to times.clock_seconds and times.job_seconds. Precondition: the caller holds the mutex.
  void countWork();
  const SurfacePool& surfaces() const { return *surfaces_; }

 private:
  using Clock = std::chrono::steady_clock;
  /// An error message that is short enough for a std::string without allocation.
  static constexpr const char* kOutOfMemory = "out of memory";

  /// Maximum number of mesh jobs. A device that meshes batches needs only a few, so that one job prepares a batch while
  /// another finishes one.
  size_t maxMeshJobs() const {
    const size_t most = std::max(1u, jobs.concurrency() - 1);
    return backend.batch() > 1 ? std::min<size_t>(most, 3) : most;
  }
  /// Returns how many bytes of the limit mesh_bytes are neither used nor reserved by jobs.
  size_t room() const {
    const size_t used = surfaces_->bytes() + planner_stats.record_bytes + collider_bytes + reserved_;
    return settings.mesh_bytes - std::min(settings.mesh_bytes, used);
  }
  bool hasRoom() const { return room() >= largestChunk(settings); }
  /// True if more requests may be prefetched: there must be memory for one chunk, regardless of the bytes that jobs
  /// have reserved.
  bool mayPrefetch() const {
    return !is_out_of_memory && settings.mesh_bytes >= surfaces_->bytes() + planner_stats.record_bytes +
                                                           collider_bytes + largestChunk(settings);
  }
  /// True if there are requests that have waited too long for their prefetch, and jobs may mesh them now.
  bool isOverdue() const;

  /// The object that jobs own instead of the core. It tells whether the core still exists.
  struct JobGate {
    explicit JobGate(WorldCore& core_in) : core(core_in) {}
    /// Keeps the core alive until leave() is called. Returns false if the core is already closed.
    bool enter() noexcept;
    void leave() noexcept;

    WorldCore& core;
    std::mutex mutex;  ///< guards the members below
    std::condition_variable ended;
    bool closed = false;  ///< true if the core is destroyed or is being destroyed
    size_t running = 0;   ///< number of running jobs of the core
  };

  /// Submits a job. Returns false if there is no memory for it.
  bool submit(JobSystem& to, void (*function)(void*), int priority) noexcept;
  bool submit(void (*function)(void*), int priority) noexcept { return submit(jobs, function, priority); }
  /// Submits the planning job; called when it is the world's turn to plan. owner: the world's JobGate.
  static void beginPlan(const std::shared_ptr<void>& owner) noexcept;
  /// Sets the number of mesh jobs. Precondition: the caller holds the mutex.
  void setMeshJobs(size_t count) { turns_->setMeshJobs(turn_, mesh_jobs = count); }
  void scheduleMeshing();
  /// Submits prefetching jobs to prefetchers_, as long as there are more requests to prefetch than jobs that wait to
  /// begin, but at most kPrefetchers jobs at a time.
  void schedulePrefetch();
  PlanInput planInput();
  void publish(Plan&& plan);
  void resetPlanner();
  /// Returns the frame from which the planner must restart; null if no restart is needed.
  std::shared_ptr<const DrawnFrame> frameToRestartFrom();
  /// Makes a plan and publishes it. Returns false if the planner must restart, for example because memory ran out.
  bool makePlan();
  void planOnce();
  void makeColliders();
  /// A prefetching job: prefetches requests, one after another, as long as there are any.
  void prefetch();
  ChunkMesher mesherOf(const WorldState& under) const;
  void meshOnce();
  void meshAgain();
  /// Ends a mesh job that does not submit another one.
  void endMeshJob();
  /// Calls `job`, which submits another job of the same kind. Some job systems run a submitted job immediately, inside
  /// submit(). In such a nested job isResubmitting() is true, and the job does nothing, so that the nesting depth stays
  /// limited. If memory runs out, `job` is not called.
  template <class Submit>
  void resubmit(const Submit& job);
  /// True if this thread is inside resubmit(). Precondition: the caller holds the mutex.
  bool isResubmitting() const;
  /// Moves as many requests from the queue to `items` as one job meshes, at most `batch`; the vector must have this
  /// capacity. Precondition: the caller holds the mutex.
  void takeItems(size_t batch, std::vector<WorkItem>& items);
  void surfaceOne(Result<MeshedChunk>& chunk, const WorldState& under, FinishedChunk& done) const;
  /// Meshes the requests into `done`, and returns their measures.
  MadeMeasures meshItems(std::span<const WorkItem> items, const WorldState& under, const Progress& progress,
                         std::span<FinishedChunk> done) const;
  void flushOnce();
  void compareOnce();
  /// Warns that memory ran out. The next update tries again, at first with a single job.
  void reportOutOfMemory() noexcept;
  /// Passes a warning to the settings' callback. Thread-safe, takes no lock.
  void warn(const char* message) const noexcept;

  /// The function that the job system calls for a job. Does nothing if the JobGate is closed, that is, if the core is
  /// destroyed or is being destroyed.
  template <void (WorldCore::*work)()>
  static void run(void* argument) noexcept;

  std::pmr::memory_resource* memory_;
  const std::unique_ptr<JobSystem> prefetchers_;  ///< threads that prefetch from servers; null: no store is on a server
  const std::shared_ptr<JobGate> gate_;
  const std::shared_ptr<PlanTurns> turns_;
  PlanTurns::Member turn_;
  std::shared_ptr<SurfacePool> surfaces_;
  const std::unique_ptr<MeasuringPool> measuring_;  ///< buffers for measuring; null: measures are not requested
  Planner planner_;                                 ///< used only by the planning job, of which at most one runs
  Colliders colliders_;                             ///< used only by the planning job

  // The members below are guarded by the mutex.
  bool out_of_memory_reported_ = false;  ///< true if low memory was already reported since the world was last idle
  bool passed_over_ = false;             ///< true if memory ran out for a chunk since the last plan; less urgent chunks
                                         ///< may still succeed
  bool planner_lost_ = false;            ///< true if the planner must restart, for example because memory ran out
                                         ///< during planning
  struct Seen {
    uint64_t viewers = 0, applied = 0, edits = 0;
  };
  Seen planning_with_, planned_with_;  ///< input of the last plan that was begun, and input of the last plan that was
                                       ///< published
  WorldState queue_edits_;             ///< the world state from which the queue must be meshed
  std::vector<ChunkKey> begun_;
  std::vector<FinishedChunk> finished_;
  /// number of unfinished requests whose meshing began before the plan for the current viewers was published
  size_t meshing_before_ = 0;
  size_t meshing_ = 0;       ///< number of requests that are being meshed
  size_t meshing_jobs_ = 0;  ///< number of jobs that are meshing
  /// time of the last countWork(), which is called before each change of meshing_jobs_
  Clock::time_point counted_at_ = Clock::now();
  std::array<size_t, WorkItem::kRanks> meshing_of_rank_{};  ///< number of requests that are being meshed, by
                                                            ///< WorkItem::Rank
  /// maximum number of bytes that the requests in progress may need
  size_t reserved_ = 0;
  size_t look_jobs_ = 0;                     ///< number of prefetching jobs that are submitted or running
  std::vector<std::thread::id> submitting_;  ///< ids of threads that are inside resubmit()
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
