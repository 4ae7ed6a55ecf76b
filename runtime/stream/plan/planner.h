#pragma once
// What a world does next: which chunks to mesh, in which order, and which frame to draw of those that are there.
//
// One thread at a time. Everything comes in by plan() and goes out by its answer; whoever calls it runs the jobs and
// hands frames to the engine (world.h).

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

/// A request handed out, and come back.
struct WorkItem {
  ChunkRequest request;
  std::shared_ptr<const ChunkSurface> before;  ///< where the request is for seams alone
  /// All of one rank come before those of the next.
  enum class Rank : uint8_t {
    edited,  ///< what is drawn of it is out of date
    coarse,  ///< of many viewers' first picture, the coarsest level first
    near,    ///< it takes this to stand where a viewer is
    other,
  };
  static constexpr size_t kRanks = 4;
  Rank rank = Rank::other;
  double urgency = 0;  ///< smaller first

  // Where stores are far (work_queue.h).
  std::shared_ptr<Look> look;                            ///< null: nobody has begun one
  std::chrono::steady_clock::time_point in_sight_since;  ///< among those that are looked for
};

struct FinishedChunk {
  ChunkRequest request;
  uint64_t edits = 0;                           ///< number of the state that it was meshed under
  std::shared_ptr<const ChunkSurface> before;   ///< as in the work item: what `surface` adds to
  std::shared_ptr<const ChunkSurface> surface;  ///< null: no triangles, or an error
  std::unique_ptr<const VoidComponents> voids;  ///< where the request was for the signs
  uint32_t rounded = 0;                         ///< cells whose sharp features the body does not have
  bool from_disk = false;                       ///< all that the request asks for came from the disk cache
  std::optional<Error> error;                   ///< cancelled: it was never begun, and may be asked for again
};

struct FailedChunk {
  ChunkKey key;
  Error error;
};

/// One atomic step of what is drawn.
struct FrameStep {
  uint64_t from = 0;  ///< number of the frame that it starts from
  std::shared_ptr<const DrawnFrame> to;
  std::vector<FrameChange> changes;
};

struct PlanInput {
  std::vector<Viewer> viewers;
  std::vector<FinishedChunk> finished;
  std::vector<ChunkKey> begun;  ///< handed out since the last plan
  uint64_t applied = 0;         ///< number of the frame that the engine draws
  /// Numbers of frames, 0: none, that it may be about to draw, beside that of the last plan's step.
  std::array<uint64_t, 2> in_hand{};
  WorldState edits;                 ///< the latest
  std::vector<WorldChange> edited;  ///< what has changed since Planner::edits()
  size_t live_bytes = 0;            ///< of all surfaces, the engine's own included
  size_t collider_bytes = 0;        ///< that come on top
};

struct Plan {
  std::vector<WorkItem> queue;            ///< everything to be meshed that is not being meshed, the most urgent last
  WorldState edits;                       ///< to mesh the queue under
  std::shared_ptr<const FrameStep> step;  ///< the next frame; null where what is drawn is the best there is
  std::vector<FailedChunk> failed;        ///< since the last plan
  bool idle = false;                      ///< nothing to mesh, nothing to draw: what the viewers want is there
};

struct PlannerSettings {
  LodSettings lod;
  size_t mesh_bytes = size_t{256} << 20;  ///< the most bytes of surfaces
  double all_around = 0;                  ///< as urgencyFor()'s: where colliders are wanted
  bool by_reach = true;                   ///< level 0 only where a viewer's void leads to (reachability.h)
  bool sharp = false;                     ///< chunks have sharp features
};

struct PlannerStats {
  uint64_t meshed = 0;       ///< chunks whose body came back
  uint64_t finest = 0;       ///< of these, those of level 0
  uint64_t rounded = 0;      ///< cells of theirs that keep rounded edges
  uint64_t seam_jobs = 0;    ///< requests for seams alone that came back
  uint64_t outdated = 0;     ///< chunks that were there, and that a change had meshed again
  uint64_t edited = 0;       ///< requests that came back after edits had changed their chunk
  uint64_t never_drawn = 0;  ///< meshed chunks that are neither drawn, nor wanted, nor ever were drawn
  uint64_t failed = 0;
  size_t records = 0;         ///< chunks known
  size_t record_bytes = 0;    ///< of what is known of them, without their surfaces
  size_t drawn = 0;           ///< chunks drawn that have triangles
  uint64_t edits_drawn = 0;   ///< number of the state that is drawn
  uint64_t edits_failed = 0;  ///< of one that cannot be drawn, as a chunk of it cannot be made; 0: none
  double detail = 1;          ///< factor on the distances at which detail is wanted: below 1 under pressure of memory
};

class Planner {
 public:
  explicit Planner(const PlannerSettings& settings, WorldState first = {});

