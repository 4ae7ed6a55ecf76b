#pragma once
// Decides what a world does next: which chunks to mesh, in which order, and which finished chunks to draw.
//
// Not thread-safe. plan() receives all input and returns all output; the caller runs the jobs and passes frames to the
// engine (world.h).

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
  std::shared_ptr<const ChunkSurface> before;  ///< for a request of seams only: the surface that they are added to
  /// All requests of one rank come before those of the next rank.
  enum class Rank : uint8_t {
    edited,  ///< the drawn version of the chunk is out of date
    coarse,  ///< part of a coarse first picture for a crowd of viewers; the coarsest level comes first
    near,    ///< needed to stand where a viewer is
    other,
  };
  static constexpr size_t kRanks = 4;
  Rank rank = Rank::other;
  double urgency = 0;  ///< order within a rank: smaller values first

  // The following members are used for stores on a server (work_queue.h).
  std::shared_ptr<Look> look;                            ///< the prefetch of the request; null: none has begun
  std::chrono::steady_clock::time_point in_sight_since;  ///< when the request became one of those to be prefetched
};

struct FinishedChunk {
  ChunkRequest request;
  uint64_t edits = 0;                           ///< number of the state under which the chunk was meshed
  std::shared_ptr<const ChunkSurface> before;   ///< same as WorkItem::before: the surface that `surface` extends
  std::shared_ptr<const ChunkSurface> surface;  ///< null: no triangles, or an error
  std::unique_ptr<const VoidComponents> voids;  ///< set if the request wants signs
  uint32_t rounded = 0;                         ///< number of cells of the body whose sharp features are missing
  bool from_disk = false;                       ///< true if all requested parts came from the disk cache
  /// cancelled: meshing did not begin, and the chunk may be requested again
  std::optional<Error> error;
};

struct FailedChunk {
  ChunkKey key;
  Error error;
};

/// One atomic step from one drawn frame to another.
struct FrameStep {
  uint64_t from = 0;  ///< number of the frame before the step
  std::shared_ptr<const DrawnFrame> to;
  std::vector<FrameChange> changes;
};

struct PlanInput {
  std::vector<Viewer> viewers;
  std::vector<FinishedChunk> finished;
  std::vector<ChunkKey> begun;  ///< chunks whose meshing has begun since the last plan
  uint64_t applied = 0;         ///< number of the frame that the engine draws
  /// Numbers of up to two frames that the engine may be about to draw (0: none), besides that of the last plan's
  /// step.
  std::array<uint64_t, 2> in_hand{};
  WorldState edits;                 ///< the latest state of the world: its field and its brushes
  std::vector<WorldChange> edited;  ///< the changes since the state Planner::edits()
  size_t live_bytes = 0;            ///< size of all surfaces, including those that only the engine owns
  size_t collider_bytes = 0;        ///< size of colliders, not included in live_bytes
};

struct Plan {
  /// all chunks that should be meshed and are not in work; the most urgent one last
  std::vector<WorkItem> queue;
  WorldState edits;                       ///< the state under which the queue must be meshed
  std::shared_ptr<const FrameStep> step;  ///< the next frame; null if the drawn frame is the best one possible
  std::vector<FailedChunk> failed;        ///< chunks that failed since the last plan
  /// true if there is nothing to mesh or draw: all that the viewers need is drawn
  bool idle = false;
};

struct PlannerSettings {
  LodSettings lod;
  size_t mesh_bytes = size_t{256} << 20;  ///< limit for the size of surfaces
  double all_around = 0;                  ///< as for urgencyFor(): the distance within which colliders are needed
  /// true: level 0 only at places that a viewer's void reaches (reachability.h)
  bool by_reach = true;
  bool sharp = false;  ///< true: chunks have sharp features
};

struct PlannerStats {
  uint64_t meshed = 0;       ///< number of chunks whose body was meshed
  uint64_t finest = 0;       ///< number of these chunks that have level 0
  uint64_t rounded = 0;      ///< total number of cells of these chunks that keep rounded edges
  uint64_t seam_jobs = 0;    ///< number of finished requests for seams only
  uint64_t outdated = 0;     ///< number of chunks that were meshed again because of a change
  uint64_t edited = 0;       ///< number of requests that finished after edits had changed their chunk
  uint64_t never_drawn = 0;  ///< number of meshed chunks that were never drawn and are no longer wanted
  uint64_t failed = 0;
  size_t records = 0;         ///< number of known chunks
  size_t record_bytes = 0;    ///< memory of their records, without surfaces
  size_t drawn = 0;           ///< number of drawn chunks with triangles
  uint64_t edits_drawn = 0;   ///< number of the drawn state
  uint64_t edits_failed = 0;  ///< number of a state that cannot be drawn because one of its chunks failed; 0: none
  double detail = 1;          ///< factor on the distances for detail: below 1 if memory is scarce
};

class Planner {
 public:
  explicit Planner(const PlannerSettings& settings, WorldState first = {});

  /// Throws std::bad_alloc; then the planner's data is inconsistent, and restart() must be called before the next plan.
  Plan plan(PlanInput&& input);
  /// Drops all data except the drawn frame.
  void restart(std::shared_ptr<const DrawnFrame> drawn);

