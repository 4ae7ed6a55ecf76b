#include "stream/plan/planner.h"

#include <algorithm>

#include "stream/plan/reachability.h"

namespace sgm {

namespace {

/// If surfaces take more than this share of the memory limit, those that are not needed are removed.
constexpr double kKeptShare = 0.6;
/// Shares of the memory limit. If needed surfaces take more than kFullShare, detail is lowered; if they take less than
/// kFreeShare, it is raised again. One change of detail changes the memory by less than the ratio of the two shares, so
/// that detail does not oscillate.
constexpr double kFullShare = 0.55, kFreeShare = 0.25;
/// If drawn surfaces take more than this share of the memory limit, edits are postponed, because memory does not
/// suffice for both the old and the new version of chunks.
constexpr double kSqueezedShare = 0.75;
constexpr double kLessDetail = 0.8, kLeastDetail = 1.0 / 64;
/// The minimum of the factor by which the requested distances are multiplied. The planner lowers this factor if a plan
/// would have too many chunks.
constexpr double kLeastReach = 1e-6;
/// The share of LodSettings::finest_distance within which chunks count as near a viewer, if there are no colliders.
constexpr double kNearShare = 2.0 / 3;
/// The number of plans between two counts of the needed chunks, while there is enough memory.
constexpr uint64_t kPlansToTally = 16;
/// If the octree of the chunks that viewers need to stand on has more nodes than this (half a second of work or more),
/// a coarse version of the whole view is meshed first. Its finest cells have level kPictureLevel, so that it has a 64th
/// of the chunks.
constexpr size_t kCrowd = 1024;
constexpr int kPictureLevel = 3;
/// The maximum number of records is twice the number of needed chunks plus this number.
constexpr size_t kKeptBeside = 1024;
/// The minimum number of plans between two changes of detail.
constexpr uint64_t kPlansToSettle = 20;

}  // namespace

Planner::Planner(const PlannerSettings& settings, WorldState first)
    : settings_(settings),
      viewers_({}, settings.lod),
      target_(settings.lod.top, settings.lod.finest_cell),
      applied_(std::make_shared<DrawnFrame>(Octree(settings.lod.top, settings.lod.finest_cell))),
      edits_(std::move(first)) {}

Plan Planner::plan(PlanInput&& input) {
  ++plans_;
  Plan plan;
  for (const ChunkKey& key : input.begun) store_.at(key).in_work = true;
  take(input.finished, plan);
  learnApplied(input.applied);
  forgetOffers(input.in_hand);
  findOutdated();
  takeUpEdits(input);
  plan.edits = edits_;
  stats_.edits_drawn = edits_drawn_;
  if (input.viewers.empty()) {
    step_ = nullptr;
    changed_ = true;
    plan.idle = true;
    return plan;
  }
  retarget(input.viewers);
  if (changed_) {
    changed_ = false;
    step_ = nextStep();
    if (step_ != nullptr) offered_.push_back(step_->to);
  }
  plan.step = step_;
  awaited_ = step_ != nullptr;
  fillQueue(plan.queue);
  awaited_ = awaited_ || !plan.queue.empty();
  stats_.drawn = applied_->drawn.size();
  stats_.edits_drawn = edits_drawn_;
  stats_.edits_failed = edits_failed_;
  const bool edits_wait = edits_.number < input.edits.number && edits_failed_ < input.edits.number;
  plan.idle = plan.queue.empty() && plan.step == nullptr && !edits_wait;
  if (plan.idle || plans_ % kPlansToTally == 0) {
    tally();
    forget(0);
  }
  if (keepToBudget(input.live_bytes, input.collider_bytes)) plan.idle = false;
  if (plan.edits.number != edits_.number) {
    plan.queue.clear();
    plan.step = nullptr;
    plan.edits = edits_;
  }
  return plan;
}

void Planner::restart(std::shared_ptr<const DrawnFrame> drawn) {
  store_.clear();
  offered_.clear();
  missing_.clear();
  step_ = nullptr;
  targeted_.clear();
  changed_ = true;
  applied_ = std::move(drawn);
  edits_drawn_ = applied_->edits;
  oldest_edits_ = edits_.number;
  postponed_ = false;
  frames_ = std::max(frames_, applied_->number);
  voids_changed_ = true;
  for (const ChunkKey& leaf : applied_->tree.leaves()) {
    KnownChunk& record = store_.at(leaf);
    if (edits_drawn_ == edits_.number) {
      record = knownOfDrawn(leaf);
    } else {  // it is unknown which chunks the edits have changed, so all count as outdated
      record.edited = edits_.number;
      record.ever_drawn = true;
    }
  }
}

KnownChunk Planner::knownOfDrawn(const ChunkKey& leaf) const {
  KnownChunk known;
  known.surface = applied_->find(leaf);
  known.body = known.ever_drawn = true;
  known.seams = known.surface != nullptr ? known.surface->seams : coarserFaces(applied_->tree, leaf);
  return known;
}

void Planner::learnApplied(uint64_t number) {
  // The step that the engine has applied need not be the latest one: the engine may have taken an earlier offered step
  // while the planner prepared a better one.
  const auto taken =
      std::find_if(offered_.begin(), offered_.end(), [number](const auto& frame) { return frame->number == number; });
  if (taken == offered_.end()) return;
  applied_ = std::move(*taken);
  edits_drawn_ = applied_->edits;
  offered_.clear();
  step_ = nullptr;
  changed_ = true;
  // If the engine took the step late, records of its chunks may have been removed in the meantime; they are restored.
  for (const ChunkKey& leaf : applied_->tree.leaves()) {
    KnownChunk& record = store_.at(leaf);
    record.ever_drawn = true;
    if (record.edited > edits_drawn_ || isReady(leaf, coarserFaces(applied_->tree, leaf))) continue;
    KnownChunk known = knownOfDrawn(leaf);
    record.surface = std::move(known.surface);
    record.body = known.body;
    record.seams = known.seams;
  }
}

void Planner::forgetOffers(const std::array<uint64_t, 2>& in_hand) {
  std::erase_if(offered_, [&](const std::shared_ptr<const DrawnFrame>& frame) {
    return frame->number != in_hand[0] && frame->number != in_hand[1] &&
           (step_ == nullptr || frame->number != step_->to->number);
  });
}

void Planner::take(std::vector<FinishedChunk>& finished, Plan& plan) {
  for (FinishedChunk& chunk : finished) {
    KnownChunk& record = store_.at(chunk.request.key);
    record.in_work = false;
    if (chunk.edits < std::max(record.edited, oldest_edits_) || chunk.edits > edits_.number) {
      changed_ = true;
      ++stats_.edited;
      continue;
    }
    if (chunk.error) {
      // The chunk is requested again if memory ran out or the request was cancelled. Any other error would recur, so
      // the chunk counts as failed.
      if (chunk.error->code == Code::cancelled || chunk.error->code == Code::out_of_memory) continue;
      record.failed = true;
      ++stats_.failed;
      plan.failed.push_back({chunk.request.key, std::move(*chunk.error)});
      continue;
    }
    // After a restart of the planner, two results may arrive for a chunk. The second one does not extend the current
    // surface, so it is dropped.
    if (chunk.request.body ? record.body : record.surface != chunk.before) continue;
    changed_ = true;
    ++(chunk.request.body ? stats_.meshed : stats_.seam_jobs);
    if (chunk.request.body && chunk.request.key.level == 0) ++stats_.finest;
    stats_.rounded += chunk.rounded;
    if (chunk.voids != nullptr) {
      record.voids = std::move(chunk.voids);
      voids_changed_ = true;
    }
    record.body = true;
    record.seams = static_cast<uint8_t>(record.seams | chunk.request.seams);
    record.surface = std::move(chunk.surface);
  }
}

bool Planner::isReady(const ChunkKey& chunk, uint8_t seams) const {
  const KnownChunk* record = store_.find(chunk);
  return record != nullptr && record->body && (seams & ~record->seams) == 0;
}

void Planner::retarget(std::span<const Viewer> viewers) {
  viewers_ = ViewerIndex(viewers, settings_.lod, settings_.all_around);
  LodSettings lod = settings_.lod;
  lod.finest_distance *= stats_.detail;
  std::vector<LodViewer> wanting = lodViewers(viewers, lod);
  for (double reach = 1; expectedLeaves(wanting, lod) > kMaxExpectedLeaves && reach > kLeastReach;) {
    reach *= kLessDetail;
    for (LodViewer& viewer : wanting) viewer.reach *= kLessDetail;
  }
  const bool moved = wanting != targeted_ || targeted_detail_ != stats_.detail;
  if (settings_.by_reach && (moved || voids_changed_)) {
    voids_changed_ = false;
    ChunkSet reached = reachedParents(wanting, lod);
    if (!moved && reached == reached_) return;
    reached_ = std::move(reached);
  } else if (!moved) {
    return;
  }
  const ChunkSet* const reached = settings_.by_reach ? &reached_ : nullptr;
  target_ = lodTarget(wanting, lod, reached);
  listNodes(target_, target_nodes_);
  listNodes(nearTarget(wanting, lod, std::min(nearDistance(), lod.finest_distance), reached), near_nodes_);
  targeted_ = std::move(wanting);
  targeted_detail_ = stats_.detail;
  changed_ = true;
}

ChunkSet Planner::reachedParents(std::span<const LodViewer> viewers, const LodSettings& lod) const {
  std::vector<std::array<double, 3>> places;
  double reach = 0;
  for (const LodViewer& viewer : viewers) {
    places.push_back(viewer.position);
    reach = std::max(reach, viewer.reach);
  }
  // The radius is larger than the finest distance, because nodes are split as a whole: some chunks of a node are
  // farther away than the node's nearest point.
  const double radius = lod.finest_distance * reach + 2.0 * kChunkCells * lod.finest_cell;
  const VoidLookup voids = [this](const ChunkKey& key) -> const VoidComponents* {
    const KnownChunk* record = store_.find(key);
    return record != nullptr ? record->voids.get() : nullptr;
  };
  ChunkSet parents;
  for (const ReachedChunk& chunk : reachedChunks(places, radius, lod.finest_cell, voids)) {
    parents.insert(parentOf(chunk.key));
  }
  return parents;
}

std::optional<Octree> Planner::nextTree() {
  missing_.clear();
  if (!outdated_.empty()) return std::nullopt;
  const Readiness ready{[this](const ChunkKey& key) {
                          const KnownChunk* record = store_.find(key);
                          return record != nullptr && record->body;
                        },
                        [this](const ChunkKey& key) {
                          const KnownChunk* record = store_.find(key);
                          return record != nullptr ? record->seams : uint8_t{0};
                        }};
  CommitPlan commit = planCommit(applied_->tree, target_, ready);
  missing_ = std::move(commit.missing);
  return std::move(commit.tree);
}

std::shared_ptr<const FrameStep> Planner::nextStep() {
  const std::optional<Octree> tree = nextTree();
  const bool moves = tree && *tree != applied_->tree;
  if (!tree || (!moves && edits_drawn_ == edits_.number)) return nullptr;
  auto frame = std::make_shared<DrawnFrame>(drawFrame(*tree, [this](const ChunkKey& key, uint8_t seams) {
    // The engine's current surface is reused if its content is unchanged and it has all drawn seams.
    std::shared_ptr<const ChunkSurface> drawn = applied_->find(key);
    const KnownChunk& record = *store_.find(key);
    const bool same = drawn != nullptr && (record.edited <= edits_drawn_ ||
                                           (record.surface != nullptr && sameContent(*record.surface, *drawn)));
    return same && (seams & ~drawn->seams) == 0 ? drawn : record.surface;
  }));
  auto step = std::make_shared<FrameStep>();
  step->from = applied_->number;
  step->changes = changesBetween(*applied_, *frame);
  if (!moves && step->changes.empty()) {
    edits_drawn_ = edits_.number;  // the edits have changed nothing that is visible
    return nullptr;
  }
  frame->number = ++frames_;
  frame->edits = edits_.number;
  for (const ChunkKey& leaf : frame->tree.leaves()) store_.at(leaf).ever_drawn = true;
  step->to = std::move(frame);
  return step;
}

double Planner::nearDistance() const {
  return settings_.all_around > 0 ? settings_.all_around : kNearShare * settings_.lod.finest_distance;
}

void Planner::listNodes(const Octree& tree, std::vector<OctreeNode>& nodes) {
  nodes.clear();
  const auto visit = [&](const auto& self, const ChunkKey& node) -> void {
    const bool split = tree.isSplit(node);
    if (node.level <= tree.top()) nodes.push_back({node, coarserFaces(tree, node), split});
    for (int i = 0; split && i < 8; ++i) self(self, childOf(node, i));
  };
  for (const ChunkKey& node : tree.splitNodes()) {
    if (node.level <= tree.top()) break;
    visit(visit, node);
  }
}

void Planner::requestCoarse(std::vector<WorkItem>& queue) {
  const Octree& drawn = applied_->tree;
  bool any = false;
  for (const OctreeNode& node : target_nodes_) {
    if (node.key.level < kPictureLevel || drawn.isSplit(node.key) || drawn.isLeaf(node.key)) continue;
    any = true;
    // The request includes seams towards the chunks that are currently drawn around the node.
    request(node.key, node.faces | coarserFaces(drawn, node.key), Rank::coarse, queue);
  }
  if (!any) return;
  for (const MissingSeams& missing : missing_) request(missing.chunk, missing.faces, Rank::coarse, queue);
}

void Planner::fillQueue(std::vector<WorkItem>& queue) {
  const Octree& drawn = applied_->tree;
  for (const ChunkKey& leaf : outdated_) request(leaf, coarserFaces(drawn, leaf), Rank::edited, queue);
  if (near_nodes_.size() > kCrowd) requestCoarse(queue);
  for (const OctreeNode& node : near_nodes_) {
    if (node.split || drawn.isSplit(node.key)) continue;
    // This chunk would stand in for finer chunks of the target. That is useful only if an even coarser chunk is drawn
    // there now.
    const bool stands_in = target_.isSplit(node.key);
    if (!stands_in || !drawn.isLeaf(parentOf(node.key))) request(node.key, node.faces, Rank::near, queue);
  }
  for (const OctreeNode& node : target_nodes_) {
    if (!node.split) {
      request(node.key, node.faces, Rank::other, queue);
    } else if (!drawn.isSplit(node.key) && !drawn.isLeaf(node.key)) {
      // The drawn tree approaches the target in steps. If the target splits a node that is not drawn yet, the node's
      // own chunk is requested too: it is drawn until everything inside the node is ready.
      request(node.key, node.faces | coarserFaces(drawn, node.key), Rank::other, queue);
    }
  }
  for (const MissingSeams& missing : missing_) request(missing.chunk, missing.faces, Rank::other, queue);
  std::sort(queue.begin(), queue.end(), [](const WorkItem& a, const WorkItem& b) {
    if (a.rank != b.rank) return a.rank > b.rank;
    if (a.rank == Rank::coarse && a.request.key.level != b.request.key.level) {
      return a.request.key.level < b.request.key.level;
    }
    return a.urgency != b.urgency ? a.urgency > b.urgency : a.request.key > b.request.key;
  });
}

void Planner::request(const ChunkKey& key, int seams, Rank rank, std::vector<WorkItem>& queue) {
  KnownChunk& record = store_.at(key);
  record.wanted = plans_;
  const auto missing = static_cast<uint8_t>(seams & ~record.seams);
  awaited_ = awaited_ || record.in_work;
  if (record.in_work || record.failed || (record.body && missing == 0)) return;
  if (record.queued == plans_) {
    uint8_t& faces = queue[record.queue_at].request.seams;
    faces = static_cast<uint8_t>(faces | missing);
    return;
  }
  record.queued = plans_;
  record.queue_at = queue.size();
  WorkItem item;
  item.request.key = key;
  item.request.seams = missing;
  item.request.body = !record.body;
  item.request.anchors = !record.body && key.level == 0;
  item.request.signs = !record.body && key.level == 0 && settings_.by_reach;
  item.request.outermost = key.level == target_.top();
  item.before = record.surface;
  item.rank = rank;
  item.urgency = viewers_.urgency(key);
  queue.push_back(std::move(item));
}

void Planner::tally() {
  for (const ChunkKey& leaf : applied_->tree.leaves()) store_.at(leaf).wanted = plans_;
  for (const std::shared_ptr<const DrawnFrame>& frame : offered_) {
    for (const ChunkKey& leaf : frame->tree.leaves()) store_.at(leaf).wanted = plans_;
  }
  stats_.records = store_.size();
  stats_.record_bytes = 0;
  stats_.never_drawn = freed_in_vain_;
  wanted_bytes_ = wanted_ = 0;
  for (const ChunkKey& leaf : outdated_) {
    const std::shared_ptr<const ChunkSurface> drawn = applied_->find(leaf);
    if (drawn != nullptr) wanted_bytes_ += drawn->bytes();
  }
  store_.forEach([&](const ChunkKey&, const KnownChunk& record) {
    stats_.record_bytes += record.bytes() - (record.surface != nullptr ? record.surface->bytes() : 0);
    if (record.wanted == plans_) {
      ++wanted_;
      wanted_bytes_ += record.bytes();
    } else if (record.body && !record.ever_drawn) {
      ++stats_.never_drawn;
    }
  });
}

void Planner::forget(size_t bytes) {
  const size_t most = 2 * wanted_ + kKeptBeside;
  if (bytes == 0 && store_.size() <= most) return;
  freed_in_vain_ += store_.freeUnused(plans_, bytes, most).never_drawn;
}

bool Planner::canLowerDetail() const { return stats_.detail > kLeastDetail; }

bool Planner::keepToBudget(size_t live_bytes, size_t collider_bytes) {
  const auto share = [cap = static_cast<double>(settings_.mesh_bytes)](double part) {
    return static_cast<size_t>(part * cap);
  };
  const size_t known_bytes = live_bytes + stats_.record_bytes;
  if (known_bytes > share(kKeptShare)) {
    tally();
    forget(known_bytes - share(kKeptShare));
  }
  const bool squeezed = !outdated_.empty() && live_bytes > share(kSqueezedShare) && canLowerDetail();
  if (squeezed) postponeEdits();
  const size_t used = wanted_bytes_ + collider_bytes;
  const bool full = used > share(postponed_ ? room_beside_ : kFullShare) && canLowerDetail();
  const bool free = used < share(kFreeShare) && stats_.detail < 1;
  if ((full || free) && plans_ >= detail_settled_) {
    stats_.detail = full ? stats_.detail * kLessDetail : std::min(1.0, stats_.detail / kLessDetail);
    detail_settled_ = plans_ + kPlansToSettle;
  }
  return full || squeezed;
}

}  // namespace sgm
