#pragma once
// Decides what a world does next: which chunks to mesh, in which order, and which of the finished chunks to draw.
//
// One thread at a time. plan() takes all input and returns all output; the caller runs the jobs and passes frames to
// the engine (world.h).

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

/// A request for a chunk with its priority.
struct WorkItem {
  ChunkRequest request;
  std::shared_ptr<const ChunkSurface> before;  ///< for requests of seams only
  /// All requests of one rank come before those of the next.
  enum class Rank : uint8_t {
    edited,  ///< the drawn version is out of date
    coarse,  ///< coarse first picture for a crowd of viewers, coarsest level first
    near,    ///< needed to stand where a viewer is
    other,
  };
  static constexpr size_t kRanks = 4;
  Rank rank = Rank::other;
  double urgency = 0;  ///< smaller first

  // For stores on a server (work_queue.h).
  std::shared_ptr<Look> look;                            ///< null: no prefetch has begun
  std::chrono::steady_clock::time_point in_sight_since;  ///< when it became one of the requests to prefetch
};

struct FinishedChunk {
  ChunkRequest request;
  uint64_t edits = 0;                           ///< number of the state under which it was meshed
  std::shared_ptr<const ChunkSurface> before;   ///< as in the work item: the surface that `surface` extends
  std::shared_ptr<const ChunkSurface> surface;  ///< null: no triangles, or an error
  std::unique_ptr<const VoidComponents> voids;  ///< if the request asks for signs
  uint32_t rounded = 0;                         ///< cells whose sharp features are missing in the body
  bool from_disk = false;                       ///< everything requested came from the disk cache
  std::optional<Error> error;                   ///< cancelled: it never began, and may be requested again
};

struct FailedChunk {
  ChunkKey key;
  Error error;
};

/// One atomic step of what is drawn.
struct FrameStep {
  uint64_t from = 0;  ///< number of the frame before the step
  std::shared_ptr<const DrawnFrame> to;
  std::vector<FrameChange> changes;
};

struct PlanInput {
  std::vector<Viewer> viewers;
  std::vector<FinishedChunk> finished;
  std::vector<ChunkKey> begun;  ///< handed out since the last plan
  uint64_t applied = 0;         ///< number of the frame that the engine draws
  /// Numbers of frames (0: none) that the engine may be about to draw, beside that of the last plan's step.
  std::array<uint64_t, 2> in_hand{};
  WorldState edits;                 ///< the newest state of the world: its field and its brushes
  std::vector<WorldChange> edited;  ///< changes since Planner::edits()
  size_t live_bytes = 0;            ///< of all surfaces, including the engine's
  size_t collider_bytes = 0;        ///< in addition to live_bytes
};

struct Plan {
  std::vector<WorkItem> queue;            ///< all chunks to mesh that are not in work, most urgent last
  WorldState edits;                       ///< the state under which to mesh the queue
  std::shared_ptr<const FrameStep> step;  ///< the next frame; null if the drawn one is the best possible
  std::vector<FailedChunk> failed;        ///< since the last plan
  bool idle = false;                      ///< nothing to mesh or draw: everything that the viewers want is there
};

struct PlannerSettings {
  LodSettings lod;
  size_t mesh_bytes = size_t{256} << 20;  ///< limit for surfaces
  double all_around = 0;                  ///< as in urgencyFor(): the distance for colliders
  bool by_reach = true;                   ///< level 0 only where a viewer's void leads (reachability.h)
  bool sharp = false;                     ///< chunks have sharp features
};

struct PlannerStats {
  uint64_t meshed = 0;       ///< chunks whose body came back
  uint64_t finest = 0;       ///< of these, those of level 0
  uint64_t rounded = 0;      ///< cells of all these that keep rounded edges
  uint64_t seam_jobs = 0;    ///< finished requests for seams only
  uint64_t outdated = 0;     ///< chunks that a change had meshed again
  uint64_t edited = 0;       ///< requests that finished after edits had changed their chunk
  uint64_t never_drawn = 0;  ///< meshed chunks that were never drawn, and are not wanted
  uint64_t failed = 0;
  size_t records = 0;         ///< chunks known
  size_t record_bytes = 0;    ///< memory of their records, without surfaces
  size_t drawn = 0;           ///< drawn chunks with triangles
  uint64_t edits_drawn = 0;   ///< number of the drawn state
  uint64_t edits_failed = 0;  ///< number of a state that cannot be drawn, since a chunk of it failed; 0: none
  double detail = 1;          ///< factor on the distances for detail: below 1 if memory is short
};

class Planner {
 public:
  explicit Planner(const PlannerSettings& settings, WorldState first = {});

