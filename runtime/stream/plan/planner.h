#pragma once
// Decides what a world does next: which chunks to mesh, in which order, and which finished chunks to draw. plan() gets
// all input as a parameter and returns all output; the caller runs the jobs and passes frames to the engine (world.h).
// Not thread-safe.

#include <array>
#include <chrono>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "stream/edits/world_edits.h"
#include "stream/plan/chunk_store.h"
#include "stream/plan/commit_plan.h"
#include "stream/plan/drawn_frame.h"
#include "stream/plan/viewer_index.h"

namespace sgm {

struct Look;

/// A request for a chunk, with its priority.
struct WorkItem {
  ChunkRequest request;
  std::shared_ptr<const ChunkSurface> before;  ///< for a request of seams only: the surface to which the seams are
                                               ///< added
  /// Priority classes: all requests of one rank are meshed before those of the next rank.
  enum class Rank : uint8_t {
    edited,  ///< chunks whose drawn version is outdated by an edit
    coarse,  ///< chunks of a coarse version of the whole view, coarsest level first; used only if viewers need many
             ///< chunks to stand on
    near,    ///< chunks that a viewer needs to stand on
    other,
  };
  static constexpr size_t kRanks = 4;
  Rank rank = Rank::other;
  double urgency = 0;  ///< order within a rank: smaller values first

  // The members below are used only if stores are on a server (work_queue.h).
  std::shared_ptr<Look> look;                            ///< prefetch of the request; null: none has begun
  std::chrono::steady_clock::time_point in_sight_since;  ///< time at which the request became urgent enough to be
                                                         ///< prefetched
};

struct FinishedChunk {
  ChunkRequest request;
  uint64_t edits = 0;                           ///< number of the world state from which the chunk was meshed
  std::shared_ptr<const ChunkSurface> before;   ///< the surface that `surface` extends (WorkItem::before)
  std::shared_ptr<const ChunkSurface> surface;  ///< the meshed surface; null if it has no triangles, or an error
                                                ///< occurred
  std::unique_ptr<const VoidComponents> voids;  ///< void components; set if the request wants signs
  uint32_t rounded = 0;                         ///< number of cells of the body that keep rounded edges instead of
                                                ///< sharp ones
  bool from_disk = false;                       ///< true if all requested parts came from the disk cache or stores
  /// error, if any. cancelled: meshing did not begin, and the chunk may be requested again
  std::optional<Error> error;
};

struct FailedChunk {
  ChunkKey key;
  Error error;
};

/// A change from one drawn frame to another, which is applied as a whole.
struct FrameStep {
  uint64_t from = 0;  ///< number of the frame before the step
  std::shared_ptr<const DrawnFrame> to;
  std::vector<FrameChange> changes;
};

struct PlanInput {
  std::vector<Viewer> viewers;
  std::vector<FinishedChunk> finished;
  std::vector<ChunkKey> begun;  ///< chunks whose meshing has begun since the last plan
  uint64_t applied = 0;         ///< number of the frame that the engine draws now
  /// Numbers of up to two frames that the engine may still draw, in addition to the frame of the last plan's step; 0:
  /// none.
  std::array<uint64_t, 2> in_hand{};
  WorldState edits;                 ///< the latest state of the world: its field and its brushes
  std::vector<WorldChange> edited;  ///< the changes of the world since the state Planner::edits()
  size_t live_bytes = 0;            ///< size in bytes of all surfaces, including those that only the engine still
                                    ///< references
  size_t collider_bytes = 0;        ///< size in bytes of colliders, which live_bytes does not include
};

struct Plan {
  /// requests for all chunks that should be meshed and are not in progress; the most urgent one last
  std::vector<WorkItem> queue;
  WorldState edits;                       ///< the world state from which the chunks in the queue must be meshed
  std::shared_ptr<const FrameStep> step;  ///< the change to the next frame; null if no better frame is possible yet
  std::vector<FailedChunk> failed;        ///< chunks that failed since the last plan
  /// true if nothing is left to mesh or draw: everything that the viewers need is drawn
  bool idle = false;
};

struct PlannerSettings {
  LodSettings lod;
  size_t mesh_bytes = size_t{256} << 20;  ///< limit for the total size of surfaces, in bytes
  double all_around = 0;                  ///< distance in units from a viewer, in all directions, within which objects
                                          ///< need colliders; see urgencyFor()
  /// true: level 0 is drawn only around chunks that can be reached from a viewer through the void (reachability.h)
  bool by_reach = true;
  bool sharp = false;  ///< true: surfaces have sharp features
};

struct PlannerStats {
  uint64_t meshed = 0;       ///< number of chunk bodies that were meshed
  uint64_t finest = 0;       ///< number of level-0 chunk bodies that were meshed
  uint64_t rounded = 0;      ///< number of cells with rounded instead of sharp edges, summed over all meshed bodies
  uint64_t seam_jobs = 0;    ///< number of finished requests for seams only
  uint64_t outdated = 0;     ///< number of chunks that had to be meshed again because of a change of the world
  uint64_t edited = 0;       ///< number of meshing results that were dropped because the world changed while the chunk
                             ///< was meshed
  uint64_t never_drawn = 0;  ///< number of chunks that were meshed, never drawn, and are no longer needed
  uint64_t failed = 0;
  size_t records = 0;         ///< number of known chunks
  size_t record_bytes = 0;    ///< memory of the records of known chunks, without surfaces, in bytes
  size_t drawn = 0;           ///< number of drawn chunks with triangles
  uint64_t edits_drawn = 0;   ///< number of the drawn world state
  uint64_t edits_failed = 0;  ///< number of a world state that cannot be drawn because one of its chunks failed; 0:
                              ///< none
  double detail = 1;          ///< factor on the distances of levels of detail: below 1 if memory does not suffice
};

class Planner {
 public:
  explicit Planner(const PlannerSettings& settings, WorldState first = {});