  const PlannerStats& stats() const { return stats_; }
  const DrawnFrame& applied() const { return *applied_; }
  /// Returns the state under which chunks are meshed now.
  const WorldState& edits() const { return edits_; }

 private:
  using Rank = WorkItem::Rank;
  /// A node of a tree that has a mesh, and the seams needed if it is drawn.
  struct OctreeNode {
    ChunkKey key;
    uint8_t faces = 0;
    bool split = false;
  };

  void learnApplied(uint64_t number);
  /// Forgets offered steps that the engine can no longer take. in_hand: see PlanInput.
  void forgetOffers(const std::array<uint64_t, 2>& in_hand);
  /// Adopts edits state by state: the next state is adopted when the previous one is drawn and no offered step is open.
  /// So a frame shows one state, a change waits for at most two frames of changes, and only drawn chunks are meshed
  /// again, however many edits there are. Edits are not adopted repeatedly before the first frame: each time the
  /// coarsest chunks would be meshed again, and the frame would never be complete.
  void takeUpEdits(PlanInput& input);
  /// Returns from the adopted edits to the drawn state.
  void giveEditsBack();
  /// Postpones the edits until less detail is drawn, because there is not enough memory to mesh the drawn chunks again.
  void postponeEdits();
  void invalidate(std::span<const WorldChange> changes);
  void findOutdated();
  bool isReady(const ChunkKey& chunk, uint8_t seams) const;
  /// Returns the tree nearest to the target for which everything is ready; nullopt: the drawn tree must stay.
  std::optional<Octree> nextTree();
  void take(std::vector<FinishedChunk>& finished, Plan& plan);
  bool canLowerDetail() const;
  /// Frees unused chunks, and lowers or raises detail. Returns true if detail must be lowered further.
  bool keepToBudget(size_t live_bytes, size_t collider_bytes);
  void retarget(std::span<const Viewer> viewers);
  ChunkSet reachedParents(std::span<const LodViewer> viewers, const LodSettings& lod) const;
  std::shared_ptr<const FrameStep> nextStep();
  void fillQueue(std::vector<WorkItem>& queue);
  void requestCoarse(std::vector<WorkItem>& queue);
  double nearDistance() const;
  static void listNodes(const Octree& tree, std::vector<OctreeNode>& nodes);
  /// Adds a request for the missing parts of a chunk to the queue; merges it with a request for the same chunk in this
  /// plan.
  void request(const ChunkKey& key, int seams, Rank rank, std::vector<WorkItem>& queue);
  /// Makes the record of a drawn chunk, which contains the parts that are drawn.
  KnownChunk knownOfDrawn(const ChunkKey& leaf) const;
  /// Counts the chunks that are wanted now, and the other known chunks.
  void tally();
  /// Drops chunks that are not wanted until this many bytes are freed, and not many more chunks than the wanted ones
  /// are left. Precondition: tally() was called.
  void forget(size_t bytes);

  PlannerSettings settings_;
  ChunkStore store_;
  ViewerIndex viewers_;
  std::vector<LodViewer> targeted_;  ///< the viewers for which target_ was computed
  double targeted_detail_ = 0;
  ChunkSet reached_;            ///< level-1 nodes that have chunks reachable from viewers through the void
  bool voids_changed_ = false;  ///< true if voids changed since reached_ was computed
  Octree target_;
  std::vector<OctreeNode> target_nodes_, near_nodes_;
  std::shared_ptr<const DrawnFrame> applied_;
  std::shared_ptr<const FrameStep> step_;  ///< the last offered step; null if the engine has taken it
  /// frames of offered steps, starting from applied_, that the engine may still take
  std::vector<std::shared_ptr<const DrawnFrame>> offered_;
  std::vector<MissingSeams> missing_;
  WorldState edits_;
  uint64_t edits_drawn_ = 0;        ///< number of the state that applied_ shows
  uint64_t oldest_edits_ = 0;       ///< results that were meshed under an earlier state are rejected
  std::vector<ChunkKey> outdated_;  ///< leaves of applied_ whose drawn content is not yet that of edits_
  WorldState edits_before_;         ///< the state before edits_ was adopted
  bool postponed_ = false;          ///< true if there was no memory for the edits: they wait until less detail is drawn
  double room_beside_ = 0;          ///< the share of memory that drawn chunks may take when postponed edits are adopted
  uint64_t edits_failed_ = 0;       ///< number of a state that is not drawn because one of its chunks failed
  bool awaited_ = false;            ///< true if the last plan had a chunk to mesh, a chunk in work, or a step to draw
  bool edited_first_ = false;       ///< true if edits were adopted before the first frame
  bool changed_ = true;             ///< true if anything changed since the last search for a step
  uint64_t plans_ = 0, frames_ = 0, detail_settled_ = 0;
  uint64_t freed_in_vain_ = 0;
  size_t wanted_bytes_ = 0;  ///< total size of the chunks that the last plan used
  size_t wanted_ = 0;        ///< number of the chunks that the last plan used
  PlannerStats stats_;
};

}  // namespace sgm
