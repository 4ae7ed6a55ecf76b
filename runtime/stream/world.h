#pragma once
// A world that is streamed: meshed around its viewers on the job system, handed to an engine frame by frame.
//
//   engine's thread            jobs
//   setViewers, update  --->   plan (planner.h): which chunks, which frame next
//   edit, setField      --->   mesh (mesh_chunks.h): each job meshes a request or a device batch, urgent ones first
//   poll events         <---   write the journal of edits
//
// Where a store is far away, threads of the world's own look for chunks there before a job sees the request
// (work_queue.h). What all sides share lies in a mailbox (world_core.h) behind one mutex that is held for short work
// without waiting. update() waits for nothing else, so that an engine never waits for a job or a device.

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

/// What an engine is told, in order. Between two updates a whole frame's changes come, or none of them.
struct WorldEvent {
  enum class Kind {
    ready,             ///< a surface to take over; it is not drawn yet
    shown,             ///< draw it from now on
    replaced,          ///< draw the surface that was ready last instead of the earlier one
    seams,             ///< draw other seams of the same surface, or the same among other neighbours
    removed,           ///< draw it no more, and forget it; also of one that was ready and never shown
    failed,            ///< the chunk cannot be made: what is coarser stays in its place
    collider,          ///< collide with this, instead of the chunk's earlier one
    collider_removed,  ///< collide with the chunk no more
  };
  Kind kind = Kind::ready;
  ChunkKey key;
  std::shared_ptr<const ChunkSurface> surface;  ///< of ready
  uint8_t seams = 0;                            ///< to draw, bit (1 << Face)
  Neighbourhood coarser = 0;                    ///< as DrawnChunk::coarser
  uint64_t frame = 0;                           ///< that the change belongs to; 0 for ready and failed
  std::optional<Error> error;                   ///< of failed
  std::shared_ptr<const Collider> collider{};   ///< of collider
};

struct WorldStats {
  PlannerStats planner;
  size_t queued = 0, in_work = 0;  ///< requests
  size_t stale = 0;                ///< of these, those planned for viewers of before
  uint64_t frame = 0;              ///< number of the frame that is drawn
  uint64_t plans = 0;
  uint64_t edits = 0, edits_drawn = 0;  ///< WorldState::number of now, and of what is drawn
  FieldSwitch::Turn fields;             ///< of setField()
  DiskCacheStats cache;
  BakedStats baked;
  size_t surface_bytes = 0, peak_surface_bytes = 0;
  size_t collider_bytes = 0;
  bool idle = false;  ///< what the viewers want is drawn
};

class WorldCore;

inline constexpr size_t kMostViewers = 256;

/// Functions may be called from any thread, one of update, poll and waitIdle at a time.
class World {
 public:
  /// Reads the journal, where there is to be one. Errors: invalid_argument; limit (mesh_bytes is too small to stream
  /// with, or the distances are too large: the message says what would do); those of WorldEdits::open.
  /// backend, jobs and memory must outlive the world; surfaces may outlive it, but not memory. turns: of all worlds on
  /// these jobs; null: there is no other.
  static Result<std::unique_ptr<World>> create(std::shared_ptr<const WorldField> field, Backend& backend,
                                               JobSystem& jobs, const WorldSettings& settings,
                                               std::pmr::memory_resource* memory,
                                               std::shared_ptr<PlanTurns> turns = nullptr);
  /// Waits for jobs that have begun, and a second or so for a server that is being asked; jobs that the job system runs
  /// later find nothing to do.
  ~World();
  World(const World&) = delete;
  World& operator=(const World&) = delete;

  /// Replaces all viewers; none: what is drawn stays, and nothing is meshed. Errors, and nothing changes: those of
  /// checkViewer; limit (more than kMostViewers).
  Result<void> setViewers(std::span<const Viewer> viewers);

  /// Takes over what is finished, at most `bytes` of new surfaces and settings' max_colliders, and has more work begun.
  /// A surface that is larger is handed over as the first of an update all the same; later updates make up for it, so
  /// that any of them in a row hand over at most their bytes and one surface (byte_credit.h). Never waits. While
  /// events of the previous update have not been polled it returns false, and does nothing but schedule a write of the
  /// journal.
  bool update(size_t bytes);

  /// Gives `take` the next events, in order, until it returns false for one or none is left. An event that it refused,
  /// or threw at, comes first the next time.
  void poll(const std::function<bool(const WorldEvent&)>& take);

