#include "stream/plan/commit_plan.h"

#include <algorithm>

namespace sgm {

namespace {

/// Searches the next octree. First builds a tree with every change that is ready. Then undoes each change that violates
/// a rule of the octree or lacks a seam, until no such change is left. An undone change is not made again: nodes of the
/// committed tree are restored and stay, other nodes are removed and do not return. So the loop ends, at the latest
/// with the committed tree, which satisfies all rules.
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

  /// True if the target tree can be drawn within this node now. Coarser chunks, or the chunks that are drawn already,
  /// may stand in for chunks that are not ready.
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

  /// Adds the part of the target tree within this node to the plan. Precondition: canPlace(node), and all ancestors are
  /// split in the plan.
  void place(const ChunkKey& node) {
    Octree& tree = plan_.tree;
    if (target_.isSplit(node) && canPlaceChildren(node)) {
      tree.split(node);
      for (int i = 0; node.level > 1 && i < 8; ++i) place(childOf(node, i));
      return;
    }
    // If a leaf of the target is not ready, the drawn chunks stay. If the target splits a node, but not everything
    // inside the node is ready, the drawn chunks stay as well, or the node's own chunk is drawn instead.
    const bool keeps = target_.isSplit(node) ? committed_.isSplit(node) : !canBeLeaf(node);
    if (!keeps) tree.merge(node);
  }

  /// If the plan has merged ancestors of this node, restores the committed tree below the coarsest one of them;
  /// otherwise below the node itself.
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
        // The committed tree does not have this leaf: the leaf results from a split above it, or from a merge of drawn
        // chunks.
        if (committed_.isSplit(leaf)) {
          restore(leaf);
        } else {
          coarsen(parentOf(leaf));
        }
        continue;
      }
      // The committed tree also has this leaf, so the missing seam is needed only because the neighbour across a face
      // was merged. That merge is undone.
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
