#pragma once
// Which chunks are drawn: an octree of chunks that keeps the two rules under which seams close it.
//
// Nodes are named as chunks are. A node of level l is split where chunks finer than l are drawn in its place. The
// coarsest meshes are of level `top`; one level above stand the virtual nodes, which fill the whole world, have no mesh
// and whose field is the domain's own state, everywhere the same. A virtual node that is not split is the outer
// neighbour of what is drawn: the seam to it closes the outer faces, by the very rule that joins two levels.
//
// The rules (mesh/seam.h): chunks that share a face differ by one level at most, and around an edge of the grid of a
// level split and unsplit nodes never stand crosswise.

#include <vector>

#include "mesh/fans.h"
#include "stream/plan/chunk_set.h"

namespace sgm {

/// A value: copies are independent.
class Octree {
 public:
  /// top: coarsest level with meshes, 0..kMaxLevel. finest_cell: edge of a level-0 cell in units; only virtual nodes
  /// that lie wholly inside the world can be split.
  Octree(int top, int32_t finest_cell);

  int top() const { return top_; }
  bool isSplit(const ChunkKey& node) const { return split_.contains(node); }
  /// Whether this chunk is drawn.
  bool isLeaf(const ChunkKey& node) const { return node.level <= top_ && isSplit(parentOf(node)) && !isSplit(node); }
  /// The chunk drawn at a place, units; of the top level where the virtual node there is not split.
  ChunkKey leafAt(Int3 place) const;
  /// Whether split() would accept the node.
  bool canSplit(const ChunkKey& node) const;
  bool empty() const { return split_.empty(); }

  /// Splits a node and all that hold it. False, and nothing changes, where canSplit() says no.
  bool split(ChunkKey node);
  /// Unsplits a node and all nodes in it.
  void merge(const ChunkKey& node);

  /// The chunks drawn, by virtual node, then in the order of childOf().
  std::vector<ChunkKey> leaves() const;
  /// The split nodes, coarsest first, then by place.
  std::vector<ChunkKey> splitNodes() const;

  friend bool operator==(const Octree& a, const Octree& b) { return a.top_ == b.top_ && a.split_ == b.split_; }

 private:
  int top_;
  int32_t finest_cell_;                            ///< units
  int32_t first_virtual_ = 0, last_virtual_ = -1;  ///< places, on every axis, of virtual nodes inside the world
  ChunkSet split_;
};

/// What breaks a rule next to a split node: `needed` would have to be split too. Around an edge, `or_else` would do as
/// well, or not to split `across`; where two faces meet they are all the same node.
struct BrokenRule {
  ChunkKey needed, or_else, across;
};

/// Appends the rules that a split node breaks.
void findBrokenRules(const Octree& tree, const ChunkKey& node, std::vector<BrokenRule>& broken);

/// Splits further nodes until both rules hold; where the world's end forbids that, merges the finer side.
void refineToRules(Octree& tree);

/// Faces of a drawn chunk across which a coarser one lies, virtual ones included: those whose seam is drawn.
/// Bit (1 << Face).
uint8_t coarserFaces(const Octree& tree, const ChunkKey& leaf);

/// The blocks around a drawn chunk that belong to coarser ones, virtual ones included.
Neighbourhood coarserBlocks(const Octree& tree, const ChunkKey& leaf);

}  // namespace sgm
