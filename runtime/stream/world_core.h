#pragma once
// The shared part of a streamed world and its jobs (world.h): a mailbox behind one mutex, a planning job, and meshing
// jobs. If chunks may come from a server, the world's own threads fetch them: no job waits for a server.
//
// Jobs may start late: they own only a gate, which closes when the world ends. No job takes longer than one plan, one
// chunk or one device batch, so that the engine's own jobs get their turn. world_core.cpp has planning and occasional
// work, world_meshing.cpp has meshing and prefetching.

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

/// The largest size of a chunk in bytes: every cell cut in the worst way, with six seams. Texture coordinates double
/// it; so do sharp features in every second cell, and a chunk with more of them fails.
inline size_t largestChunk(const WorldSettings& settings) {
  return size_t{5} << (20 + (settings.texture ? 1 : 0) + (settings.sharp ? 1 : 0));
}

class WorldCore {
 public:
  static constexpr unsigned kLookers = 4;

  /// lookers: threads that may wait for a server; null: all baked parts are near. turns: shared by all worlds on these
  /// jobs.
  WorldCore(std::shared_ptr<const WorldField> field, Backend& backend, JobSystem& jobs,
            std::shared_ptr<PlanTurns> turns, const WorldSettings& settings, std::unique_ptr<JobSystem> lookers,
            std::pmr::memory_resource* memory);
  ~WorldCore() { turns_->leave(turn_); }
  WorldCore(const WorldCore&) = delete;
  WorldCore& operator=(const WorldCore&) = delete;

  /// Schedules planning for the world's turn (plan_turns.h); if it is running, one more run.
  void kickPlanner();
  /// Whether a plan would have new input.
  bool planIsDue() const;
  /// Starts plans whose turn has come, of any world.
  void startDuePlans() { turns_->startDue(); }
  /// Schedules a write of the journal, at most every kBetweenFlushes.
  void kickJournal();
  /// Schedules the switch to the next requested field, when its turn comes.
  void kickFieldSwitch();
  /// Schedules meshing of requests whose prefetch has taken too long.
  void kickOverdue();
  /// Waits for running jobs; no others will touch the core. Writes the journal. Call once, before destruction.
  void stop() noexcept;

  /// Whether everything that the current viewers want is drawn, edits included. Precondition: the mutex is held.
  bool settled() const;
  /// Whether a plan or a chunk is being made. Precondition: the mutex is held.
  bool atWork() const { return planning_ || mesh_jobs > 0 || isLooking(); }
  /// Whether all planned requests are being prefetched or wait for that. Precondition: the mutex is held.
  bool isLooking() const;

  const Profiler profiler;  ///< of the first field
  Backend& backend;
  JobSystem& jobs;
  const WorldSettings settings;
  WorldEdits edits;
  FieldSwitch fields;
  std::unique_ptr<DiskCache> cache;  ///< or null; set before the first job

  mutable std::mutex mutex;  ///< guards the following; held only for short work
  std::condition_variable changed;
  std::vector<Viewer> viewers;
  uint64_t viewers_set = 0;  ///< counts changes
  WorkQueue queue;
  std::vector<FailedChunk> failed;
  std::vector<ColliderChange> collider_changes;  ///< in the order of reporting
  std::shared_ptr<const FrameStep> step;
  std::array<uint64_t, 2> in_hand{};  ///< as PlanInput::in_hand
  uint64_t applied = 0;
  std::shared_ptr<const DrawnFrame> drawn;  ///< the frame with that number
  uint64_t edits_drawn = 0;                 ///< the state that it shows
  uint64_t generation = 0;                  ///< of requests: those of previous generations are obsolete
  uint64_t plans = 0;
  size_t mesh_jobs = 0;  ///< submitted or running
  bool scarce = false;   ///< memory ran out, and no chunk could be made since
  PlannerStats planner_stats;
  MadeMeasures made;  ///< if the settings ask for it
  WorldTimes times;
  size_t collider_bytes = 0;

  struct Work {
    size_t queued = 0, in_work = 0;
    size_t stale = 0;  ///< of these, the ones planned for previous viewers
  };
  /// Precondition: the mutex is held.
  Work work() const;
  /// Advances times.clock_seconds and job_seconds to now. Precondition: the mutex is held.
  void countWork();
  const SurfacePool& surfaces() const { return *surfaces_; }

 private:
  using Clock = std::chrono::steady_clock;
  /// Short enough for a string without allocation.
  static constexpr const char* kOutOfMemory = "out of memory";

  /// Few jobs are needed while a device works on a batch: one prepares its chunks, one finishes them.
  size_t mostMeshJobs() const {
    const size_t most = std::max(1u, jobs.concurrency() - 1);
    return backend.batch() > 1 ? std::min<size_t>(most, 3) : most;
  }
  /// Bytes that are neither used nor reserved.
  size_t room() const {
    const size_t used = surfaces_->bytes() + planner_stats.record_bytes + collider_bytes + reserved_;
    return settings.mesh_bytes - std::min(settings.mesh_bytes, used);
  }
  bool hasRoom() const { return room() >= largestChunk(settings); }
  /// Whether to prefetch more: not while there is too little memory for one chunk, whatever jobs have reserved.
  bool mayLook() const {
    return !scarce && settings.mesh_bytes >=
                          surfaces_->bytes() + planner_stats.record_bytes + collider_bytes + largestChunk(settings);
  }
  /// Whether jobs could mesh a request whose prefetch has taken too long.
  bool isOverdue() const;

