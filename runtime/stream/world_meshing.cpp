// The jobs that mesh the planned chunks of a world, and the threads that prefetch chunks from a server.

#include <algorithm>

#include "base/share_priority.h"
#include "chunk/surface_shapes.h"
#include "stream/world_core.h"

namespace sgm {

namespace {

/// After this number of finished requests a plan is made, even if more requests are waiting and the engine does not
/// call update.
constexpr size_t kFinishedToPlan = 64;
constexpr int kMeshPriority = 1, kLookPriority = 1;
static_assert(kMeshPriority <= kSharePriority, "parts of chunks that were finished too late would never be released");

}  // namespace

bool WorldCore::isLooking() const {
  // Requests without free memory (hasRoom()) wait for memory, not for a prefetch, so they do not count here.
  return prefetchers_ != nullptr && !queue.empty() && hasRoom() && !queue.nextReady(queue.size(), Clock::now());
}

bool WorldCore::isOverdue() const {
  return prefetchers_ != nullptr && !passed_over_ && !is_out_of_memory && hasRoom() &&
         queue.nextReady(queue.size(), Clock::now());
}

void WorldCore::scheduleMeshing() {
  // The number of iterations is limited: some job systems run a job immediately, inside submit(), so without a limit,
  // this one call could mesh the whole queue.
  for (size_t more = maxMeshJobs(); more > 0; --more) {
    {
      const std::lock_guard lock(mutex);
      const size_t most = is_out_of_memory ? 1 : maxMeshJobs();
      // After memory ran out for one chunk, the other prefetched chunks are not tried until the next plan.
      if (prefetchers_ != nullptr && passed_over_) return;
      if (stopped_ || mesh_jobs >= most || !hasRoom()) return;
      if (mesh_jobs - meshing_jobs_ >= queue.countReady(Clock::now())) return;
      setMeshJobs(mesh_jobs + 1);
    }
    if (submit(run<&WorldCore::meshOnce>, kMeshPriority)) continue;
    const std::lock_guard lock(mutex);
    setMeshJobs(mesh_jobs - 1);
    return;
  }
}

void WorldCore::scheduleOverdue() {
  if (prefetchers_ != nullptr) scheduleMeshing();
}

void WorldCore::schedulePrefetch() {
  if (prefetchers_ == nullptr) return;
  for (unsigned more = kPrefetchers; more > 0; --more) {
    {
      const std::lock_guard lock(mutex);
      if (stopped_ || look_jobs_ >= kPrefetchers || !mayPrefetch()) return;
      if (look_jobs_ - queue.countLooking() >= queue.countToLook()) return;
      ++look_jobs_;
    }
    if (submit(*prefetchers_, run<&WorldCore::prefetch>, kLookPriority)) continue;
    const std::lock_guard lock(mutex);
    // No prefetching job could be submitted. The requests are then meshed without a prefetch, after they have waited
    // for kPatience.
    --look_jobs_;
    return;
  }
}

void WorldCore::takeItems(size_t batch, std::vector<WorkItem>& items) {
  // A device is efficient only with many chunks per batch; but each idle job should get some, and memory must suffice
  // for all of them.
  const size_t idle = std::max<size_t>(1, maxMeshJobs() - std::min(maxMeshJobs(), meshing_jobs_));
  const auto shareOf = [idle](size_t of) { return (of + idle - 1) / idle; };
  const Clock::time_point now = Clock::now();
  const size_t share = std::max(shareOf(queue.countReady(now)), std::min<size_t>(batch, 8));
  const size_t most =
      is_out_of_memory ? 1 : std::min({batch, share, std::max<size_t>(1, shareOf(room() / largestChunk(settings)))});
  for (auto at = queue.nextReady(queue.size(), now); at && items.size() < most && hasRoom();
       at = queue.nextReady(*at, now)) {
    const WorkItem& next = queue[*at];
    // A batch has requests of one rank only, so that urgent requests do not wait for less urgent ones.
    if (!items.empty() && next.rank != items.front().rank) break;
    try {
      begun_.push_back(next.request.key);
    } catch (const std::bad_alloc&) {
      break;
    }
    ++meshing_;
    ++meshing_of_rank_[static_cast<size_t>(next.rank)];
    reserved_ += largestChunk(settings);
    items.push_back(queue.remove(*at, now));
  }
  if (items.empty()) return;
  countWork();
  ++meshing_jobs_;
}

void WorldCore::surfaceOne(Result<MeshedChunk>& chunk, const WorldState& under, FinishedChunk& done) const {
  if (!chunk) {
    done.error = chunk.error();
    return;
  }
  done.from_disk = chunk->from_disk;
  done.rounded = chunk->rounded;
  if (chunk->voids) done.voids = std::make_unique<const VoidComponents>(std::move(*chunk->voids));
  if (settings.morph) {
    Result<std::pmr::vector<MorphOffset>> morphs =
        morphOffsets(*under.field, chunk->surface.mesh, chunk->surface.grid, under.brushes.get(), memory_);
    if (!morphs) {
      done.error = morphs.error();
      return;
    }
    chunk->surface.morphs = std::move(*morphs);
  }
  if (settings.texture && !chunk->surface.mesh.indices.empty()) {
    Result<Unwrapped> texture =
        unwrapChunk(*under.field, chunk->surface.mesh, chunk->surface.grid, under.brushes.get(), kTile, memory_);
    if (!texture) {
      done.error = texture.error();
      return;
    }
    chunk->surface.texture = std::move(*texture);
  }
  if (const size_t bytes = chunk->surface.bytes(); bytes > largestChunk(settings)) {
    done.error =
        Error{Code::limit, "a chunk has " + std::to_string(bytes) +
                               " bytes with its anchors, morph offsets and texture coordinates, more than the " +
                               std::to_string(largestChunk(settings)) + " that are allowed; place fewer anchors"};
    return;
  }
  if (!chunk->surface.empty()) done.surface = surfaces_->add(std::move(chunk->surface));
}

ChunkMesher WorldCore::mesherOf(const WorldState& under) const {
  return {*under.field,         backend,           jobs,           memory_,         cache.get(),
          settings.baked.get(), settings.resident, settings.sharp, measuring_.get()};
}

void WorldCore::prefetch() {
  for (;;) {
    std::shared_ptr<Look> look;
    std::optional<FoundParts> found;
    try {
      look = std::make_shared<Look>();
    } catch (const std::bad_alloc&) {
      // Out of memory: this prefetching job ends. The requests are then meshed without a prefetch, after they have
      // waited for kPatience.
    }
    std::optional<ChunkRequest> request;
    WorldState under;
    {
      const std::lock_guard lock(mutex);
      if (look != nullptr && !stopped_ && mayPrefetch()) request = queue.beginLook(look, Clock::now());
      if (!request) {
        --look_jobs_;
        return;
      }
      under = queue_edits_;
    }
    const Clock::time_point begun_at = Clock::now();
    try {
      found = mesherOf(under).find(*request, under.brushes.get());
    } catch (const std::bad_alloc&) {
      // Out of memory: the prefetch ends without a result, as if no store had the chunk, so the chunk will be meshed.
    }
    {
      const std::lock_guard lock(mutex);
      const Clock::time_point now = Clock::now();
      queue.endLook(*look, std::move(found), std::chrono::duration<double>(now - begun_at).count(), now);
    }
    scheduleMeshing();
  }
}

MadeMeasures WorldCore::meshItems(std::span<const WorkItem> items, const WorldState& under, const Progress& progress,
                                  std::span<FinishedChunk> done) const {
  const ChunkMesher mesher = mesherOf(under);
  const Clock::time_point begun_at = Clock::now();
  MadeMeasures measured;
  const Error out_of_memory{Code::out_of_memory, kOutOfMemory};
  try {
    std::vector<MeshOrder> orders;
    for (const WorkItem& item : items)
      orders.push_back({item.request, item.before.get(), item.look && item.look->found ? &*item.look->found : nullptr});
    std::vector<Result<MeshedChunk>> chunks = mesher.mesh(orders, under.brushes.get(), progress);
    for (const Result<MeshedChunk>& chunk : chunks) {
      if (chunk) measured.add(chunk->measured);
    }
    const double seconds = std::chrono::duration<double>(Clock::now() - begun_at).count();
    measured.meshing = std::max(0.0, seconds - measured.measuring);
    parallelFor(jobs, items.size(), [&](size_t i) {
      try {
        surfaceOne(chunks[i], under, done[i]);
      } catch (const std::bad_alloc&) {
        done[i].error = out_of_memory;
      }
    });
  } catch (const std::bad_alloc&) {
    for (FinishedChunk& chunk : done) {
      if (chunk.surface == nullptr) chunk.error = out_of_memory;
    }
  }
  return measured;
}

void WorldCore::meshOnce() {
  std::vector<WorkItem> items;
  std::vector<FinishedChunk> done;
  const size_t batch = backend.batch();
  try {
    items.reserve(batch);
    done.reserve(batch);
  } catch (const std::bad_alloc&) {
    return endMeshJob();
  }
  WorldState under;
  uint64_t of_generation;
  {
    const std::lock_guard lock(mutex);
    // Inside resubmit() the job takes no requests: otherwise jobs nested in each other could mesh the whole queue in
    // one call.
    if (!isResubmitting()) takeItems(batch, items);
    under = queue_edits_;
    of_generation = generation;
  }
  if (items.empty()) return endMeshJob();
  schedulePrefetch();
  for (const WorkItem& item : items) {
    done.emplace_back();
    done.back().request = item.request;
    done.back().before = item.before;
    done.back().edits = under.number;
  }
  // Progress callback that cancels the rest of a batch when its results are no longer needed.
  const auto wanted = [&](uint64_t, uint64_t) {
    const std::lock_guard lock(mutex);
    return !stopped_ && generation == of_generation;
  };
  const Clock::time_point begun_at = Clock::now();
  const MadeMeasures measured = meshItems(items, under, items.size() > 1 ? Progress(wanted) : Progress(), done);
  const double seconds = std::chrono::duration<double>(Clock::now() - begun_at).count();
  const double share = seconds / static_cast<double>(items.size());
  turns_->earn(seconds);
  bool plan, more, out_of_memory = false;
  {
    const std::lock_guard lock(mutex);
    const WorkItem::Rank rank = items.front().rank;
    if (settings.measure) made.add(measured);
    countWork();
    --meshing_jobs_;
    meshing_ -= items.size();
    const size_t left_of_rank = meshing_of_rank_[static_cast<size_t>(rank)] -= items.size();
    meshing_before_ -= std::min(meshing_before_, items.size());
    reserved_ -= items.size() * largestChunk(settings);
    for (size_t i = 0; i < done.size(); ++i) {
      FinishedChunk& chunk = done[i];
      if (!chunk.error && chunk.request.body) {
        const double looking = items[i].look ? items[i].look->seconds : 0;
        auto& mesh = times.mesh[static_cast<size_t>(chunk.request.key.level)];
        chunk.from_disk ? times.read.add(share + looking) : mesh.add(share);
      }
      if (generation != of_generation) chunk.error = Error{Code::cancelled, "unwanted"};
      out_of_memory = out_of_memory || (chunk.error && chunk.error->code == Code::out_of_memory);
      if (!chunk.error) is_out_of_memory = false;
      const ChunkKey key = chunk.request.key;
      try {
        finished_.push_back(std::move(chunk));
      } catch (const std::bad_alloc&) {
        // The result is lost, but the planner would wait for this chunk forever, even after a restart that still sees
        // it in begun_. So it is removed from begun_, and the planner restarts.
        planner_lost_ = out_of_memory = true;
        std::erase(begun_, key);
      }
    }
    // A plan is made as soon as the last request of a rank is finished (for example the last edited chunk), so that
    // these chunks are drawn soon.
    const bool rank_done = left_of_rank == 0 && (queue.empty() || queue.mostUrgent().rank > rank);
    plan = !out_of_memory && (rank_done || finished_.size() >= kFinishedToPlan || queue.empty());
    // After memory ran out once, meshing continues, because less urgent chunks may need less; after the second time it
    // stops until the next plan.
    const bool goes_on = !out_of_memory || !std::exchange(passed_over_, true);
    more = goes_on && queue.nextReady(queue.size(), Clock::now()) && hasRoom() && !stopped_;
  }
  if (out_of_memory) reportOutOfMemory();
  if (plan) schedulePlanner();
  if (more) {
    meshAgain();
  } else {
    endMeshJob();
  }
}

void WorldCore::meshAgain() {
  bool submitted = false;
  resubmit([&] { return submitted = submit(run<&WorldCore::meshOnce>, kMeshPriority); });
  if (!submitted) return endMeshJob();
  turns_->startDue();
}

void WorldCore::endMeshJob() {
  {
    const std::lock_guard lock(mutex);
    setMeshJobs(mesh_jobs - 1);
  }
  turns_->startDue();
}

}  // namespace sgm
