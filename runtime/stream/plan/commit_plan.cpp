#include "stream/plan/commit_plan.h"

#include <algorithm>

namespace sgm {

namespace {

/// First builds a tree from everything that is ready. Then undoes changes that violate a rule of the octree or lack a
/// seam, until there are none. An undone change is not made again: nodes of the committed tree are restored and stay,
/// other nodes are removed and do not return. So the loop ends, at the latest with the committed tree, which satisfies
/// all rules.
class StepSearch {
 public:
  StepSearch(const Octree& committed, const Octree& target, const Readiness& ready)
      : committed_(committed), target_(target), ready_(ready), plan_{Octree(committed), {}} {}

  CommitPlan run() {
    for (const ChunkKey& root : virtualNodes()) place(root);
    while (undoBrokenRule() || undoMissingSeam()) {
    }
    return std::move(plan_);
  }

 private:
  std::vector<ChunkKey> virtualNodes() const {
    std::vector<ChunkKey> roots;
    for (const Octree* tree : {&committed_, &target_}) {
      for (const ChunkKey& node : tree->splitNodes()) {
        if (node.level <= tree->top()) break;
        roots.push_back(node);
      }
    }
    std::sort(roots.begin(), roots.end());
    roots.erase(std::unique(roots.begin(), roots.end()), roots.end());
    return roots;
  }

  bool isVirtual(const ChunkKey& node) const { return node.level > target_.top(); }
  bool canBeLeaf(const ChunkKey& node) const { return isVirtual(node) || ready_.body(node); }

  /// True if the target tree can be drawn in this node now, if necessary with coarser chunks in place of unready ones.
  bool canPlace(const ChunkKey& node) const {
    if (committed_.isSplit(node) || canBeLeaf(node)) return true;
    return target_.isSplit(node) && canPlaceChildren(node);
  }

  bool canPlaceChildren(const ChunkKey& node) const {
    for (int i = 0; i < 8; ++i) {
      if (!canPlace(childOf(node, i))) return false;
    }
    return true;
  }

  /// Adds the part of the target tree in this node to the plan. Precondition: canPlace(node), and all ancestors are
  /// split in the plan.
  void place(const ChunkKey& node) {
    Octree& tree = plan_.tree;
    if (target_.isSplit(node) && canPlaceChildren(node)) {
      tree.split(node);
      for (int i = 0; node.level > 1 && i < 8; ++i) place(childOf(node, i));
      return;
    }
    // If a leaf of the target is not ready, the drawn chunks stay. If a node that the target splits is not completely
    // ready, the drawn chunks stay as well, or a coarser chunk is drawn in its place.
    const bool keeps = target_.isSplit(node) ? committed_.isSplit(node) : !canBeLeaf(node);
    if (!keeps) tree.merge(node);
  }

  /// Restores the committed tree in the highest ancestor of this node that the plan has merged.
  void restore(ChunkKey node) {
    while (!isVirtual(node) && !plan_.tree.isSplit(parentOf(node))) node = parentOf(node);
    restoreBelow(node);
  }

  void restoreBelow(const ChunkKey& node) {
    if (!committed_.isSplit(node)) return;
    plan_.tree.split(node);
    for (int i = 0; node.level > 1 && i < 8; ++i) restoreBelow(childOf(node, i));
  }

  /// Undoes a split that the committed tree does not have: the nearest ancestor that can be drawn becomes a leaf.
  void coarsen(ChunkKey node) {
    while (!canBeLeaf(node)) node = parentOf(node);
    plan_.tree.merge(node);
  }

  bool undoBrokenRule() {
    std::vector<BrokenRule> broken;
    bool undone = false;
    for (const ChunkKey& node : plan_.tree.splitNodes()) {
      if (!plan_.tree.isSplit(node)) continue;
      broken.clear();
      findBrokenRules(plan_.tree, node, broken);
      if (broken.empty()) continue;
      undone = true;
      const BrokenRule& rule = broken.front();
      if (committed_.isSplit(rule.needed)) {
        restore(rule.needed);
      } else if (committed_.isSplit(rule.or_else)) {
        restore(rule.or_else);
      } else {
        coarsen(committed_.isSplit(node) ? rule.across : node);
      }
    }
    return undone;
  }

  bool undoMissingSeam() {
    bool undone = false;
    for (const ChunkKey& leaf : plan_.tree.leaves()) {
      if (!plan_.tree.isLeaf(leaf)) continue;
      const uint8_t needed = coarserFaces(plan_.tree, leaf);
      if (needed == 0) continue;
      const auto missing = static_cast<uint8_t>(needed & ~ready_.seams(leaf));
      if (missing == 0) continue;
      plan_.missing.push_back({leaf, missing});
      if (!committed_.isLeaf(leaf)) {
        undone = true;
        // This leaf is not a leaf of the committed tree: it results from a split above it, or from a merge of drawn
        // chunks.
        if (committed_.isSplit(leaf)) {
          restore(leaf);
        } else {
          coarsen(parentOf(leaf));
        }
        continue;
      }
      // This leaf is also a leaf of the committed tree, so a merge across one of its faces requires the missing seam.
      for (int face = 0; face < 6; ++face) {
        if (!(missing >> face & 1)) continue;
        ChunkKey neighbour = leaf;
        neighbour.at[face >> 1] += face & 1 ? 1 : -1;
        if (plan_.tree.isSplit(parentOf(neighbour))) continue;
        restore(parentOf(neighbour));
        undone |= plan_.tree.isSplit(parentOf(neighbour));
      }
    }
    return undone;
  }

  const Octree& committed_;
  const Octree& target_;
  const Readiness& ready_;
  CommitPlan plan_;
};

}  // namespace

CommitPlan planCommit(const Octree& committed, const Octree& target, const Readiness& ready) {
  return StepSearch(committed, target, ready).run();
}

}  // namespace sgm