  /// What is drawn since the last update that took a frame over.
  std::shared_ptr<const DrawnFrame> drawn() const;

  /// Updates, without a limit of bytes, until everything that the viewers want is drawn; the calling thread works too.
  /// Polled events must make room: they gather meanwhile. `more` is asked now and then; false ends the wait.
  /// Errors: cancelled; limit, where memory does not suffice for that.
  Result<void> waitIdle(const std::function<bool()>& more = {});

  /// Puts another field in the place of the world's: other parameters, a grammar that was edited, other fields of the
  /// host's. Chunks that the difference reaches (field_change.h) are meshed again, and drawn all at one time; others
  /// keep their meshes. It waits for its turn while nobody looks. Where a chunk of it cannot be made
  /// (WorldEvent::failed) the world goes back to the field before. Fields that come faster than they can be drawn are
  /// passed over, but for the last. Edits stay: their materials and tags keep their numbers. Never waits. Errors, and
  /// nothing changes: invalid_argument (another finest cell, or what create() would refuse).
  Result<void> setField(std::shared_ptr<const WorldField> field);

  /// Drops everything that waits to be meshed, and what is being meshed is dropped when it comes back. The next update
  /// begins anew for the viewers there are.
  void cancel();

  /// Lays a brush on the world, or undoes an edit, as EditLog does; or takes over the edits of another world. Drawn two
  /// frames of changes later at the latest. Never wait for a job or the disk.
  Result<EditId> edit(const Brush& brush);
  Result<EditId> undo(EditId id);
  Result<void> importEdits(std::span<const std::byte> bytes);
  /// All edits but the first `since`, in the order in which they were learned here: for another world's importEdits().
  std::vector<std::byte> exportEdits(uint64_t since = 0) const;
  uint64_t editCount() const;
  /// Of the set of edits: worlds that have exchanged theirs have equal ones.
  uint64_t editHash() const;
  /// Returns when the disk has every edit of before. Errors: io.
  Result<void> flushEdits();

  /// The field of now: what chunks are meshed from next. A newer one may be about to follow it.
  std::shared_ptr<const WorldField> field() const;
  /// That field with the edits of now, to be asked at a level. Must not outlive its memory.
  QueryField queryField(int level = 0) const;

  /// The hash of the set of bodies (hashParts) of a level's chunks that meet lo <= p < hi; chunks that are not drawn
  /// are meshed. Errors: those of chunksOfRegion and meshChunks.
  Result<ContentHash> hashBodies(const IntBox& region, int level) const;

  WorldStats stats() const;

  /// As setViewers() was told last.
  std::vector<Viewer> viewers() const;
  WorldTimes times() const;
  const WorldSettings& settings() const;

  /// Of now; nothing where the settings do not ask for it. Takes some microseconds a hundred drawn chunks.
  std::optional<WorldMeasures> measures() const;

 private:
  World(std::unique_ptr<WorldCore> core, JobSystem& jobs);
  void advance(size_t bytes, size_t colliders);
  /// Tells the next changes of colliders. Precondition: the core's mutex is held.
  void tellColliders(size_t most);
  /// Takes back what was handed over for the staged step and is not in the frame that comes, or stays.
  void restage(const std::shared_ptr<const FrameStep>& step, const DrawnFrame& frame);
  bool wasHanded(const DrawnChunk& chunk) const;
  /// Of the step's surfaces that have not been handed over.
  size_t bytesLeft(const FrameStep& step) const;
  /// Whether all of the step's surfaces have been handed over.
  bool handOver(const FrameStep& step);
  /// Hands over surfaces of a step, and when all are there its changes: then true.
  bool stage(const std::shared_ptr<const FrameStep>& step);

  std::unique_ptr<WorldCore> core_;
  JobSystem& jobs_;
  // The engine's side, guarded by front_.
  mutable std::mutex front_;
  std::vector<WorldEvent> events_;
  size_t polled_ = 0;
  ByteCredit credit_;
  std::shared_ptr<const FrameStep> staged_;
  size_t staged_changes_ = 0;  ///< of staged_, whose surfaces have been handed over
  std::unordered_map<ChunkKey, std::shared_ptr<const ChunkSurface>, ChunkKeyHash> handed_;
};

}  // namespace sgm