  /// Throws std::bad_alloc; then what it knows is not whole any more, and restart() must come before the next plan.
  Plan plan(PlanInput&& input);
  /// Forgets everything but what is drawn.
  void restart(std::shared_ptr<const DrawnFrame> drawn);

  const PlannerStats& stats() const { return stats_; }
  const DrawnFrame& applied() const { return *applied_; }
  /// The state that chunks are meshed under now.
  const WorldState& edits() const { return edits_; }

 private:
  using Rank = WorkItem::Rank;
  /// A node that has a mesh, and its seams if it is drawn.
  struct OctreeNode {
    ChunkKey key;
    uint8_t faces = 0;
    bool split = false;
  };

  void learnApplied(uint64_t number);
  /// Forgets steps that were offered, and that nobody can take any more.
  void forgetOffers(const std::array<uint64_t, 2>& in_hand);
  /// Edits are taken up state by state: the next one when the one before is drawn, and a step that was offered is
  /// taken. So a frame shows one state, a change waits for two frames of changes at most, and however many there are,
  /// what is to be meshed again is what is drawn. While nothing is drawn they wait for the first frame: each of them
  /// would have its coarsest chunks meshed again, and it would never come.
  void takeUpEdits(PlanInput& input);
  /// Goes back to the state that is drawn.
  void giveEditsBack();
  /// For want of memory to mesh what is drawn once more: until less detail is drawn.
  void postponeEdits();
  void invalidate(std::span<const WorldChange> changes);
  void findOutdated();
  bool isReady(const ChunkKey& chunk, uint8_t seams) const;
  /// What comes nearest to the target of what is ready; none: what is drawn must stay.
  std::optional<Octree> nextTree();
  void take(std::vector<FinishedChunk>& finished, Plan& plan);
  bool canLowerDetail() const;
  /// Whether detail must be lowered yet.
  bool keepToBudget(size_t live_bytes, size_t collider_bytes);
  void retarget(std::span<const Viewer> viewers);
  ChunkSet reachedParents(std::span<const LodViewer> viewers, const LodSettings& lod) const;
  std::shared_ptr<const FrameStep> nextStep();
  void fillQueue(std::vector<WorkItem>& queue);
  void requestCoarse(std::vector<WorkItem>& queue);
  double nearDistance() const;
  static void listNodes(const Octree& tree, std::vector<OctreeNode>& nodes);
  /// Asks for what is not there yet, with what this plan asks for it already.
  void request(const ChunkKey& key, int seams, Rank rank, std::vector<WorkItem>& queue);
  /// What is known of a chunk that is drawn.
  KnownChunk knownOfDrawn(const ChunkKey& leaf) const;
  /// Counts what is wanted now, and what is not.
  void tally();
  /// Forgets chunks that nobody wants until so many bytes are freed, and they are not many more than those wanted.
  /// Precondition: tally() comes before.
  void forget(size_t bytes);

  PlannerSettings settings_;
  ChunkStore store_;
  ViewerIndex viewers_;
  std::vector<LodViewer> targeted_;  ///< what target_ was made for
  double targeted_detail_ = 0;
  ChunkSet reached_;            ///< level-1 nodes with chunks that the viewers' void leads to
  bool voids_changed_ = false;  ///< since reached_ was found
  Octree target_;
  std::vector<OctreeNode> target_nodes_, near_nodes_;
  std::shared_ptr<const DrawnFrame> applied_;
  std::shared_ptr<const FrameStep> step_;                   ///< the last one offered, not known to be taken
  std::vector<std::shared_ptr<const DrawnFrame>> offered_;  ///< what steps from applied_ lead to that may be taken
  std::vector<MissingSeams> missing_;
  WorldState edits_;
  uint64_t edits_drawn_ = 0;        ///< the state that applied_ shows
  uint64_t oldest_edits_ = 0;       ///< what was meshed under an earlier state is not taken
  std::vector<ChunkKey> outdated_;  ///< leaves of applied_ that are not there as edits_ has them
  WorldState edits_before_;         ///< before edits_ was taken up
  bool postponed_ = false;          ///< edits found no room, and wait until less detail is drawn
  double room_beside_ = 0;          ///< the share of memory that this may take then
  uint64_t edits_failed_ = 0;       ///< a state that is not drawn: a chunk of it cannot be made
  bool awaited_ = false;            ///< the last plan had a chunk to mesh, one in work or a step to be drawn
  bool edited_first_ = false;       ///< while the first frame was awaited, edits were taken up
  bool changed_ = true;             ///< since the last step was looked for
  uint64_t plans_ = 0, frames_ = 0, detail_settled_ = 0;
  uint64_t freed_in_vain_ = 0;
  size_t wanted_bytes_ = 0;  ///< of what the last plan had a use for
  size_t wanted_ = 0;        ///< how many chunks that is
  PlannerStats stats_;
};

}  // namespace sgm
