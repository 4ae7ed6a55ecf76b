#include "stream/planner.h"

#include <algorithm>

#include "stream/reachability.h"

namespace sgm {

namespace {

/// The share of the memory's cap up to which surfaces are kept that nobody uses now.
constexpr double kKeptShare = 0.6;
/// Of what is used: above this share detail is lowered, below that one it comes back. Their ratio is more than what one
/// step changes, so that detail does not swing.
constexpr double kFullShare = 0.55, kFreeShare = 0.25;
constexpr double kLessDetail = 0.8, kLeastDetail = 1.0 / 64;
/// Plans from one count of what is wanted to the next, where memory is not scarce.
constexpr uint64_t kPlansToTally = 16;
/// Plans after a change of detail before the next.
constexpr uint64_t kPlansToSettle = 20;

}  // namespace

Planner::Planner(const PlannerSettings& settings)
    : settings_(settings),
      target_(settings.lod.top, settings.lod.finest_cell),
      applied_(std::make_shared<DrawnFrame>(Octree(settings.lod.top, settings.lod.finest_cell))) {}

Plan Planner::plan(PlanInput&& input) {
  ++plans_;
  Plan plan;
  for (const ChunkKey& key : input.begun) store_.at(key).in_work = true;
  take(input.finished, plan);
  refuse(input.refused, plan);
  learnApplied(input.applied);
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
  fillQueue(plan.queue);
  stats_.drawn = applied_->drawn.size();
  plan.idle = plan.queue.empty() && plan.step == nullptr;
  if (plan.idle || plans_ % kPlansToTally == 0) tally();
  keepToBudget(input.live_bytes);
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
  frames_ = std::max(frames_, applied_->number);
  voids_changed_ = true;
  for (const ChunkKey& leaf : applied_->tree.leaves()) {
    KnownChunk& record = store_.at(leaf);
    record.surface = applied_->find(leaf);
    record.body = record.ever_drawn = true;
    record.seams = record.surface != nullptr ? record.surface->seams : coarserFaces(applied_->tree, leaf);
  }
}

void Planner::learnApplied(uint64_t number) {
  // A step may be taken while a better one is being planned in its place.
  const auto taken =
      std::find_if(offered_.begin(), offered_.end(), [number](const auto& frame) { return frame->number == number; });
  if (taken == offered_.end()) return;
  applied_ = std::move(*taken);
  offered_.clear();
  step_ = nullptr;
  changed_ = true;
}

void Planner::take(std::vector<FinishedChunk>& finished, Plan& plan) {
  for (FinishedChunk& chunk : finished) {
    KnownChunk& record = store_.at(chunk.request.key);
    record.in_work = false;
    if (chunk.error) {
      // Scarce memory may come back; anything else would fail again.
      if (chunk.error->code == Code::cancelled || chunk.error->code == Code::out_of_memory) continue;
      record.failed = true;
      ++stats_.failed;
      plan.failed.push_back({chunk.request.key, std::move(*chunk.error)});
      continue;
    }
    changed_ = true;
    ++(chunk.request.body ? stats_.meshed : stats_.seam_jobs);
    if (chunk.request.body && chunk.request.key.level == 0) ++stats_.finest;
    if (chunk.voids != nullptr) {
      record.voids = std::move(chunk.voids);
      voids_changed_ = true;
    }
    record.body = true;
    record.seams = static_cast<uint8_t>(record.seams | chunk.request.seams);
    record.surface = std::move(chunk.surface);
  }
}

void Planner::refuse(const std::vector<ChunkKey>& refused, Plan& plan) {
  for (const ChunkKey& key : refused) {
    KnownChunk& record = store_.at(key);
    if (record.failed) continue;
    const size_t bytes = record.bytes();
    record = KnownChunk{};
    record.failed = true;
    ++stats_.failed;
    changed_ = true;
    plan.failed.push_back({key, Error{Code::limit, "a chunk's mesh has " + std::to_string(bytes) +
                                                       " bytes, more than may be handed over in one frame"}});
  }
}

void Planner::retarget(std::span<const Viewer> viewers) {
  viewers_.assign(viewers.begin(), viewers.end());
  LodSettings lod = settings_.lod;
  lod.finest_distance *= stats_.detail;
  std::vector<LodViewer> wanting = lodViewers(viewers, lod);
  const bool moved = wanting != targeted_ || targeted_detail_ != stats_.detail;
  if (settings_.by_reach && (moved || voids_changed_)) {
    voids_changed_ = false;
    ChunkSet reached = reachedParents(wanting, lod);
    if (!moved && reached == reached_) return;
    reached_ = std::move(reached);
  } else if (!moved) {
    return;
  }
  target_ = lodTarget(wanting, lod, settings_.by_reach ? &reached_ : nullptr);
  listTarget();
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
  // A node is split as a whole: chunks of it lie farther away than the node does.
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

std::shared_ptr<const FrameStep> Planner::nextStep() {
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
  if (commit.tree == applied_->tree) return nullptr;
  auto frame = std::make_shared<DrawnFrame>(drawFrame(commit.tree, [&](const ChunkKey& key, uint8_t seams) {
    // What an engine has already it keeps, where it holds all that is drawn.
    const std::shared_ptr<const ChunkSurface> drawn = applied_->find(key);
    return drawn != nullptr && (seams & ~drawn->seams) == 0 ? drawn : store_.find(key)->surface;
  }));
  frame->number = ++frames_;
  for (const ChunkKey& leaf : frame->tree.leaves()) store_.at(leaf).ever_drawn = true;
  auto step = std::make_shared<FrameStep>();
  step->from = applied_->number;
  step->changes = changesBetween(*applied_, *frame);
  step->to = std::move(frame);
  return step;
}

void Planner::listTarget() {
  target_nodes_.clear();
  const auto visit = [this](const auto& self, const ChunkKey& node) -> void {
    const bool split = target_.isSplit(node);
    if (node.level <= target_.top()) {
      target_nodes_.push_back({node, coarserFaces(target_, node), split});
    }
    for (int i = 0; split && i < 8; ++i) self(self, childOf(node, i));
  };
  for (const ChunkKey& node : target_.splitNodes()) {
    if (node.level <= target_.top()) break;
    visit(visit, node);
  }
}

void Planner::fillQueue(std::vector<WorkItem>& queue) {
  const Octree& drawn = applied_->tree;
  for (const TargetNode& node : target_nodes_) {
    if (!node.split) {
      request(node.key, node.faces, queue);
    } else if (!drawn.isSplit(node.key) && !drawn.isLeaf(node.key)) {
      // What is drawn leads to the target in steps: a node that is to be split, and is not even drawn whole, stands in
      // until all that is in it is there.
      request(node.key, node.faces | coarserFaces(drawn, node.key), queue);
    }
  }
  for (const MissingSeams& missing : missing_) request(missing.chunk, missing.faces, queue);
  std::sort(queue.begin(), queue.end(), [](const WorkItem& a, const WorkItem& b) {
    return a.urgency != b.urgency ? a.urgency > b.urgency : a.request.key > b.request.key;
  });
}

void Planner::request(const ChunkKey& key, int seams, std::vector<WorkItem>& queue) {
  KnownChunk& record = store_.at(key);
  record.wanted = plans_;
  const auto missing = static_cast<uint8_t>(seams & ~record.seams);
  if (record.in_work || record.failed || (record.body && missing == 0)) return;
  WorkItem item;
  item.request.key = key;
  item.request.seams = missing;
  item.request.body = !record.body;
  item.request.anchors = !record.body && key.level == 0;
  item.request.signs = !record.body && key.level == 0 && settings_.by_reach;
  item.request.outermost = key.level == target_.top();
  item.before = record.surface;
  item.urgency = urgency(key, viewers_, settings_.lod);
  queue.push_back(std::move(item));
}

void Planner::tally() {
  for (const ChunkKey& leaf : applied_->tree.leaves()) store_.at(leaf).wanted = plans_;
  if (step_ != nullptr) {
    for (const ChunkKey& leaf : step_->to->tree.leaves()) store_.at(leaf).wanted = plans_;
  }
  stats_.records = store_.size();
  stats_.never_drawn = freed_in_vain_;
  wanted_bytes_ = 0;
  store_.forEach([&](const ChunkKey&, const KnownChunk& record) {
    if (record.wanted == plans_) {
      wanted_bytes_ += record.bytes();
    } else if (record.body && !record.ever_drawn) {
      ++stats_.never_drawn;
    }
  });
}

void Planner::keepToBudget(size_t live_bytes) {
  const auto share = [cap = static_cast<double>(settings_.mesh_bytes)](double part) {
    return static_cast<size_t>(part * cap);
  };
  if (live_bytes > share(kKeptShare)) {
    tally();
    const ChunkStore::Freed freed = store_.freeUnused(plans_, live_bytes - share(kKeptShare));
    freed_in_vain_ += freed.never_drawn;
  }
  if (plans_ < detail_settled_) return;
  if (wanted_bytes_ > share(kFullShare) && stats_.detail > kLeastDetail) {
    stats_.detail *= kLessDetail;
  } else if (wanted_bytes_ < share(kFreeShare) && stats_.detail < 1) {
    stats_.detail = std::min(1.0, stats_.detail / kLessDetail);
  } else {
    return;
  }
  detail_settled_ = plans_ + kPlansToSettle;
}

}  // namespace sgm
