#pragma once
// A streamed world: jobs mesh chunks around its viewers, and an engine receives them frame by frame.
//
//   engine's thread            jobs
//   setViewers, update  --->   plan (planner.h): which chunks to mesh, and the next frame
//   edit, setField      --->   mesh (mesh_chunks.h): each job meshes a request or a device batch, urgent ones first
//   poll events         <---   write the journal of edits
//
// If a store is on a server, threads of the world prefetch chunks from it before jobs mesh them (work_queue.h).
//
// Engine and jobs exchange data through a shared structure (world_core.h), whose mutex is held only briefly. update()
// waits for nothing else, so the engine never waits for a job or a device.

#include <memory>
#include <mutex>
#include <span>
#include <vector>

#include "backend/backend.h"
#include "chunk/world_measures.h"
#include "query/queries.h"
#include "store/cache/baked_parts.h"
#include "store/cache/disk_cache.h"
#include "stream/byte_credit.h"
#include "stream/edits/world_edits.h"
#include "stream/field_switch.h"
#include "stream/handed_surfaces.h"
#include "stream/make/collider.h"
#include "stream/plan/plan_turns.h"
#include "stream/plan/planner.h"
#include "stream/world_settings.h"
#include "stream/world_times.h"
#include "world/world_field.h"

namespace sgm {

/// An event for the engine; events must be processed in order. Between two updates, either all changes of a frame are
/// delivered or none.
struct WorldEvent {
  enum class Kind {
    ready,     ///< upload this surface, but do not draw it yet
    shown,     ///< start to draw the chunk, with the surface of its last `ready` event
    replaced,  ///< draw the surface of the chunk's last `ready` event instead of its previous surface
    seams,  ///< draw the same surface with other seams; or the seams stay, and only `coarser` (see below) has changed
    /// stop drawing the chunk, and release its surface; also sent for a surface that was ready but never shown
    removed,
    failed,            ///< the chunk cannot be made: a coarser chunk stays in its place
    collider,          ///< use this collider instead of the chunk's previous one
    collider_removed,  ///< the chunk no longer has a collider
  };
  Kind kind = Kind::ready;
  ChunkKey key;
  std::shared_ptr<const ChunkSurface> surface;  ///< the surface to upload; set only for `ready`
  uint8_t seams = 0;                            ///< mask of the drawn seams: bit (1 << Face)
  Neighbourhood coarser = 0;                    ///< blocks around the chunk that belong to coarser chunks
                                                ///< (DrawnChunk::coarser)
  /// number of the frame that contains the change; 0 for ready and failed
  uint64_t frame = 0;
  std::optional<Error> error;                  ///< the reason; set only for `failed`
  std::shared_ptr<const Collider> collider{};  ///< the collider to use; set only for `collider`
};

struct WorldStats {
  PlannerStats planner;
  size_t queued = 0, in_work = 0;  ///< number of requests that wait, and number of requests in progress
  size_t stale = 0;                ///< number of waiting or running requests that were planned for previous viewers
  uint64_t frame = 0;              ///< number of the drawn frame
  uint64_t plans = 0;
  /// numbers (WorldState::number) of the current edit state, and of the drawn one
  uint64_t edits = 0, edits_drawn = 0;
  FieldSwitch::Turn fields;  ///< numbers of the last setField() call, and of the call whose field is drawn
  DiskCacheStats cache;
  BakedStats baked;
  size_t surface_bytes = 0, peak_surface_bytes = 0;
  size_t collider_bytes = 0;
  bool idle = false;  ///< true if everything that the viewers need is drawn
};

class WorldCore;

inline constexpr size_t kMaxViewers = 256;

/// A world that is streamed to one engine. Thread-safe, except that calls of update, poll and waitIdle must not run
/// concurrently.
class World {
 public:
  /// Creates a world, and reads the journal if the settings name one. backend, jobs and memory must outlive the world;
  /// memory must also outlive the surfaces, which may outlive the world. turns: the scheduler of plans, shared by all
  /// worlds that use this job system; null: this is the only world. Errors: invalid_argument; limit (mesh_bytes is too
  /// small, or the distances are too large: the message suggests values); those of WorldEdits::open.
  static Result<std::unique_ptr<World>> create(std::shared_ptr<const WorldField> field, Backend& backend,
                                               JobSystem& jobs, const WorldSettings& settings,
                                               std::pmr::memory_resource* memory,
                                               std::shared_ptr<PlanTurns> turns = nullptr);
  /// Waits for running jobs, and up to about a second for a pending request to a server. Jobs that the job system
  /// starts later do nothing.
  ~World();
  World(const World&) = delete;
  World& operator=(const World&) = delete;

  /// Replaces all viewers. Without viewers the drawn frame stays, and nothing is meshed. On error nothing changes.
  /// Errors: those of checkViewer; limit (more than kMaxViewers).
  Result<void> setViewers(std::span<const Viewer> viewers);

