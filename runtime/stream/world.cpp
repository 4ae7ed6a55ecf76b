#include "stream/world.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <set>

#include "mesh/hash.h"
#include "stream/reachability.h"

namespace sgm {

namespace {

using Clock = std::chrono::steady_clock;

/// What a chunk may come to: every cell cut in the worst way, with six seams.
constexpr size_t kLargestChunk = size_t{5} << 20;
/// Requests that come back before the planner looks at them, where more are waiting and no update comes.
constexpr size_t kFinishedToPlan = 64;
constexpr size_t kHashedAtOnce = 256;
/// Failures told in one update: there is room for so many.
constexpr ptrdiff_t kFailedAtOnce = 64;
/// Plans in a row that bring nothing, until a wait gives up.
constexpr int kPlansInVain = 1000;
/// How long at least the jobs mesh after a plan, in times that it took, before an update has the next one made.
constexpr int kMeshingPerPlanning = 2;
constexpr int kPlanPriority = 2, kMeshPriority = 1;

}  // namespace

/// Shared by the world and its jobs, which may begin late.
struct World::Core : std::enable_shared_from_this<Core> {
  Core(const WorldField& field_in, Backend& backend_in, JobSystem& jobs_in, const WorldSettings& settings_in,
       std::pmr::memory_resource* memory_in)
      : field(field_in),
        backend(backend_in),
        jobs(jobs_in),
        settings(settings_in),
        memory(memory_in),
        surfaces(std::make_shared<SurfacePool>(memory_in)),
        planner({settings_in.lod, settings_in.mesh_bytes, settings_in.by_reach}),
        drawn(std::make_shared<DrawnFrame>(Octree(settings_in.lod.top, settings_in.lod.finest_cell))) {}

  const WorldField& field;
  Backend& backend;
  JobSystem& jobs;
  const WorldSettings settings;
  std::pmr::memory_resource* memory;
  std::shared_ptr<SurfacePool> surfaces;
  Planner planner;            ///< of the planning job alone, which never runs twice at one time
  bool planner_lost = false;  ///< memory gave out while it planned; guarded by the mutex

  mutable std::mutex mutex;  ///< guards what follows
  std::condition_variable changed;
  std::vector<Viewer> viewers;
  uint64_t viewers_set = 0, viewers_planning = 0, viewers_planned = 0;  ///< counts of changes
  std::vector<WorkItem> queue;                                          ///< the most urgent last
  std::vector<ChunkKey> begun, refused;
  std::vector<FinishedChunk> finished;
  std::vector<FailedChunk> failed;
  std::shared_ptr<const FrameStep> step;
  uint64_t applied = 0, applied_planning = 0;
  std::shared_ptr<const DrawnFrame> drawn;  ///< the frame of that number
  uint64_t generation = 0;                  ///< of requests: those of an earlier one are not wanted any more
  size_t meshing_before = 0;  ///< jobs that were at work when the plan for these viewers came, less those that ended
  size_t meshing = 0;         ///< jobs at work on a request
  size_t reserved = 0;        ///< bytes that these may come to
  size_t running = 0;         ///< jobs between their begin and end
  size_t mesh_jobs = 0;       ///< submitted or running
  bool planning = false;      ///< likewise
  bool plan_again = false;
  bool stopped = false;
  bool idle = false;
  uint64_t plans = 0;
  Clock::time_point next_plan;  ///< not earlier, while there is something to mesh
  PlannerStats planner_stats;

  /// What the viewers of now want is there and drawn.
  bool settled() const { return idle && viewers_planned == viewers_set && step == nullptr; }
  size_t mostMeshJobs() const { return std::max(1u, jobs.concurrency() - 1); }
  bool hasRoom() const { return surfaces->bytes() + reserved + kLargestChunk <= settings.mesh_bytes; }

  /// False where no memory is left to do so.
  bool submit(void (*function)(void*), int priority) noexcept;
  /// Whether an update should have the work planned: planning must leave the jobs time to mesh.
  bool planIsDue() const;
  void kickPlanner();
  void kickMeshing();
  PlanInput planInput();
  /// Whether to plan again at once.
  bool publish(Plan&& plan);
  /// Null where the planner is whole.
  std::shared_ptr<const DrawnFrame> frameToRestartFrom() const;
  void planOnce();
  void meshOnce();
  FinishedChunk meshOne(const WorkItem& item, uint64_t of_generation) const;

