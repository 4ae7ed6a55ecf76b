#pragma once
// What a streamed world and its jobs share (world.h): a mailbox behind one mutex, a job that plans, and jobs that mesh.
// Where chunks may come from far away, threads of the world's own look for them there: no job waits for a server.
//
// Jobs may begin late: all that they own is a gate, which is closed after the world's end. No job takes longer than one
// plan, one chunk or one batch of a device's, so that an engine's own jobs get their turn. Planning and what is done
// now and then is in world_core.cpp, meshing and looking in world_meshing.cpp.

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

/// What a chunk may come to, in bytes: every cell cut in the worst way, with six seams. Texture coordinates double
/// that; so do sharp features in every second cell, and one with more fails.
inline size_t largestChunk(const WorldSettings& settings) {
  return size_t{5} << (20 + (settings.texture ? 1 : 0) + (settings.sharp ? 1 : 0));
}

class WorldCore {
 public:
  static constexpr unsigned kLookers = 4;

  /// lookers: threads that may wait for what is far; null: what is baked is near. turns: of all worlds on these jobs.
  WorldCore(std::shared_ptr<const WorldField> field, Backend& backend, JobSystem& jobs,
            std::shared_ptr<PlanTurns> turns, const WorldSettings& settings, std::unique_ptr<JobSystem> lookers,
            std::pmr::memory_resource* memory);
  ~WorldCore() { turns_->leave(turn_); }
  WorldCore(const WorldCore&) = delete;
  WorldCore& operator=(const WorldCore&) = delete;

  /// Has the work planned when the world's turn comes (plan_turns.h); while that is being done, once more after it.
  void kickPlanner();
  /// Whether a plan would have something new to look at.
  bool planIsDue() const;
  /// Has plans begin that have waited for their turn, of whatever world.
  void startDuePlans() { turns_->startDue(); }
  /// Has the journal written, at most every kBetweenFlushes.
  void kickJournal();
  /// Has the world go over to the field that is wanted next, when its turn comes.
  void kickFieldSwitch();
  /// Has jobs mesh what was looked for far away for too long.
  void kickOverdue();
  /// Waits for jobs that have begun: no other will touch the core. Once, before its end. Writes the journal.
  void stop() noexcept;

  /// What the viewers of now want is there and drawn, edits included. Precondition: the mutex is held.
  bool settled() const;
  /// A plan or a chunk is being made. Precondition: the mutex is held.
  bool atWork() const { return planning_ || mesh_jobs > 0 || isLooking(); }
  /// All that is planned is being looked for, or waits for its turn. Precondition: the mutex is held.
  bool isLooking() const;

  const Profiler profiler;  ///< of the first field
  Backend& backend;
  JobSystem& jobs;
  const WorldSettings settings;
  WorldEdits edits;
  FieldSwitch fields;
  std::unique_ptr<DiskCache> cache;  ///< null: none; set before the first job

  mutable std::mutex mutex;  ///< guards what follows; held for short work without waiting
  std::condition_variable changed;
  std::vector<Viewer> viewers;
  uint64_t viewers_set = 0;  ///< counts changes
  WorkQueue queue;
  std::vector<FailedChunk> failed;
  std::vector<ColliderChange> collider_changes;  ///< in the order in which they are to be told
  std::shared_ptr<const FrameStep> step;
  std::array<uint64_t, 2> in_hand{};  ///< as PlanInput::in_hand
  uint64_t applied = 0;
  std::shared_ptr<const DrawnFrame> drawn;  ///< the frame of that number
  uint64_t edits_drawn = 0;                 ///< the state that it shows
  uint64_t generation = 0;                  ///< of requests: those of an earlier one are not wanted any more
  uint64_t plans = 0;
  size_t mesh_jobs = 0;  ///< submitted or running
  bool scarce = false;   ///< memory gave out, and no chunk could be made since
  PlannerStats planner_stats;
  MadeMeasures made;  ///< where the settings ask for it
  WorldTimes times;
  size_t collider_bytes = 0;

  struct Work {
    size_t queued = 0, in_work = 0;
    size_t stale = 0;  ///< of these, those planned for viewers of before
  };
  /// Precondition: the mutex is held.
  Work work() const;
  /// Brings times.clock_seconds and job_seconds up to now. Precondition: the mutex is held.
  void countWork();
  const SurfacePool& surfaces() const { return *surfaces_; }

 private:
  using Clock = std::chrono::steady_clock;
  /// Fits into a string without memory of its own.
  static constexpr const char* kOutOfMemory = "out of memory";

  /// Those that wait for a device while it works on a batch are few: one prepares its chunks, one finishes them.
  size_t mostMeshJobs() const {
    const size_t most = std::max(1u, jobs.concurrency() - 1);
    return backend.batch() > 1 ? std::min<size_t>(most, 3) : most;
  }
  /// Bytes that are neither taken nor promised.
  size_t room() const {
    const size_t used = surfaces_->bytes() + planner_stats.record_bytes + collider_bytes + reserved_;
    return settings.mesh_bytes - std::min(settings.mesh_bytes, used);
  }
  bool hasRoom() const { return room() >= largestChunk(settings); }
  /// Whether to look for more: not as long as there is too little for one chunk, whatever jobs have been promised.
  bool mayLook() const {
    return !scarce && settings.mesh_bytes >=
                          surfaces_->bytes() + planner_stats.record_bytes + collider_bytes + largestChunk(settings);
  }
  /// Jobs could mesh what has waited for its look for long enough.
  bool isOverdue() const;

