#pragma once
// A streamed world: meshed around its viewers on the job system, passed to an engine frame by frame.
//
//   engine's thread            jobs
//   setViewers, update  --->   plan (planner.h): which chunks to mesh, and the next frame
//   edit, setField      --->   mesh (mesh_chunks.h): each job meshes a request or a device batch, urgent ones first
//   poll events         <---   write the journal of edits
//
// If a store is on a server, the world's own threads look there for chunks before a job takes the request
// (work_queue.h). All sides share a mailbox (world_core.h) behind one mutex that is held only for short work. update()
// waits for nothing else, so the engine never waits for a job or a device.

#include <memory>
#include <mutex>
#include <span>
#include <unordered_map>
#include <vector>

#include "backend/backend.h"
#include "chunk/world_measures.h"
#include "query/queries.h"
#include "store/cache/baked_parts.h"
#include "store/cache/disk_cache.h"
#include "stream/byte_credit.h"
#include "stream/edits/world_edits.h"
#include "stream/field_switch.h"
#include "stream/make/collider.h"
#include "stream/plan/plan_turns.h"
#include "stream/plan/planner.h"
#include "stream/world_settings.h"
#include "stream/world_times.h"
#include "world/world_field.h"

namespace sgm {

/// An event for the engine, in order. Between two updates the changes of a whole frame arrive, or none.
struct WorldEvent {
  enum class Kind {
    ready,             ///< a surface to upload; it is not drawn yet
    shown,             ///< draw it from now on
    replaced,          ///< draw the last ready surface instead of the previous one
    seams,             ///< draw other seams of the same surface, or the same seams among other neighbours
    removed,           ///< stop drawing it, and forget it; also for a surface that was ready and never shown
    failed,            ///< the chunk cannot be made: the coarser chunk stays in its place
    collider,          ///< use this collider instead of the chunk's previous one
    collider_removed,  ///< the chunk has no collider any more
  };
  Kind kind = Kind::ready;
  ChunkKey key;
  std::shared_ptr<const ChunkSurface> surface;  ///< for ready
  uint8_t seams = 0;                            ///< the drawn seams, bit (1 << Face)
  Neighbourhood coarser = 0;                    ///< as DrawnChunk::coarser
  uint64_t frame = 0;                           ///< the frame of the change; 0 for ready and failed
  std::optional<Error> error;                   ///< for failed
  std::shared_ptr<const Collider> collider{};   ///< for collider
};

struct WorldStats {
  PlannerStats planner;
  size_t queued = 0, in_work = 0;  ///< requests
  size_t stale = 0;                ///< of these, the ones planned for previous viewers
  uint64_t frame = 0;              ///< number of the drawn frame
  uint64_t plans = 0;
  uint64_t edits = 0, edits_drawn = 0;  ///< WorldState::number of the current and of the drawn state
  FieldSwitch::Turn fields;             ///< numbers of setField() calls
  DiskCacheStats cache;
  BakedStats baked;
  size_t surface_bytes = 0, peak_surface_bytes = 0;
  size_t collider_bytes = 0;
  bool idle = false;  ///< everything that the viewers want is drawn
};

class WorldCore;

inline constexpr size_t kMostViewers = 256;

/// Thread-safe, except that update, poll and waitIdle must not run concurrently.
class World {
 public:
  /// Creates a world, and reads the journal if settings name one. Errors: invalid_argument; limit (mesh_bytes is too
  /// small, or the distances are too large: the message names values that work); those of WorldEdits::open. backend,
  /// jobs and memory must outlive the world; surfaces may outlive it, but not memory. turns: shared by all worlds on
  /// these jobs; null: this is the only world.
  static Result<std::unique_ptr<World>> create(std::shared_ptr<const WorldField> field, Backend& backend,
                                               JobSystem& jobs, const WorldSettings& settings,
                                               std::pmr::memory_resource* memory,
                                               std::shared_ptr<PlanTurns> turns = nullptr);
  /// Waits for jobs that have begun, and up to about a second for a pending server request; jobs that the job system
  /// runs later do nothing.
  ~World();
  World(const World&) = delete;
  World& operator=(const World&) = delete;

  /// Replaces all viewers. Without viewers the drawn frame stays, and nothing is meshed. On error nothing changes.
  /// Errors: those of checkViewer; limit (more than kMostViewers).
  Result<void> setViewers(std::span<const Viewer> viewers);