  /// Throws std::bad_alloc; then the planner's data is inconsistent, and restart() must come before the next plan.
  Plan plan(PlanInput&& input);
  /// Forgets everything except the drawn frame.
  void restart(std::shared_ptr<const DrawnFrame> drawn);

  const PlannerStats& stats() const { return stats_; }
  const DrawnFrame& applied() const { return *applied_; }
  /// The state under which chunks are meshed now.
  const WorldState& edits() const { return edits_; }

 private:
  using Rank = WorkItem::Rank;
  /// A node with a mesh, and its seams if it is drawn.
  struct OctreeNode {
    ChunkKey key;
    uint8_t faces = 0;
    bool split = false;
  };

  void learnApplied(uint64_t number);
  /// Forgets offered steps that can no longer be taken.
  void forgetOffers(const std::array<uint64_t, 2>& in_hand);
  /// Takes up edits state by state: the next state when the previous one is drawn and no offered step is open. So a
  /// frame shows one state, a change waits for at most two frames of changes, and only drawn chunks are meshed again,
  /// however many edits there are. Before the first frame edits wait, since each would have the coarsest chunks meshed
  /// again, and the frame would never come.
  void takeUpEdits(PlanInput& input);
  /// Returns to the drawn state.
  void giveEditsBack();
  /// Waits with the edits until less detail is drawn, since memory is too short to mesh the drawn chunks again.
  void postponeEdits();
  void invalidate(std::span<const WorldChange> changes);
  void findOutdated();
  bool isReady(const ChunkKey& chunk, uint8_t seams) const;
  /// The ready tree that is nearest to the target; nullopt: the drawn tree must stay.
  std::optional<Octree> nextTree();
  void take(std::vector<FinishedChunk>& finished, Plan& plan);
  bool canLowerDetail() const;
  /// Returns whether detail must still be lowered.
  bool keepToBudget(size_t live_bytes, size_t collider_bytes);
  void retarget(std::span<const Viewer> viewers);
  ChunkSet reachedParents(std::span<const LodViewer> viewers, const LodSettings& lod) const;
  std::shared_ptr<const FrameStep> nextStep();
  void fillQueue(std::vector<WorkItem>& queue);
  void requestCoarse(std::vector<WorkItem>& queue);
  double nearDistance() const;
  static void listNodes(const Octree& tree, std::vector<OctreeNode>& nodes);
  /// Requests the missing parts of a chunk; combines them with a request of this plan.
  void request(const ChunkKey& key, int seams, Rank rank, std::vector<WorkItem>& queue);
  /// The record of a drawn chunk.
  KnownChunk knownOfDrawn(const ChunkKey& leaf) const;
  /// Counts the chunks that are wanted now, and those that are not.
  void tally();
  /// Forgets unwanted chunks until this many bytes are freed and few more chunks than the wanted ones are left.
  /// Precondition: tally() was called.
  void forget(size_t bytes);

  PlannerSettings settings_;
  ChunkStore store_;
  ViewerIndex viewers_;
  std::vector<LodViewer> targeted_;  ///< the viewers of target_
  double targeted_detail_ = 0;
  ChunkSet reached_;            ///< level-1 nodes with chunks reachable through the viewers' void
  bool voids_changed_ = false;  ///< since reached_ was computed
  Octree target_;
  std::vector<OctreeNode> target_nodes_, near_nodes_;
  std::shared_ptr<const DrawnFrame> applied_;
  std::shared_ptr<const FrameStep> step_;                   ///< the last offered step, not known to be taken
  std::vector<std::shared_ptr<const DrawnFrame>> offered_;  ///< frames of steps from applied_ that may still be taken
  std::vector<MissingSeams> missing_;
  WorldState edits_;
  uint64_t edits_drawn_ = 0;        ///< the state that applied_ shows
  uint64_t oldest_edits_ = 0;       ///< results meshed under an earlier state are rejected
  std::vector<ChunkKey> outdated_;  ///< leaves of applied_ that are not yet as in edits_
  WorldState edits_before_;         ///< the state before edits_ was taken up
  bool postponed_ = false;          ///< edits found no room, and wait until less detail is drawn
  double room_beside_ = 0;          ///< the share of memory that the drawn chunks may take then
  uint64_t edits_failed_ = 0;       ///< a state that is not drawn, since a chunk of it failed
  bool awaited_ = false;            ///< the last plan had a chunk to mesh, one in work, or a step to draw
  bool edited_first_ = false;       ///< edits were taken up while the first frame was awaited
  bool changed_ = true;             ///< since the last search for a step
  uint64_t plans_ = 0, frames_ = 0, detail_settled_ = 0;
  uint64_t freed_in_vain_ = 0;
  size_t wanted_bytes_ = 0;  ///< of the chunks that the last plan used
  size_t wanted_ = 0;        ///< number of these chunks
  PlannerStats stats_;
};

}  // namespace sgm
