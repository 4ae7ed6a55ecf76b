// The part of the planner that adopts changes of the world, and returns to an earlier state if a change cannot be
// drawn.

#include <algorithm>

#include "stream/plan/planner.h"

namespace sgm {

namespace {

/// Twice the share of the memory limit that needed chunks may take (room_beside_) after edits were postponed for the
/// first time. Each further postponement of these edits halves the share.
constexpr double kFirstRoom = 0.5;

}  // namespace

void Planner::takeUpEdits(PlanInput& input) {
  const bool fails = !outdated_.empty() && std::all_of(outdated_.begin(), outdated_.end(),
                                                       [this](const ChunkKey& leaf) { return store_.at(leaf).failed; });
  if (fails) {
    // The world keeps showing the state before the failed edits. The next edit, for example an undo, may remove the
    // cause of the failure.
    edits_failed_ = edits_.number;
    giveEditsBack();
  }
  if (edits_drawn_ != edits_.number) return;
  // Before the first frame, edits are adopted once, so that they appear soon; adopting edits in every plan would delay
  // the first frame forever.
  const bool is_first = applied_->tree.empty() && awaited_;
  if (is_first && edited_first_) return;
  if (input.edits.number == edits_.number) postponed_ = false;
  if (input.edits.number == edits_.number || input.edits.number <= edits_failed_) return;
  if (postponed_ && canLowerDetail() &&
      wanted_bytes_ > static_cast<size_t>(room_beside_ * static_cast<double>(settings_.mesh_bytes))) {
    return;
  }
  edited_first_ = is_first;
  edits_before_ = std::move(edits_);
  edits_ = std::move(input.edits);
  store_.setEdits(edits_.number);
  invalidate(input.edited);
  findOutdated();
  step_ = nullptr;
  changed_ = true;
}

void Planner::invalidate(std::span<const WorldChange> changes) {
  std::vector<std::vector<IntBox>> reaches(static_cast<size_t>(target_.top()) + 1);
  for (size_t level = 0; level < reaches.size(); ++level) {
    for (const WorldChange& change : changes) {
      reaches[level].push_back(editReach(change.box, settings_.lod.finest_cell << level));
    }
  }
  store_.forEach([&](const ChunkKey& key, KnownChunk& record) {
    const int64_t cell = int64_t{settings_.lod.finest_cell} << key.level, edge = kChunkCells * cell;
    IntBox box;
    for (int axis = 0; axis < 3; ++axis) {
      box.lo[axis] = saturate(key.at[axis] * edge);
      box.hi[axis] = saturate((key.at[axis] + int64_t{1}) * edge);
    }
    if (settings_.sharp) box = box.grown(saturate(sharpReach(2 * cell)));
    const std::vector<IntBox>& reach = reaches[static_cast<size_t>(key.level)];
    const bool touched = std::any_of(reach.begin(), reach.end(), [&box](const IntBox& r) { return r.meets(box); }) ||
                         std::any_of(changes.begin(), changes.end(), [&key](const WorldChange& change) {
                           return change.field && change.field->touches(key);
                         });
    if (!touched) return;
    if (record.body) ++stats_.outdated;
    // Keep record.voids until the new voids are known. The search for reachable chunks (reachability.h) stops at a
    // chunk with unknown voids, so without record.voids the chunks behind it would lose level 0 for a while.
    record.surface = nullptr;
    record.body = record.failed = false;
    record.seams = 0;
    record.edited = edits_.number;
  });
}

void Planner::postponeEdits() {
  room_beside_ = (postponed_ ? room_beside_ : kFirstRoom) / 2;
  postponed_ = true;
  giveEditsBack();
}

void Planner::giveEditsBack() {
  edits_ = edits_before_;
  store_.setEdits(edits_.number);
  store_.forEach([this](const ChunkKey& key, KnownChunk& record) {
    if (record.edited <= edits_drawn_) return;
    const KnownChunk known = applied_->tree.isLeaf(key) ? knownOfDrawn(key) : KnownChunk{};
    record.surface = known.surface;
    record.body = known.body;
    record.seams = known.seams;
    record.failed = false;
    record.edited = edits_drawn_;
  });
  outdated_.clear();
  changed_ = true;
}

void Planner::findOutdated() {
  outdated_.clear();
  if (edits_drawn_ == edits_.number) return;
  for (const ChunkKey& leaf : applied_->tree.leaves()) {
    if (!isReady(leaf, coarserFaces(applied_->tree, leaf))) outdated_.push_back(leaf);
  }
}

}  // namespace sgm