  /// Takes over finished work, at most `bytes` of new surfaces and max_colliders (settings) colliders, and starts more
  /// work. A larger surface is still handed over, as the first of an update; later updates compensate, so that any
  /// successive updates hand over at most their bytes plus one surface (byte_credit.h). Never waits. While events of
  /// the previous update are unpolled, it returns false and only schedules a write of the journal.
  bool update(size_t bytes);

  /// Passes the next events to `take`, in order, until it returns false or none is left. An event that `take` refused,
  /// or for which it threw, comes first the next time.
  void poll(const std::function<bool(const WorldEvent&)>& take);

  /// The frame of the last update that took over a frame.
  std::shared_ptr<const DrawnFrame> drawn() const;

  /// Updates without a byte limit until everything that the viewers want is drawn; the calling thread works, too.
  /// Events accumulate meanwhile, so poll first. `more` is called now and then; returning false cancels. Errors:
  /// cancelled; limit (not enough memory).
  Result<void> waitIdle(const std::function<bool()>& more = {});

  /// Replaces the world's field: other parameters, an edited grammar, or other host fields. Chunks that the difference
  /// reaches (field_change.h) are meshed again and replaced in one frame; others keep their meshes. Without viewers the
  /// switch waits. If a chunk cannot be made (WorldEvent::failed), the world returns to the previous field. If fields
  /// arrive faster than they can be drawn, only the last one is used. Edits stay, and keep the numbers of their
  /// materials and tags. Never waits. On error nothing changes. Errors: invalid_argument (another finest cell, or
  /// anything that create() refuses).
  Result<void> setField(std::shared_ptr<const WorldField> field);

  /// Drops all requests; results of running ones are dropped, too. The next update begins anew for the current viewers.
  void cancel();

  /// Lays a brush, undoes an edit (as EditLog), or imports another world's edits. The result is drawn at the latest two
  /// frames of changes later. None of these waits for a job or the disk.
  Result<EditId> edit(const Brush& brush);
  Result<EditId> undo(EditId id);
  Result<void> importEdits(std::span<const std::byte> bytes);
  /// All edits except the first `since`, in order of arrival, for another world's importEdits().
  std::vector<std::byte> exportEdits(uint64_t since = 0) const;
  uint64_t editCount() const;
  /// A hash of the set of edits: worlds that have exchanged their edits have equal hashes.
  uint64_t editHash() const;
  /// Blocks until all edits so far are on disk. Errors: io.
  Result<void> flushEdits();

  /// The current field, from which the next chunks are meshed. A newer one may be about to replace it.
  std::shared_ptr<const WorldField> field() const;
  /// The current field with the current edits, for queries at a level. Must not outlive its memory.
  QueryField queryField(int level = 0) const;

  /// The hash of the set of bodies (hashParts) of a level's chunks that meet lo <= p < hi. Meshes chunks that are not
  /// drawn. Errors: those of chunksOfRegion and meshChunks.
  Result<ContentHash> hashBodies(const IntBox& region, int level) const;

  WorldStats stats() const;

  /// The viewers of the last setViewers().
  std::vector<Viewer> viewers() const;
  WorldTimes times() const;
  const WorldSettings& settings() const;

  /// The current measures; nullopt if the settings do not ask for them. Takes some microseconds per hundred drawn
  /// chunks.
  std::optional<WorldMeasures> measures() const;

 private:
  World(std::unique_ptr<WorldCore> core, JobSystem& jobs);
  void advance(size_t bytes, size_t colliders);
  /// Emits the next changes of colliders. Precondition: the core's mutex is held.
  void tellColliders(size_t most);
  /// Removes surfaces that were handed over for the staged step, but are not part of the new frame.
  void restage(const std::shared_ptr<const FrameStep>& step, const DrawnFrame& frame);
  bool wasHanded(const DrawnChunk& chunk) const;
  /// The bytes of the step's surfaces that have not been handed over.
  size_t bytesLeft(const FrameStep& step) const;
  /// Whether all of the step's surfaces have been handed over.
  bool handOver(const FrameStep& step);
  /// Hands over surfaces of a step and, once all are handed over, its changes; then returns true.
  bool stage(const std::shared_ptr<const FrameStep>& step);

  std::unique_ptr<WorldCore> core_;
  JobSystem& jobs_;
  // The engine's side, guarded by front_.
  mutable std::mutex front_;
  std::vector<WorldEvent> events_;
  size_t polled_ = 0;
  ByteCredit credit_;
  std::shared_ptr<const FrameStep> staged_;
  size_t staged_changes_ = 0;  ///< changes of staged_ whose surfaces have been handed over
  std::unordered_map<ChunkKey, std::shared_ptr<const ChunkSurface>, ChunkKeyHash> handed_;
};

}  // namespace sgm