  /// What jobs own.
  struct Gate {
    explicit Gate(WorldCore& core_in) : core(core_in) {}
    /// Keeps the core from ending until leave(). False where it has ended.
    bool enter() noexcept;
    void leave() noexcept;

    WorldCore& core;
    std::mutex mutex;  ///< guards what follows
    std::condition_variable ended;
    bool closed = false;  ///< the core is no more, or will not be for long
    size_t running = 0;   ///< jobs between their begin and end
  };

  /// False where no memory is left to do so.
  bool submit(JobSystem& to, void (*function)(void*), int priority) noexcept;
  bool submit(void (*function)(void*), int priority) noexcept { return submit(jobs, function, priority); }
  /// The world's turn to plan has come. owner: its gate.
  static void beginPlan(const std::shared_ptr<void>& owner) noexcept;
  /// Precondition: the mutex is held.
  void setMeshJobs(size_t count) { turns_->setMeshJobs(turn_, mesh_jobs = count); }
  void kickMeshing();
  /// Has lookers look for what there is to look for, where there are too few.
  void kickLooking();
  PlanInput planInput();
  void publish(Plan&& plan);
  void losePlanner();
  /// Null where the planner is whole.
  std::shared_ptr<const DrawnFrame> frameToRestartFrom();
  /// False where memory gave out.
  bool makePlan();
  void planOnce();
  void makeColliders();
  /// A looker's work, as long as there is some.
  void lookFar();
  ChunkMesher mesherOf(const WorldState& under) const;
  void meshOnce();
  void meshAgain();
  /// No other follows this one.
  void endMeshJob();
  /// Has `job` submit another of this job's kind: one that the job system runs at once finds handsOn() true and is to
  /// do nothing, so that no call does more than one job's work. Does nothing where memory is out.
  template <class Submit>
  void handOn(const Submit& job);
  /// Precondition: the mutex is held.
  bool handsOn() const;
  /// As many of the queue's items as one job meshes, at most `batch`, which the vector has room for. Precondition: the
  /// mutex is held.
  void takeItems(size_t batch, std::vector<WorkItem>& items);
  void surfaceOne(Result<MeshedChunk>& chunk, const WorldState& under, FinishedChunk& done) const;
  /// What was measured of them.
  MadeMeasures meshItems(std::span<const WorkItem> items, const WorldState& under, const Progress& progress,
                         std::span<FinishedChunk> done) const;
  void flushOnce();
  void compareOnce();
  /// Memory gave out: the next update tries again, with one job at first.
  void tellScarce() noexcept;
  /// Any thread, without a lock.
  void warn(const char* message) const noexcept;

  /// A job's frame: does nothing once the gate is closed.
  template <void (WorldCore::*work)()>
  static void run(void* argument) noexcept;

  std::pmr::memory_resource* memory_;
  const std::unique_ptr<JobSystem> lookers_;  ///< null: nothing is far
  const std::shared_ptr<Gate> gate_;
  const std::shared_ptr<PlanTurns> turns_;
  PlanTurns::Member turn_;
  std::shared_ptr<SurfacePool> surfaces_;
  const std::unique_ptr<MeasuringPool> measuring_;  ///< null: nothing is measured
  Planner planner_;                                 ///< of the planning job alone, which never runs twice at one time
  Colliders colliders_;                             ///< likewise

  // Guarded by the mutex.
  bool scarce_told_ = false;   ///< since the world was at rest
  bool passed_over_ = false;   ///< memory gave out for a chunk since the last plan
  bool planner_lost_ = false;  ///< memory gave out while it planned
  struct Seen {
    uint64_t viewers = 0, applied = 0, edits = 0;
  };
  Seen planning_with_, planned_with_;  ///< what the plan in the making has seen, and what the published one had
  WorldState queue_edits_;             ///< that the queue is meshed under
  std::vector<ChunkKey> begun_;
  std::vector<FinishedChunk> finished_;
  size_t meshing_before_ = 0;  ///< requests in work when the plan for these viewers came, less as many as have ended
  size_t meshing_ = 0;         ///< requests in work
  size_t meshing_jobs_ = 0;    ///< jobs at work on them
  Clock::time_point counted_at_ = Clock::now();  ///< by countWork(), which comes before meshing_jobs_ changes
  std::array<size_t, WorkItem::kRanks> meshing_of_rank_{};  ///< likewise, by WorkItem::Rank
  size_t reserved_ = 0;                                     ///< bytes that these may come to
  size_t look_jobs_ = 0;                                    ///< lookers at work, or about to be
  std::vector<std::thread::id> submitting_;                 ///< threads that are handing on a mesh job
  bool planning_ = false;                                   ///< waiting for its turn, submitted or running
  bool plan_again_ = false;
  bool flushing_ = false;  ///< likewise
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