  /// The object that jobs own.
  struct Gate {
    explicit Gate(WorldCore& core_in) : core(core_in) {}
    /// Keeps the core alive until leave(). Returns false if the core has ended.
    bool enter() noexcept;
    void leave() noexcept;

    WorldCore& core;
    std::mutex mutex;  ///< guards what follows
    std::condition_variable ended;
    bool closed = false;  ///< the core has ended or is about to
    size_t running = 0;   ///< number of running jobs
  };

  /// Returns false if memory runs out.
  bool submit(JobSystem& to, void (*function)(void*), int priority) noexcept;
  bool submit(void (*function)(void*), int priority) noexcept { return submit(jobs, function, priority); }
  /// Called at the world's turn to plan. owner: its gate.
  static void beginPlan(const std::shared_ptr<void>& owner) noexcept;
  /// Precondition: the mutex is held.
  void setMeshJobs(size_t count) { turns_->setMeshJobs(turn_, mesh_jobs = count); }
  void kickMeshing();
  /// Starts lookers if there are too few for the requests to prefetch.
  void kickLooking();
  PlanInput planInput();
  void publish(Plan&& plan);
  void losePlanner();
  /// Null if the planner needs no restart.
  std::shared_ptr<const DrawnFrame> frameToRestartFrom();
  /// Returns false if memory ran out.
  bool makePlan();
  void planOnce();
  void makeColliders();
  /// Prefetches, as a looker, as long as there are requests for that.
  void lookFar();
  ChunkMesher mesherOf(const WorldState& under) const;
  void meshOnce();
  void meshAgain();
  /// Ends a mesh job without a successor.
  void endMeshJob();
  /// Calls `job`, which submits another job of this kind. If the job system runs that one at once, handsOn() is true
  /// inside and it does nothing, so that no call does more than one job's work. Does nothing if memory runs out.
  template <class Submit>
  void handOn(const Submit& job);
  /// Precondition: the mutex is held.
  bool handsOn() const;
  /// Takes as many of the queue's items as one job meshes, at most `batch`, for which the vector has capacity.
  /// Precondition: the mutex is held.
  void takeItems(size_t batch, std::vector<WorkItem>& items);
  void surfaceOne(Result<MeshedChunk>& chunk, const WorldState& under, FinishedChunk& done) const;
  /// Meshes the items. Returns their measures.
  MadeMeasures meshItems(std::span<const WorkItem> items, const WorldState& under, const Progress& progress,
                         std::span<FinishedChunk> done) const;
  void flushOnce();
  void compareOnce();
  /// Reports that memory ran out: the next update tries again, with one job at first.
  void tellScarce() noexcept;
  /// Thread-safe, takes no lock.
  void warn(const char* message) const noexcept;

  /// The entry point of jobs: does nothing once the gate is closed.
  template <void (WorldCore::*work)()>
  static void run(void* argument) noexcept;

  std::pmr::memory_resource* memory_;
  const std::unique_ptr<JobSystem> lookers_;  ///< null: no store is far
  const std::shared_ptr<Gate> gate_;
  const std::shared_ptr<PlanTurns> turns_;
  PlanTurns::Member turn_;
  std::shared_ptr<SurfacePool> surfaces_;
  const std::unique_ptr<MeasuringPool> measuring_;  ///< null: no measures
  Planner planner_;                                 ///< used only by the planning job, which never runs concurrently
  Colliders colliders_;                             ///< same as above

  // Guarded by the mutex.
  bool scarce_told_ = false;   ///< since the world was last at rest
  bool passed_over_ = false;   ///< memory ran out for a chunk since the last plan
  bool planner_lost_ = false;  ///< memory ran out during planning
  struct Seen {
    uint64_t viewers = 0, applied = 0, edits = 0;
  };
  Seen planning_with_, planned_with_;  ///< input of the plan in progress, and of the published one
  WorldState queue_edits_;             ///< the state under which the queue is meshed
  std::vector<ChunkKey> begun_;
  std::vector<FinishedChunk> finished_;
  size_t meshing_before_ = 0;  ///< requests in work when these viewers' plan came, minus those that ended since
  size_t meshing_ = 0;         ///< requests in work
  size_t meshing_jobs_ = 0;    ///< jobs at work on them
  Clock::time_point counted_at_ = Clock::now();             ///< countWork() precedes changes of meshing_jobs_
  std::array<size_t, WorkItem::kRanks> meshing_of_rank_{};  ///< requests in work by WorkItem::Rank
  size_t reserved_ = 0;                                     ///< the most bytes that these may take
  size_t look_jobs_ = 0;                                    ///< lookers that run or are about to
  std::vector<std::thread::id> submitting_;                 ///< threads that are submitting a mesh job's successor
  bool planning_ = false;                                   ///< waiting for its turn, submitted or running
  bool plan_again_ = false;
  bool flushing_ = false;  ///< same as above
  bool stopped_ = false;
  bool idle_ = false;
  bool colliders_done_ = true;
  Clock::time_point next_flush_;
  bool flush_failed_ = false;
};

template <void (WorldCore::*work)()>
void WorldCore::run(void* argument) noexcept {
  const std::unique_ptr<std::shared_ptr<Gate>> owner(static_cast<std::shared_ptr<Gate>*>(argument));
  Gate& gate = **owner;
  if (!gate.enter()) return;
  (gate.core.*work)();
  gate.leave();
}

template <class Submit>
void WorldCore::handOn(const Submit& job) {
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
