#pragma once
// The octree of drawn chunks. It keeps two rules under which seams close the surface.
//
// Nodes have chunk keys. A node of level l is split if finer chunks are drawn in its place. The coarsest meshes have
// level `top`. One level above are the virtual nodes, which fill the whole world and have no mesh; their field is the
// domain's own state, the same everywhere. An unsplit virtual node is an outer neighbour of the drawn chunks: the seam
// towards it closes the outer faces by the rule that joins two levels.
//
// The rules (mesh/seam.h): the levels of chunks that share a face differ by at most one, and around an edge of a
// level's grid split and unsplit nodes never alternate crosswise.

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
  /// The chunk drawn at a place, units; of the top level if the virtual node there is not split.
  ChunkKey leafAt(Int3 place) const;
  /// Whether split() would accept the node.
  bool canSplit(const ChunkKey& node) const;
  bool empty() const { return split_.empty(); }

  /// Splits a node and all its ancestors. If canSplit() is false, returns false and changes nothing.
  bool split(ChunkKey node);
  /// Unsplits a node and all its descendants.
  void merge(const ChunkKey& node);

  /// The drawn chunks, by virtual node, then in the order of childOf().
  std::vector<ChunkKey> leaves() const;
  /// The split nodes, coarsest first, then by place.
  std::vector<ChunkKey> splitNodes() const;

  friend bool operator==(const Octree& a, const Octree& b) { return a.top_ == b.top_ && a.split_ == b.split_; }

 private:
  int top_;
  int32_t finest_cell_;                            ///< units
  int32_t first_virtual_ = 0, last_virtual_ = -1;  ///< coordinates, on every axis, of virtual nodes inside the world
  ChunkSet split_;
};

/// A broken rule next to a split node: `needed` should be split, too. Around an edge it would also help to split
/// `or_else` or to unsplit `across`; for two faces all three are the same node.
struct BrokenRule {
  ChunkKey needed, or_else, across;
};

/// Appends the rules that a split node breaks.
void findBrokenRules(const Octree& tree, const ChunkKey& node, std::vector<BrokenRule>& broken);

/// Splits further nodes until both rules hold; if the world's end prevents that, merges the finer side.
void refineToRules(Octree& tree);

/// The faces of a drawn chunk that border a coarser one, including virtual nodes: their seams are drawn.
/// Bit (1 << Face).
uint8_t coarserFaces(const Octree& tree, const ChunkKey& leaf);

/// The blocks around a drawn chunk that belong to coarser chunks, including virtual nodes.
Neighbourhood coarserBlocks(const Octree& tree, const ChunkKey& leaf);

}  // namespace sgm