  /// Makes a plan. If it throws std::bad_alloc, the planner's data is inconsistent, and restart() must be called before
  /// the next plan.
  Plan plan(PlanInput&& input);
  /// Discards all data except the drawn frame.
  void restart(std::shared_ptr<const DrawnFrame> drawn);

  const PlannerStats& stats() const { return stats_; }
  const DrawnFrame& applied() const { return *applied_; }
  /// Returns the world state from which chunks are meshed now.
  const WorldState& edits() const { return edits_; }

 private:
  using Rank = WorkItem::Rank;
  /// A node of an octree that has a mesh, and the seams that it needs if it is drawn.
  struct OctreeNode {
    ChunkKey key;
    uint8_t faces = 0;
    bool split = false;
  };

  void learnApplied(uint64_t number);
  /// Removes offered steps that the engine can no longer take. in_hand: see PlanInput.
  void forgetOffers(const std::array<uint64_t, 2>& in_hand);
  /// Adopts changes of the world one state at a time: the next state is adopted when the previous one is drawn and no
  /// offered step is pending. So a frame shows exactly one state, and each change appears in one of the next two new
  /// frames. However many edits there are, only drawn chunks are meshed again. Before the first frame, edits are
  /// adopted only once: otherwise the coarsest chunks would be meshed again and again, and the first frame would never
  /// be complete.
  void takeUpEdits(PlanInput& input);
  /// Makes the drawn state the current state again, because the adopted state cannot be drawn.
  void giveEditsBack();
  /// Postpones edits until less detail is drawn, because memory does not suffice to mesh the drawn chunks again.
  void postponeEdits();
  void invalidate(std::span<const WorldChange> changes);
  void findOutdated();
  bool isReady(const ChunkKey& chunk, uint8_t seams) const;
  /// Returns the octree nearest to the target for which everything is ready; nullopt if the drawn octree must stay.
  std::optional<Octree> nextTree();
  void take(std::vector<FinishedChunk>& finished, Plan& plan);
  bool canLowerDetail() const;
  /// Removes unneeded chunks, and lowers or raises detail, according to the memory limit. Returns true if detail must
  /// be lowered further.
  bool keepToBudget(size_t live_bytes, size_t collider_bytes);
  void retarget(std::span<const Viewer> viewers);
  ChunkSet reachedParents(std::span<const LodViewer> viewers, const LodSettings& lod) const;
  std::shared_ptr<const FrameStep> nextStep();
  void fillQueue(std::vector<WorkItem>& queue);
  void requestCoarse(std::vector<WorkItem>& queue);
  double nearDistance() const;
  static void listNodes(const Octree& tree, std::vector<OctreeNode>& nodes);
  /// Adds a request for the missing parts of a chunk to the queue, or extends the request for this chunk that is
  /// already in the queue.
  void request(const ChunkKey& key, int seams, Rank rank, std::vector<WorkItem>& queue);
  /// Creates the record of a drawn chunk, with the parts that are drawn.
  KnownChunk knownOfDrawn(const ChunkKey& leaf) const;
  /// Counts the chunks that are needed now, and the other known chunks.
  void tally();
  /// Removes records of unneeded chunks until `bytes` bytes are freed, and at most about twice as many records remain
  /// as there are needed chunks. Precondition: tally() was called.
  void forget(size_t bytes);

  PlannerSettings settings_;
  ChunkStore store_;
  ViewerIndex viewers_;
  std::vector<LodViewer> targeted_;  ///< the viewers for which target_ was computed
  double targeted_detail_ = 0;
  ChunkSet reached_;            ///< level-1 nodes that contain chunks reachable from viewers through the void
  bool voids_changed_ = false;  ///< true if void components have changed since reached_ was computed
  Octree target_;
  std::vector<OctreeNode> target_nodes_, near_nodes_;
  std::shared_ptr<const DrawnFrame> applied_;
  std::shared_ptr<const FrameStep> step_;  ///< the last offered step; null if the engine has taken it
  /// next frames that were offered since applied_ was drawn, and that the engine may still draw
  std::vector<std::shared_ptr<const DrawnFrame>> offered_;
  std::vector<MissingSeams> missing_;
  WorldState edits_;
  uint64_t edits_drawn_ = 0;        ///< number of the world state that applied_ shows
  uint64_t oldest_edits_ = 0;       ///< number of the oldest world state whose meshing results are still accepted
  std::vector<ChunkKey> outdated_;  ///< leaves of applied_ whose drawn version shows an older world state than edits_
  WorldState edits_before_;         ///< the world state before edits_ was adopted
  bool postponed_ = false;          ///< true if edits are postponed until less detail is drawn, for lack of memory
  double room_beside_ = 0;          ///< maximum share of the memory limit that needed chunks may take when postponed
                                    ///< edits are adopted
  uint64_t edits_failed_ = 0;       ///< number of a world state that is not drawn because one of its chunks failed
  bool awaited_ = false;            ///< true if the last plan left work: chunks to mesh, chunks in progress, or a step
                                    ///< to draw
  bool edited_first_ = false;       ///< true if edits were already adopted before the first frame
  bool changed_ = true;             ///< true if anything changed since the last search for a step
  uint64_t plans_ = 0, frames_ = 0, detail_settled_ = 0;
  uint64_t freed_in_vain_ = 0;
  size_t wanted_bytes_ = 0;  ///< total size in bytes of the chunks that the last plan needed
  size_t wanted_ = 0;        ///< number of chunks that the last plan needed
  PlannerStats stats_;
};

}  // namespace sgm
