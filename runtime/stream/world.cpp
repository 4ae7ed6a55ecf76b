#include "stream/world.h"

#include <algorithm>
#include <chrono>
#include <limits>
#include <random>
#include <unordered_set>

#include "base/checksum.h"
#include "mesh/hash.h"
#include "stream/world_checks.h"
#include "stream/world_core.h"

namespace sgm {

namespace {

constexpr size_t kHashedAtOnce = 256;
/// Maximum number of failed chunks that one update reports; memory is reserved for as many events.
constexpr ptrdiff_t kFailedAtOnce = 64;
/// waitIdle returns an error after this number of successive checks without progress.
constexpr int kLooksInVain = 2000;
constexpr auto kBetweenLooks = std::chrono::milliseconds(2);

/// Measures the duration of a call.
class TimedCall {
 public:
  TimedCall(WorldCore& core, TimeHistogram WorldTimes::*of) : core_(core), of_(of) {}
  ~TimedCall() {
    const double seconds = std::chrono::duration<double>(Clock::now() - begun_).count();
    const std::lock_guard lock(core_.mutex);
    (core_.times.*of_).add(seconds);
  }
  TimedCall(const TimedCall&) = delete;
  TimedCall& operator=(const TimedCall&) = delete;

 private:
  using Clock = std::chrono::steady_clock;
  WorldCore& core_;
  TimeHistogram WorldTimes::*of_;
  Clock::time_point begun_ = Clock::now();
};

uint64_t randomAuthor() {
  std::random_device device;
  return (uint64_t{device()} << 32 | device()) | 1;  // a random number that is never 0, because author 0 means "none"
}

/// Creates the threads that prefetch chunks from servers. If no thread can be started, servers are not used.
std::unique_ptr<JobSystem> makePrefetchers(const Profiler& profiler, const WorldSettings& settings) {
  Result<std::unique_ptr<JobSystem>> prefetchers = makeThreadPool(WorldCore::kPrefetchers + 1, profiler, "sgm store");
  if (prefetchers) return std::move(*prefetchers);
  if (settings.on_warning) {
    settings.on_warning("baked worlds cannot be read from a server (" + prefetchers.error().message +
                        "): chunks are derived instead");
  }
  return nullptr;
}

Result<void> openJournal(WorldCore& core) {
  const std::shared_ptr<const WorldField> field = core.edits.state().field;
  const std::optional<std::vector<std::byte>> identity = field->identity();
  if (!identity) return Error{Code::unsupported, "a world without a grammar cannot have an edit journal"};
  const WorldFieldSettings& of = field->settings();
  const FormerGrammar former = [&] { return checksum(*field->formerIdentity()); };
  const Result<std::string> opened =
      core.edits.open(core.settings.journal, {checksum(*identity), of.seed, of.finest_cell}, former);
  if (!opened) return opened.error();
  if (!opened->empty() && core.settings.on_warning) core.settings.on_warning(*opened);
  return {};
}

}  // namespace

World::World(std::unique_ptr<WorldCore> core, JobSystem& jobs) : core_(std::move(core)), jobs_(jobs) {}

Result<std::unique_ptr<World>> World::create(std::shared_ptr<const WorldField> field, Backend& backend, JobSystem& jobs,
                                             const WorldSettings& settings, std::pmr::memory_resource* memory,
                                             std::shared_ptr<PlanTurns> turns) {
  if (Result<void> good = checkWorld(*field, settings, jobs.concurrency()); !good) return good.error();
  WorldSettings own = settings;
  if (own.edits.author == 0) own.edits.author = randomAuthor();
  std::unique_ptr<JobSystem> prefetchers;
  if (own.baked != nullptr && own.baked->isFar()) prefetchers = makePrefetchers(field->profiler(), own);
  if (turns == nullptr) turns = std::make_shared<PlanTurns>(jobs);
  auto core = std::make_unique<WorldCore>(std::move(field), backend, jobs, std::move(turns), own,
                                          std::move(prefetchers), memory);
  if (!own.journal.empty()) {
    if (Result<void> opened = openJournal(*core); !opened) return opened.error();
  }
  if (!own.cache.empty()) {
    Result<std::unique_ptr<DiskCache>> opened = DiskCache::open(own.cache, own.cache_bytes, own.on_warning, memory);
    if (!opened) return opened.error();
    core->cache = std::move(*opened);
  }
  return std::unique_ptr<World>(new World(std::move(core), jobs));
}

World::~World() { core_->stop(); }

Result<void> World::setViewers(std::span<const Viewer> viewers) {
  if (viewers.size() > kMaxViewers) {
    return Error{Code::limit, "a world has at most " + std::to_string(kMaxViewers) + " viewers"};
  }
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
  const TimedCall timed(*core_, &WorldTimes::update);
  const std::lock_guard front(front_);
  core_->scheduleJournal();
  if (polled_ < events_.size()) return false;
  events_.clear();
  polled_ = 0;
  advance(bytes, core_->settings.max_colliders);
  return true;
}

void World::tellColliders(size_t most) {
  std::vector<ColliderChange>& changes = core_->collider_changes;
  events_.reserve(events_.size() + changes.size());
  size_t told = 0;
  for (; told < changes.size() && (most > 0 || changes[told].collider == nullptr); ++told) {
    ColliderChange& change = changes[told];
    const bool is_new = change.collider != nullptr;
    most -= is_new ? 1 : 0;
    const auto kind = is_new ? WorldEvent::Kind::collider : WorldEvent::Kind::collider_removed;
    events_.push_back({kind, change.key, nullptr, 0, 0, 0, {}, std::move(change.collider)});
  }
  changes.erase(changes.begin(), changes.begin() + static_cast<ptrdiff_t>(told));
}

void World::advance(size_t bytes, size_t colliders) {
  credit_.begin(bytes);
  std::shared_ptr<const FrameStep> step;
  std::shared_ptr<const DrawnFrame> stays;
  events_.reserve(events_.size() + kFailedAtOnce);
  {
    const std::lock_guard lock(core_->mutex);
    if (core_->settled() && core_->failed.empty() && staged_ == nullptr) return;
    if (core_->step == nullptr) stays = core_->drawn;
    if (core_->step != nullptr && core_->step->from == core_->applied) step = core_->step;
    core_->in_hand = {step != nullptr ? step->to->number : 0, staged_ != nullptr ? staged_->to->number : 0};
    const auto told = core_->failed.end() - std::min<ptrdiff_t>(kFailedAtOnce, std::ssize(core_->failed));
    for (auto chunk = told; chunk != core_->failed.end(); ++chunk) {
      events_.push_back({WorldEvent::Kind::failed, chunk->key, nullptr, 0, 0, 0, std::move(chunk->error)});
    }
    core_->failed.erase(told, core_->failed.end());
    tellColliders(colliders);
  }
  if (stays != nullptr && staged_ != nullptr) restage(nullptr, *stays);
  // The new step usually replaces the step that the engine has begun to receive. Exception: the engine keeps the old
  // step if no more bytes are left to deliver for the old step than for the new one. Without this exception, if meshing
  // were faster than the delivery of surfaces, steps would grow and never complete. A new step with newer edits is
  // never postponed, because edits must appear in one of the next two new frames.
  if (step != nullptr && staged_ != nullptr && step != staged_ && staged_->from == step->from &&
      staged_->to->edits == step->to->edits && handed_.bytesLeft(*staged_) <= handed_.bytesLeft(*step)) {
    step = staged_;
  }
  if (step != nullptr && stage(step)) {
    const std::lock_guard lock(core_->mutex);
    core_->applied = step->to->number;
    core_->drawn = step->to;
    core_->edits_drawn = step->to->edits;
  }
  if (core_->planIsDue()) {
    core_->schedulePlanner();
  } else {
    core_->scheduleOverdue();
  }
  // Called even if this world needs no plan: another world may wait for its turn to plan (plan_turns.h), and the turn
  // may have come since the last call, merely because time has elapsed.
  core_->startDuePlans();
  core_->scheduleFieldSwitch();
}

void World::restage(const std::shared_ptr<const FrameStep>& step, const DrawnFrame& frame) {
  // Surfaces that were delivered for an abandoned step are removed, unless the new frame contains them too.
  std::unordered_set<ChunkKey, ChunkKeyHash> drawn;
  for (const DrawnChunk& chunk : frame.drawn) drawn.insert(chunk.key);
  if (staged_ != nullptr) {
    events_.reserve(events_.size() + staged_->changes.size());
    for (const FrameChange& change : staged_->changes) {
      const ChunkKey& key = change.chunk.key;
      if (change.kind != FrameChange::Kind::shown || drawn.contains(key) || !handed_.remove(key)) continue;
      events_.push_back({WorldEvent::Kind::removed, key, nullptr, 0, 0, 0, {}});
    }
  }
  staged_ = step;
  staged_changes_ = 0;
}

bool World::handOver(const FrameStep& step) {
  // memory is reserved first, because the event of a delivered surface must not be lost
  events_.reserve(events_.size() + step.changes.size() - staged_changes_);
  for (; staged_changes_ < step.changes.size(); ++staged_changes_) {
    const DrawnChunk& chunk = step.changes[staged_changes_].chunk;
    if (chunk.surface == nullptr || handed_.has(chunk)) continue;
    const size_t size = chunk.surface->mesh.bytes();
    if (!credit_.admits(size)) return false;
    handed_.add(chunk);
    events_.push_back({WorldEvent::Kind::ready, chunk.key, chunk.surface, 0, 0, 0, {}});
    credit_.take(size);
  }
  return true;
}

bool World::stage(const std::shared_ptr<const FrameStep>& step) {
  if (step != staged_) restage(step, *step->to);
  if (!handOver(*step)) return false;
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
  // Memory for all events is reserved first, so that either all changes of a step are reported or none.
  events_.reserve(events_.size() + step->changes.size());
  for (const FrameChange& change : step->changes) {
    if (change.kind == FrameChange::Kind::removed) handed_.remove(change.chunk.key);
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
  const TimedCall timed(*core_, &WorldTimes::poll);
  const std::lock_guard front(front_);
  for (; polled_ < events_.size() && take(events_[polled_]); ++polled_) {
    events_[polled_].surface = nullptr;
    events_[polled_].collider = nullptr;
  }
}

std::shared_ptr<const DrawnFrame> World::drawn() const {
  const std::lock_guard lock(core_->mutex);
  return core_->drawn;
}

Result<void> World::waitIdle(const std::function<bool()>& more) {
  const std::lock_guard front(front_);
  uint64_t frame = 0, finished = 0;
  for (int in_vain = 0; in_vain < kLooksInVain; ++in_vain) {
    core_->scheduleJournal();
    const size_t events = events_.size();
    advance(std::numeric_limits<size_t>::max(), std::numeric_limits<size_t>::max());
    if (events_.size() > events) in_vain = 0;
    std::unique_lock lock(core_->mutex);
    if (core_->settled() && core_->failed.empty()) return {};
    if (((core_->mesh_jobs > 0 || core_->isLooking()) && !core_->is_out_of_memory) || core_->fields.busy() ||
        core_->applied != frame || core_->planner_stats.meshed + core_->planner_stats.seam_jobs != finished)
      in_vain = 0;
    frame = core_->applied;
    finished = core_->planner_stats.meshed + core_->planner_stats.seam_jobs;
    const uint64_t plans = core_->plans;
    // Limits the wait: if no job is running, a plan becomes due only when time elapses.
    const auto look_again = std::chrono::steady_clock::now() + kBetweenLooks;
    helpUntil(jobs_, lock, core_->changed, [&] {
      return core_->plans != plans || core_->settled() || std::chrono::steady_clock::now() >= look_again;
    });
    lock.unlock();
    if (more && !more()) return Error{Code::cancelled, "the wait was cancelled"};
  }
  return Error{Code::limit, "mesh_bytes is used up: poll the events, release meshes, or raise it"};
}

Result<void> World::setField(std::shared_ptr<const WorldField> field) {
  if (Result<void> good = checkSuccessor(*field, *this->field(), core_->settings); !good) return good;
  core_->fields.want(std::move(field));
  return {};
}

void World::cancel() {
  std::vector<WorkItem> dropped;  // declared before the lock, so that it is destroyed after the mutex is released
  const std::lock_guard lock(core_->mutex);
  core_->queue.replace(dropped, true, std::chrono::steady_clock::now());
  ++core_->generation;
  ++core_->viewers_set;  // so that the next update requests a new plan
}

Result<ContentHash> World::hashBodies(const IntBox& region, int level) const {
  const WorldState edits = core_->edits.state();
  const Result<std::pmr::vector<ChunkKey>> keys =
      chunksOfRegion(*edits.field, region, level, std::numeric_limits<uint64_t>::max());
  if (!keys) return keys.error();
  std::shared_ptr<const DrawnFrame> frame;
  {
    const std::lock_guard lock(core_->mutex);
    if (core_->edits_drawn == edits.number) frame = core_->drawn;
  }
  ContentHash sum;
  const auto add = [&sum](ContentHash body, const ChunkGrid& grid) {
    const ContentHash placed = hashPlaced(body, grid, 0);
    sum.a += placed.a;
    sum.b += placed.b;
  };
  std::vector<ChunkRequest> rest;
  for (const ChunkKey& key : *keys) {
    const std::shared_ptr<const ChunkSurface> surface = frame ? frame->find(key) : nullptr;
    if (surface == nullptr) {
      rest.emplace_back().key = key;
      rest.back().sharp = core_->settings.sharp;
      rest.back().keys = false;
    } else if (surface->mesh.ranges[0].index_count > 0) {
      add(surface->mesh.ranges[0].hash, surface->grid);
    }
  }
  // Meshes kHashedAtOnce chunks at a time, to limit memory: only the hash of each mesh is kept.
  for (size_t first = 0; first < rest.size(); first += kHashedAtOnce) {
    const auto some = std::span(rest).subspan(first, std::min(kHashedAtOnce, rest.size() - first));
    const Result<std::pmr::vector<PlacedChunk>> chunks =
        meshChunks(*edits.field, core_->backend, core_->jobs, some, {}, edits.brushes.get());
    if (!chunks) return chunks.error();
    for (const PlacedChunk& chunk : *chunks) {
      if (!chunk.mesh.body.indices.empty()) add(chunk.mesh.body.hash, chunk.grid);
    }
  }
  return sum;
}

Result<EditId> World::edit(const Brush& brush) { return core_->edits.add(brush); }

Result<EditId> World::undo(EditId id) { return core_->edits.undo(id); }

Result<void> World::importEdits(std::span<const std::byte> bytes) { return core_->edits.import(bytes); }

std::vector<std::byte> World::exportEdits(uint64_t since) const { return core_->edits.exportBytes(since); }

uint64_t World::editCount() const { return core_->edits.size(); }

uint64_t World::editHash() const { return core_->edits.hash(); }

Result<void> World::flushEdits() { return core_->edits.flush(); }

std::shared_ptr<const WorldField> World::field() const { return core_->edits.state().field; }

QueryField World::queryField(int level) const {
  const WorldState now = core_->edits.state();
  return {[now, level](const IntBox& box) { return now.field->compile(box, level, now.brushes.get()); },
          now.field->settings().finest_cell, now.field->memory(), !now.field->settings().hosts.empty()};
}

std::optional<WorldMeasures> World::measures() const {
  if (!core_->settings.measure) return std::nullopt;
  WorldMeasures measures;
  std::shared_ptr<const DrawnFrame> frame;
  {
    const std::lock_guard lock(core_->mutex);
    measures.made = core_->made;
    frame = core_->drawn;
  }
  measures.drawn = measuresOf(*frame);
  return measures;
}

std::vector<Viewer> World::viewers() const {
  const std::lock_guard lock(core_->mutex);
  return core_->viewers;
}

WorldTimes World::times() const {
  const std::lock_guard lock(core_->mutex);
  core_->countWork();
  return core_->times;
}

const WorldSettings& World::settings() const { return core_->settings; }

WorldStats World::stats() const {
  WorldStats stats;
  if (core_->cache != nullptr) stats.cache = core_->cache->stats();
  if (core_->settings.baked != nullptr) stats.baked = core_->settings.baked->stats();
  const std::lock_guard lock(core_->mutex);
  stats.planner = core_->planner_stats;
  const WorldCore::Work work = core_->work();
  stats.queued = work.queued;
  stats.in_work = work.in_work;
  stats.fields = core_->fields.turn();
  stats.stale = work.stale;
  stats.frame = core_->applied;
  stats.plans = core_->plans;
  stats.edits = core_->edits.number();
  stats.edits_drawn = core_->edits_drawn;
  stats.surface_bytes = core_->surfaces().bytes();
  stats.collider_bytes = core_->collider_bytes;
  stats.peak_surface_bytes = core_->surfaces().peakBytes();
  stats.idle = core_->settled();
  return stats;
}

}  // namespace sgm
