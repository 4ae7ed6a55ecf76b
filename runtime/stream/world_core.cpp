#include "stream/world_core.h"

#include <algorithm>
#include <set>

namespace sgm {

namespace {

using namespace std::chrono_literals;

constexpr int kFlushPriority = 3, kPlanPriority = 2, kComparePriority = 2;
/// A job that plans makes at most as many colliders as this number of world updates can hand over to the engine.
constexpr size_t kUpdatesOfColliders = 4;
/// The interval between writes of the journal. It is so short that, including the time of the disk, a crash loses at
/// most the edits of the last second.
constexpr auto kBetweenFlushes = 250ms;

PlannerSettings plannerSettings(const WorldSettings& settings) {
  return {settings.lod, settings.mesh_bytes, settings.collider_distance, settings.by_reach, settings.sharp};
}

}  // namespace

WorldCore::WorldCore(std::shared_ptr<const WorldField> field, Backend& backend_in, JobSystem& jobs_in,
                     std::shared_ptr<PlanTurns> turns, const WorldSettings& settings_in,
                     std::unique_ptr<JobSystem> prefetchers, std::pmr::memory_resource* memory)
    : profiler(field->profiler()),
      backend(backend_in),
      jobs(jobs_in),
      settings(settings_in),
      edits(std::move(field), settings_in.edits, memory),
      fields(settings_in.sharp),
      queue(prefetchers != nullptr ? prefetchers->concurrency() - 1 : 0),
      drawn(std::make_shared<DrawnFrame>(Octree(settings_in.lod.top, settings_in.lod.finest_cell))),
      memory_(memory),
      prefetchers_(std::move(prefetchers)),
      gate_(std::make_shared<JobGate>(*this)),
      turns_(std::move(turns)),
      surfaces_(std::make_shared<SurfacePool>(memory)),
      measuring_(settings_in.measure ? std::make_unique<MeasuringPool>(memory) : nullptr),
      planner_(plannerSettings(settings_in), edits.state()),
      colliders_(settings_in.collider_distance) {
  turn_.begin = beginPlan;
  turn_.owner = gate_;
  turns_->join(turn_);
}

bool WorldCore::JobGate::enter() noexcept {
  const std::lock_guard lock(mutex);
  running += closed ? 0 : 1;
  return !closed;
}

void WorldCore::JobGate::leave() noexcept {
  const std::lock_guard lock(mutex);
  --running;
  ended.notify_all();
}

void WorldCore::stop() noexcept {
  {
    const std::lock_guard lock(mutex);
    stopped_ = true;
  }
  if (settings.baked != nullptr) settings.baked->stop();
  {
    std::unique_lock lock(gate_->mutex);
    gate_->closed = true;
    helpUntil(jobs, lock, gate_->ended, [this] { return gate_->running == 0; });
  }
  surfaces_->close();
  flush_failed_ = false;  // the following write is the last one, so its failure is reported even if an earlier failure
                          // was reported
  flushOnce();
}

void WorldCore::warn(const char* message) const noexcept {
  if (!settings.on_warning) return;
  try {
    settings.on_warning(message);
  } catch (const std::bad_alloc&) {
    // There was no memory for the warning. It is lost, because a job must not throw.
  }
}

bool WorldCore::settled() const {
  return idle_ && !planner_lost_ && fields.settled(!viewers.empty()) && planned_with_.viewers == viewers_set &&
         planned_with_.applied == applied && planned_with_.edits == edits.number() && step == nullptr &&
         colliders_done_ && collider_changes.empty();
}

WorldCore::Work WorldCore::work() const {
  const size_t all = queue.size() + meshing_;
  return {queue.size(), meshing_, planned_with_.viewers != viewers_set ? all : std::min(meshing_, meshing_before_)};
}

void WorldCore::countWork() {
  const Clock::time_point now = Clock::now();
  const double seconds = std::chrono::duration<double>(now - counted_at_).count();
  counted_at_ = now;
  if (meshing_jobs_ > 0) times.clock_seconds += seconds;
  times.job_seconds += seconds * static_cast<double>(meshing_jobs_);
}

bool WorldCore::submit(JobSystem& to, void (*function)(void*), int priority) noexcept {
  try {
    auto owner = std::make_unique<std::shared_ptr<JobGate>>(gate_);
    to.submit(function, owner.get(), priority);
    static_cast<void>(owner.release());
    return true;
  } catch (const std::bad_alloc&) {
    return false;
  }
}

void WorldCore::reportOutOfMemory() noexcept {
  {
    const std::lock_guard lock(mutex);
    is_out_of_memory = true;
    if (std::exchange(out_of_memory_reported_, true)) return;
  }
  warn("there is too little memory for the viewers' chunks: the drawn ones stay, and every update tries again");
}

void WorldCore::scheduleJournal() {
  if (!edits.unwritten()) return;
  {
    const std::lock_guard lock(mutex);
    if (stopped_ || flushing_ || Clock::now() < next_flush_) return;
    flushing_ = true;
    next_flush_ = Clock::now() + kBetweenFlushes;
  }
  if (submit(run<&WorldCore::flushOnce>, kFlushPriority)) return;
  const std::lock_guard lock(mutex);
  flushing_ = false;
}

void WorldCore::flushOnce() {
  Result<void> flushed;
  try {
    flushed = edits.flush();
  } catch (const std::bad_alloc&) {
    flushed = Error{Code::out_of_memory, kOutOfMemory};
  }
  bool first;
  {
    const std::lock_guard lock(mutex);
    flushing_ = false;
    first = !flushed && !flush_failed_;
    flush_failed_ = !flushed;
  }
  // If several writes fail in succession, only the first failure is reported. The write is tried again after the next
  // edits, and when the world is destroyed.
  if (!first) return;
  const Error& why = flushed.error();
  warn(why.code == Code::out_of_memory ? "out of memory while writing the edit journal" : why.message.c_str());
}

void WorldCore::scheduleFieldSwitch() {
  FieldSwitch::Progress progress;
  {
    const std::lock_guard lock(mutex);
    if (stopped_) return;
    progress = {edits_drawn, planner_stats.edits_failed, !viewers.empty(), applied > 0, idle_};
  }
  if (!fields.begin(progress) || submit(run<&WorldCore::compareOnce>, kComparePriority)) return;
  fields.giveUp();  // the job could not be submitted; the next update tries again
}

void WorldCore::compareOnce() {
  std::shared_ptr<const DrawnFrame> frame;
  bool at_once;
  {
    const std::lock_guard lock(mutex);
    at_once = isResubmitting();
    frame = drawn;
  }
  if (at_once)
    return fields.giveUp();  // the job system runs jobs within submit(), so compare in the next update instead
  try {
    const ProfileScope scope(profiler, zone::kDerive);
    if (fields.compare(frame, edits, jobs)) return resubmit([this] { scheduleFieldSwitch(); });
  } catch (const std::bad_alloc&) {
    return reportOutOfMemory();
  }
  const std::lock_guard lock(mutex);
  changed.notify_all();
}

void WorldCore::schedulePlanner() {
  {
    const std::lock_guard lock(mutex);
    if (stopped_) return;
    if (planning_) {
      plan_again_ = true;
      return;
    }
    planning_ = true;
  }
  turns_->request(turn_);
  turns_->startDue();
}

void WorldCore::beginPlan(const std::shared_ptr<void>& owner) noexcept {
  JobGate& gate = *static_cast<JobGate*>(owner.get());
  if (!gate.enter()) return;
  WorldCore& core = gate.core;
  if (!core.submit(run<&WorldCore::planOnce>, kPlanPriority)) {
    core.turns_->endPlan(core.turn_, 0);
    const std::lock_guard lock(core.mutex);
    core.planning_ = false;  // the job could not be submitted; the next update tries again
  }
  gate.leave();
}

PlanInput WorldCore::planInput() {
  PlanInput input;
  input.edits = edits.state();
  input.edited = edits.changedSince(planner_.edits().number);
  {
    const std::lock_guard lock(mutex);
    plan_again_ = false;
    input.viewers = viewers;
    planning_with_ = {viewers_set, applied, input.edits.number};
    input.finished.swap(finished_);
    input.begun.swap(begun_);
    input.applied = applied;
    input.in_hand = in_hand;
  }
  surfaces_->collect();
  input.live_bytes = surfaces_->bytes();
  input.collider_bytes = colliders_.bytes();
  return input;
}

bool WorldCore::planIsDue() const {
  const std::lock_guard lock(mutex);
  const bool news = planning_with_.edits != edits.number() || planner_lost_ || planning_with_.viewers != viewers_set ||
                    planning_with_.applied != applied || !finished_.empty() ||
                    (!colliders_done_ && collider_changes.empty());
  // True if the world offers no step, or a step that does not start from the drawn frame. If also no work
  // is running, an unfinished world is stuck: memory is exhausted, or one of two successive states of edits changed
  // nothing visible. Then it needs a plan even without news.
  const bool nothing_to_draw = step == nullptr || step->from != applied;
  const bool stuck = !atWork() && !isOverdue() && nothing_to_draw && (!idle_ || !colliders_done_);
  return stuck || news;
}

void WorldCore::resetPlanner() {
  std::vector<WorkItem> dropped;  // declared before the lock, so that its destructor runs after the mutex is released
  const std::lock_guard lock(mutex);
  planner_lost_ = true;
  queue.replace(dropped, true, Clock::now());
  ++generation;
  ++plans;
  changed.notify_all();
}

bool WorldCore::makePlan() {
  try {
    const ProfileScope scope(profiler, zone::kPlan);
    if (const std::shared_ptr<const DrawnFrame> frame = frameToRestartFrom()) planner_.restart(frame);
    Plan plan = planner_.plan(planInput());
    // Before the planner restarted, it may have offered a step, which the engine may have taken. The restarted planner
    // does not know the frame after this step, so it must restart again.
    if (planner_.applied().number != planning_with_.applied) {
      resetPlanner();
      return false;
    }
    edits.forget(planner_.stats().edits_drawn);
    publish(std::move(plan));
    return true;
  } catch (const std::bad_alloc&) {
    // After std::bad_alloc the planner's data is inconsistent. It restarts from the drawn frame at the next update.
    reportOutOfMemory();
    resetPlanner();
    return false;
  }
}

void WorldCore::planOnce() {
  const auto secondsSince = [](Clock::time_point begun_at) {
    return std::chrono::duration<double>(Clock::now() - begun_at).count();
  };
  Clock::time_point begun_at = Clock::now();
  const bool planned = makePlan();
  double seconds = secondsSince(begun_at);
  if (planned) {
    scheduleMeshing();
    schedulePrefetch();
    begun_at = Clock::now();
    try {
      makeColliders();
    } catch (const std::bad_alloc&) {
      reportOutOfMemory();
    }
    seconds += secondsSince(begun_at);
  }
  turns_->endPlan(turn_, seconds);  // must precede the world's next request for a plan
  bool again;
  {
    const std::lock_guard lock(mutex);
    again = planning_ = planned && plan_again_ && !stopped_;
    changed.notify_all();
  }
  if (again) turns_->request(turn_);
  turns_->startDue();
}

void WorldCore::makeColliders() {
  std::shared_ptr<const DrawnFrame> frame;
  std::vector<Viewer> around;
  {
    const std::lock_guard lock(mutex);
    if (!collider_changes.empty()) return;  // make no new colliders while earlier changes are not delivered yet
    frame = drawn;
    around = viewers;
  }
  // Limit the number of new colliders so that surfaces and colliders together stay within mesh_bytes. If there are no
  // viewers, leave the colliders as they are.
  const size_t used = surfaces_->bytes() + colliders_.bytes();
  const size_t room = used < settings.mesh_bytes ? (settings.mesh_bytes - used) / largestChunk(settings) : 0;
  const size_t most = std::min(room, kUpdatesOfColliders * settings.max_colliders);
  std::vector<ColliderChange> changes;
  const bool done =
      around.empty() || colliders_.update(*frame, ViewerIndex(around, settings.lod), most, memory_, changes);
  const std::lock_guard lock(mutex);
  collider_changes.swap(changes);
  collider_bytes = colliders_.bytes();
  colliders_done_ = done && frame == drawn;
  if (settled()) is_out_of_memory = out_of_memory_reported_ = false;
}

std::shared_ptr<const DrawnFrame> WorldCore::frameToRestartFrom() {
  const std::lock_guard lock(mutex);
  // Resets the flag: from now on, a job may request another restart.
  return std::exchange(planner_lost_, false) ? drawn : nullptr;
}

void WorldCore::publish(Plan&& plan) {
  // Jobs have begun some requests of the new queue meanwhile, which must be removed from it. Most of them are removed
  // while the mutex is not locked: the queue is long, and the engine may wait for the mutex.
  std::vector<ChunkKey> begun;
  {
    const std::lock_guard lock(mutex);
    begun = begun_;
  }
  const auto leaveOut = [&plan](std::span<const ChunkKey> keys) {
    if (keys.empty()) return;
    const std::set<ChunkKey> gone(keys.begin(), keys.end());
    std::erase_if(plan.queue, [&](const WorkItem& item) { return gone.contains(item.request.key); });
  };
  leaveOut(begun);
  const std::lock_guard lock(mutex);
  leaveOut(std::span(begun_).subspan(std::min(begun.size(), begun_.size())));
  failed.insert(failed.end(), std::make_move_iterator(plan.failed.begin()), std::make_move_iterator(plan.failed.end()));
  // swap() moves the previous queue into `plan`, so that the previous queue is destroyed only after the mutex is
  // released.
  queue.replace(plan.queue, mayPrefetch(), Clock::now());
  std::swap(queue_edits_, plan.edits);
  step.swap(plan.step);
  if (planned_with_.viewers != planning_with_.viewers) meshing_before_ = meshing_;
  planned_with_ = planning_with_;
  colliders_done_ = passed_over_ = false;
  idle_ = plan.idle && meshing_ == 0 && finished_.empty() && begun_.empty();
  planner_stats = planner_.stats();
  if (planned_with_.applied == applied) edits_drawn = planner_stats.edits_drawn;
  ++plans;
  changed.notify_all();
}

bool WorldCore::isResubmitting() const {
  return std::count(submitting_.begin(), submitting_.end(), std::this_thread::get_id()) > 0;
}

}  // namespace sgm