  /// Collects finished work, and starts new work. Emits events for at most `bytes` bytes of new surfaces, and for at
  /// most max_colliders (settings) colliders. A surface larger than `bytes` is delivered as the first one of an update;
  /// afterwards, updates deliver less. So any series of updates delivers at most the sum of their `bytes` plus one
  /// surface (byte_credit.h). Never waits. If events of the previous update were not all polled, returns false and only
  /// schedules a write of the journal.
  bool update(size_t bytes);

  /// Calls `take` with the next events, in order, until it returns false or no event is left. If `take` returns false
  /// or throws for an event, the next call starts with this event.
  void poll(const std::function<bool(const WorldEvent&)>& take);

  /// Returns the frame that the engine draws since the last completed step.
  std::shared_ptr<const DrawnFrame> drawn() const;

  /// Updates without a byte limit until everything that the viewers need is drawn; the calling thread helps with the
  /// work. Events accumulate in the meantime, so poll all pending events before the call. `more` is called from time to
  /// time; if it returns false, the wait is cancelled. Errors: cancelled; limit (not enough memory).
  Result<void> waitIdle(const std::function<bool()>& more = {});

  /// Replaces the world's field by a field with other parameters, an edited grammar, or other host fields. The chunks
  /// that the difference affects (field_change.h) are meshed again and replaced in one frame; the others keep their
  /// meshes. Without viewers the switch waits. If a chunk cannot be made (WorldEvent::failed), the world returns to the
  /// previous field. If fields arrive faster than they can be drawn, only the last one is used. Edits stay, and keep
  /// the numbers of their materials and tags. Never waits. On error nothing changes. Errors: invalid_argument (another
  /// finest cell size, or anything that create() rejects).
  Result<void> setField(std::shared_ptr<const WorldField> field);

  /// Discards all waiting requests, and the results of those in progress. The next update plans again for the current
  /// viewers.
  void cancel();

  /// Functions for edits: add a brush, undo an edit (as in EditLog), import the edits of another world. The result
  /// appears in one of the next two new frames. These functions never wait for a job or the disk.
  Result<EditId> edit(const Brush& brush);
  Result<EditId> undo(EditId id);
  Result<void> importEdits(std::span<const std::byte> bytes);
  /// Returns all edits except the first `since`, in order of arrival, as bytes for importEdits() of another world.
  std::vector<std::byte> exportEdits(uint64_t since = 0) const;
  uint64_t editCount() const;
  /// Returns a hash of the set of edits: worlds that have exchanged their edits have equal hashes.
  uint64_t editHash() const;
  /// Blocks until all edits so far are on disk. Errors: io.
  Result<void> flushEdits();

  /// Returns the field from which chunks are meshed now. A newer field may be waiting to replace it.
  std::shared_ptr<const WorldField> field() const;
  /// Returns the current field with the current edits, for queries at a level. The result must not outlive the world's
  /// memory resource.
  QueryField queryField(int level = 0) const;

  /// Returns a hash (hashParts) of the bodies of all chunks of this level that intersect the region lo <= p < hi.
  /// Meshes chunks that are not drawn. Errors: those of chunksOfRegion and meshChunks.
  Result<ContentHash> hashBodies(const IntBox& region, int level) const;

  WorldStats stats() const;

  /// Returns the viewers of the last setViewers() call.
  std::vector<Viewer> viewers() const;
  WorldTimes times() const;
  const WorldSettings& settings() const;

  /// Returns the current measures; nullopt if the settings do not request measures. Takes some microseconds per hundred
  /// drawn chunks.
  std::optional<WorldMeasures> measures() const;

 private:
  World(std::unique_ptr<WorldCore> core, JobSystem& jobs);
  void advance(size_t bytes, size_t colliders);
  /// Emits the pending changes of colliders as events, with at most `most` new colliders. Precondition: the caller
  /// holds the core's mutex.
  void tellColliders(size_t most);
  /// Abandons the staged step, if there is one: emits a `removed` event for each surface that was delivered for the
  /// step and is not part of `frame`. Then stages `step` instead.
  void restage(const std::shared_ptr<const FrameStep>& step, const DrawnFrame& frame);
  /// Delivers surfaces of the step to the engine, as far as the byte credit allows. Returns true if all were delivered.
  bool handOver(const FrameStep& step);
  /// Delivers surfaces of the step, as far as the byte credit allows. Once all are delivered, emits the step's changes
  /// of the drawn chunks as events, and returns true.
  bool stage(const std::shared_ptr<const FrameStep>& step);

  std::unique_ptr<WorldCore> core_;
  JobSystem& jobs_;
  // Guards the members below, which are used on the engine's thread.
  mutable std::mutex front_;
  std::vector<WorldEvent> events_;
  size_t polled_ = 0;
  ByteCredit credit_;
  std::shared_ptr<const FrameStep> staged_;
  size_t staged_changes_ = 0;  ///< number of changes of staged_ whose surfaces were already delivered
  HandedSurfaces handed_;
};

}  // namespace sgm