  /// A job's frame: does nothing after the world's end.
  template <void (Core::*work)()>
  static void run(void* argument) noexcept {
    const std::unique_ptr<std::shared_ptr<Core>> owner(static_cast<std::shared_ptr<Core>*>(argument));
    Core& core = **owner;
    {
      const std::lock_guard lock(core.mutex);
      if (core.stopped) return;
      ++core.running;
    }
    (core.*work)();
    const std::lock_guard lock(core.mutex);
    --core.running;
    core.changed.notify_all();
  }
};

bool World::Core::submit(void (*function)(void*), int priority) noexcept {
  try {
    auto owner = std::make_unique<std::shared_ptr<Core>>(shared_from_this());
    jobs.submit(function, owner.get(), priority);
    static_cast<void>(owner.release());
    return true;
  } catch (const std::bad_alloc&) {
    return false;
  }
}

void World::Core::kickPlanner() {
  {
    const std::lock_guard lock(mutex);
    if (stopped) return;
    if (planning) {
      plan_again = true;
      return;
    }
    planning = true;
  }
  if (submit(run<&Core::planOnce>, kPlanPriority)) return;
  const std::lock_guard lock(mutex);
  planning = false;  // the next update tries again
}

void World::Core::kickMeshing() {
  for (;;) {
    {
      const std::lock_guard lock(mutex);
      if (stopped || mesh_jobs >= mostMeshJobs() || mesh_jobs >= queue.size() + meshing || !hasRoom()) return;
      ++mesh_jobs;
    }
    if (submit(run<&Core::meshOnce>, kMeshPriority)) continue;
    const std::lock_guard lock(mutex);
    --mesh_jobs;
    return;
  }
}

PlanInput World::Core::planInput() {
  PlanInput input;
  {
    const std::lock_guard lock(mutex);
    plan_again = false;
    input.viewers = viewers;
    viewers_planning = viewers_set;
    input.finished.swap(finished);
    input.begun.swap(begun);
    input.refused.swap(refused);
    input.applied = applied_planning = applied;
  }
  surfaces->collect();
  input.live_bytes = surfaces->bytes();
  return input;
}

bool World::Core::planIsDue() const {
  const std::lock_guard lock(mutex);
  const bool news = planner_lost || viewers_planning != viewers_set || applied_planning != applied ||
                    !finished.empty() || !refused.empty();
  const bool stuck = !queue.empty() && mesh_jobs == 0;  // without room, or out of memory
  return stuck || (news && (queue.empty() || Clock::now() >= next_plan));
}

void World::Core::planOnce() {
  const Clock::time_point begun_at = Clock::now();
  bool again;
  try {
    if (const std::shared_ptr<const DrawnFrame> frame = frameToRestartFrom()) planner.restart(frame);
    Plan plan = planner.plan(planInput());
    again = publish(std::move(plan));
  } catch (const std::bad_alloc&) {
    // What the planner knows is no longer whole. It begins anew from what is drawn, at the next update.
    const std::lock_guard lock(mutex);
    planner_lost = true;
    planning = false;
    queue.clear();
    ++generation;
    ++plans;
    changed.notify_all();
    return;
  }
  {
    const std::lock_guard lock(mutex);
    const Clock::time_point now = Clock::now();
    next_plan = now + kMeshingPerPlanning * (now - begun_at);
  }
  kickMeshing();
  if (again && !submit(run<&Core::planOnce>, kPlanPriority)) {
    const std::lock_guard lock(mutex);
    planning = false;
  }
}

std::shared_ptr<const DrawnFrame> World::Core::frameToRestartFrom() const {
  const std::lock_guard lock(mutex);
  return planner_lost ? drawn : nullptr;
}

bool World::Core::publish(Plan&& plan) {
  const std::lock_guard lock(mutex);
  if (!begun.empty()) {
    const std::set<ChunkKey> gone(begun.begin(), begun.end());
    std::erase_if(plan.queue, [&](const WorkItem& item) { return gone.contains(item.request.key); });
  }
  failed.insert(failed.end(), std::make_move_iterator(plan.failed.begin()), std::make_move_iterator(plan.failed.end()));
  queue.swap(plan.queue);
  step = std::move(plan.step);
  if (viewers_planned != viewers_planning) meshing_before = meshing;
  viewers_planned = viewers_planning;
  idle = plan.idle && meshing == 0 && finished.empty() && begun.empty();
  planner_stats = planner.stats();
  planner_lost = false;
  ++plans;
  planning = plan_again;
  changed.notify_all();
  return planning;
}

FinishedChunk World::Core::meshOne(const WorkItem& item, uint64_t of_generation) const {
  FinishedChunk done;
  done.request = item.request;
  const Progress progress = [&](uint64_t, uint64_t) {
    const std::lock_guard lock(mutex);
    return generation == of_generation && !stopped;
  };
  try {
    Result<std::pmr::vector<PlacedChunk>> chunks =
        meshChunks(field, backend, jobs, std::span(&item.request, 1), progress);
    if (!chunks) {
      done.error = chunks.error();
      return done;
    }
    if (item.request.signs) done.voids = std::make_unique<const VoidComponents>(voidsOf(chunks->front().mesh));
    ChunkSurface surface = surfaceOf(item.request, std::move(chunks->front()), item.before.get(), memory);
    if (!surface.mesh.indices.empty()) done.surface = surfaces->add(std::move(surface));
  } catch (const std::bad_alloc&) {
    done.error = Error{Code::out_of_memory, "out of memory while meshing a chunk"};
  }
  return done;
}

void World::Core::meshOnce() {
  WorkItem item;
  uint64_t of_generation;
  {
    const std::lock_guard lock(mutex);
    if (queue.empty() || !hasRoom()) {
      --mesh_jobs;
      return;
    }
    try {
      begun.push_back(queue.back().request.key);
    } catch (const std::bad_alloc&) {
      --mesh_jobs;
      return;
    }
    item = std::move(queue.back());
    queue.pop_back();
    of_generation = generation;
    ++meshing;
    reserved += kLargestChunk;
  }
  FinishedChunk done = meshOne(item, of_generation);
  bool plan, more;
  {
    const std::lock_guard lock(mutex);
    --meshing;
    if (meshing_before > 0) --meshing_before;
    reserved -= kLargestChunk;
    if (generation != of_generation) done.error = Error{Code::cancelled, "no longer wanted"};
    const bool scarce = done.error && done.error->code == Code::out_of_memory;
    try {
      finished.push_back(std::move(done));
    } catch (const std::bad_alloc&) {
      planner_lost = true;  // it would wait for this one for ever
    }
    plan = !scarce && (finished.size() >= kFinishedToPlan || queue.empty());
    more = !scarce && !queue.empty() && hasRoom() && !stopped;
    if (!more) --mesh_jobs;
  }
  if (plan) kickPlanner();
  if (more) submit(run<&Core::meshOnce>, kMeshPriority);
}

World::World(std::shared_ptr<Core> core, JobSystem& jobs) : core_(std::move(core)), jobs_(jobs) {}

Result<std::unique_ptr<World>> World::create(const WorldField& field, Backend& backend, JobSystem& jobs,
                                             const WorldSettings& settings, std::pmr::memory_resource* memory) {
  const LodSettings& lod = settings.lod;
  if (lod.top < 0 || lod.top > kMaxLevel) {
    return Error{Code::invalid_argument, "the coarsest level is not 0 to " + std::to_string(kMaxLevel)};
  }
  if (!(lod.finest_distance > 0) || !(lod.view_distance > 0) || !std::isfinite(lod.finest_distance) ||
      !std::isfinite(lod.view_distance)) {
    return Error{Code::invalid_argument, "the finest and the view distance must be finite and above 0"};
  }
  const size_t least = kLargestChunk * (jobs.concurrency() + 2);
  if (settings.mesh_bytes < least) {
    return Error{Code::limit, "mesh_bytes is " + std::to_string(settings.mesh_bytes) + ", too small to stream with: " +
                                  std::to_string(jobs.concurrency()) + " threads need " + std::to_string(least)};
  }
  return std::unique_ptr<World>(new World(std::make_shared<Core>(field, backend, jobs, settings, memory), jobs));
}

World::~World() {
  std::unique_lock lock(core_->mutex);
  core_->stopped = true;
  helpUntil(jobs_, lock, core_->changed, [this] { return core_->running == 0; });
  // A job that begins later holds the core, and finds nothing to do: what memory it has goes now.
  core_->queue.clear();
  core_->finished.clear();
  core_->step = nullptr;
  core_->drawn = nullptr;
  core_->planner = Planner({core_->settings.lod, core_->settings.mesh_bytes, core_->settings.by_reach});
  lock.unlock();
  staged_ = nullptr;
  events_.clear();
  handed_.clear();
  core_->surfaces->close();
}

Result<void> World::setViewers(std::span<const Viewer> viewers) {
  for (const Viewer& viewer : viewers) {
    if (Result<void> checked = checkViewer(viewer); !checked) return checked;
  }
  const std::lock_guard lock(core_->mutex);
  if (std::equal(viewers.begin(), viewers.end(), core_->viewers.begin(), core_->viewers.end())) return {};
  core_->viewers.assign(viewers.begin(), viewers.end());
  ++core_->viewers_set;
  return {};
}

bool World::update(size_t bytes) {
  const std::lock_guard front(front_);
  if (polled_ < events_.size()) return false;
  events_.clear();
  polled_ = 0;
  advance(bytes);
  return true;
}

void World::advance(size_t bytes) {
  std::shared_ptr<const FrameStep> step;
  events_.reserve(events_.size() + kFailedAtOnce);
  {
    const std::lock_guard lock(core_->mutex);
    if (core_->settled() && core_->failed.empty()) return;
    if (core_->step != nullptr && core_->step->from == core_->applied) step = core_->step;
    const auto told = core_->failed.end() - std::min<ptrdiff_t>(kFailedAtOnce, std::ssize(core_->failed));
    for (auto chunk = told; chunk != core_->failed.end(); ++chunk) {
      events_.push_back({WorldEvent::Kind::failed, chunk->key, nullptr, 0, 0, 0, std::move(chunk->error)});
    }
    core_->failed.erase(told, core_->failed.end());
  }
  if (step != nullptr && stage(step, bytes)) {
    const std::lock_guard lock(core_->mutex);
    core_->applied = step->to->number;
    core_->drawn = step->to;
  }
  if (core_->planIsDue()) core_->kickPlanner();
}

void World::restage(const std::shared_ptr<const FrameStep>& step) {
  // What was handed over for a step that will not be taken is wanted no more, but where this one has it too.
  std::unordered_set<ChunkKey, ChunkKeyHash> drawn;
  for (const DrawnChunk& chunk : step->to->drawn) drawn.insert(chunk.key);
  if (staged_ != nullptr) {
    events_.reserve(events_.size() + staged_->changes.size());
    for (const FrameChange& change : staged_->changes) {
      const ChunkKey& key = change.chunk.key;
      if (change.kind != FrameChange::Kind::shown || drawn.contains(key) || handed_.erase(key) == 0) continue;
      events_.push_back({WorldEvent::Kind::removed, key, nullptr, 0, 0, 0, {}});
    }
  }
  staged_ = step;
  staged_changes_ = 0;
}

bool World::handOver(const FrameStep& step, size_t bytes) {
  size_t given = 0;
  for (; staged_changes_ < step.changes.size(); ++staged_changes_) {
    const DrawnChunk& chunk = step.changes[staged_changes_].chunk;
    if (chunk.surface == nullptr) continue;
    std::shared_ptr<const ChunkSurface>& handed = handed_[chunk.key];
    if (handed == chunk.surface) continue;
    const size_t size = chunk.surface->mesh.bytes();
    if (size > bytes) {
      const std::lock_guard lock(core_->mutex);
      core_->refused.push_back(chunk.key);
      return false;
    }
    if (size > bytes - given) return false;
    events_.push_back({WorldEvent::Kind::ready, chunk.key, chunk.surface, 0, 0, 0, {}});
    given += size;
    handed = chunk.surface;
  }
  return true;
}

bool World::stage(const std::shared_ptr<const FrameStep>& step, size_t bytes) {
  if (step != staged_) restage(step);
  if (!handOver(*step, bytes)) return false;
  const auto kindOf = [](FrameChange::Kind kind) {
    switch (kind) {
      case FrameChange::Kind::shown:
        return WorldEvent::Kind::shown;
      case FrameChange::Kind::replaced:
        return WorldEvent::Kind::replaced;
      case FrameChange::Kind::seams:
        return WorldEvent::Kind::seams;
      case FrameChange::Kind::removed:
        break;
    }
    return WorldEvent::Kind::removed;
  };
  // All of them or none: nothing below can fail.
  events_.reserve(events_.size() + step->changes.size());
  for (const FrameChange& change : step->changes) {
    if (change.kind == FrameChange::Kind::removed) handed_.erase(change.chunk.key);
    events_.push_back({kindOf(change.kind),
                       change.chunk.key,
                       nullptr,
                       change.chunk.seams,
                       change.chunk.coarser,
                       step->to->number,
                       {}});
  }
  staged_ = nullptr;
  return true;
}

void World::poll(const std::function<bool(const WorldEvent&)>& take) {
  const std::lock_guard front(front_);
  for (; polled_ < events_.size() && take(events_[polled_]); ++polled_) events_[polled_].surface = nullptr;
}

std::shared_ptr<const DrawnFrame> World::drawn() const {
  const std::lock_guard lock(core_->mutex);
  return core_->drawn;
}

Result<void> World::waitIdle(const std::function<bool()>& more) {
  const std::lock_guard front(front_);
  uint64_t frame = 0, finished = 0;
  for (int in_vain = 0; in_vain < kPlansInVain; ++in_vain) {
    advance(std::numeric_limits<size_t>::max());
    std::unique_lock lock(core_->mutex);
    if (core_->settled()) return {};
    if (core_->mesh_jobs > 0 || core_->applied != frame ||
        core_->planner_stats.meshed + core_->planner_stats.seam_jobs != finished)
      in_vain = 0;
    frame = core_->applied;
    finished = core_->planner_stats.meshed + core_->planner_stats.seam_jobs;
    const uint64_t plans = core_->plans;
    helpUntil(jobs_, lock, core_->changed, [&] { return core_->plans != plans; });
    lock.unlock();
    if (more && !more()) return Error{Code::cancelled, "the wait was cancelled"};
  }
  return Error{Code::limit, "nothing more fits into mesh_bytes: poll the events, release meshes, or raise it"};
}

void World::cancel() {
  const std::lock_guard lock(core_->mutex);
  core_->queue.clear();
  ++core_->generation;
  ++core_->viewers_set;  // to be planned anew
}

Result<ContentHash> World::hashBodies(const IntBox& region, int level) const {
  const Result<std::pmr::vector<ChunkKey>> keys =
      chunksOfRegion(core_->field, region, level, std::numeric_limits<uint64_t>::max());
  if (!keys) return keys.error();
  const std::shared_ptr<const DrawnFrame> frame = drawn();
  ContentHash sum;
  const auto add = [&sum](ContentHash body, const ChunkGrid& grid) {
    const ContentHash placed = hashPlaced(body, grid, 0);
    sum.a += placed.a;
    sum.b += placed.b;
  };
  std::vector<ChunkRequest> rest;
  for (const ChunkKey& key : *keys) {
    const std::shared_ptr<const ChunkSurface> surface = frame->find(key);
    if (surface == nullptr) {
      rest.emplace_back().key = key;
    } else if (surface->mesh.ranges[0].index_count > 0) {
      add(surface->mesh.ranges[0].hash, surface->grid);
    }
  }
  // A bounded number at one time: of what is meshed only the hash is kept.
  for (size_t first = 0; first < rest.size(); first += kHashedAtOnce) {
    const auto some = std::span(rest).subspan(first, std::min(kHashedAtOnce, rest.size() - first));
    const Result<std::pmr::vector<PlacedChunk>> chunks = meshChunks(core_->field, core_->backend, core_->jobs, some);
    if (!chunks) return chunks.error();
    for (const PlacedChunk& chunk : *chunks) {
      if (!chunk.mesh.body.indices.empty()) add(chunk.mesh.body.hash, chunk.grid);
    }
  }
  return sum;
}

WorldStats World::stats() const {
  WorldStats stats;
  const std::lock_guard lock(core_->mutex);
  stats.planner = core_->planner_stats;
  stats.queued = core_->queue.size();
  stats.in_work = core_->meshing;
  stats.stale = core_->viewers_planned != core_->viewers_set ? core_->queue.size() + core_->meshing
                                                             : std::min(core_->meshing, core_->meshing_before);
  stats.frame = core_->applied;
  stats.plans = core_->plans;
  stats.surface_bytes = core_->surfaces->bytes();
  stats.peak_surface_bytes = core_->surfaces->peakBytes();
  stats.idle = core_->settled();
  return stats;
}

}  // namespace sgm
