#pragma once
// The octree of drawn chunks. It keeps two rules that allow seams to close the surface.
//
// Nodes are identified by chunk keys. A node is split if finer chunks are drawn instead of it. The coarsest meshes have
// level `top`. The nodes one level above are VIRTUAL: they fill the whole world and have no mesh; their field is the
// domain's own state (solid or void), the same everywhere. A virtual node that is not split is an outer neighbour of
// the drawn chunks: a seam towards it closes their outer faces, in the same way as a seam between two levels.
//
// The rules (mesh/seam.h): the levels of chunks that share a face differ by at most one; and the four nodes of one
// level around an edge never form a checkerboard, in which two diagonally opposite nodes are split and the other two
// are not.

#include <vector>

#include "mesh/fans.h"
#include "stream/plan/chunk_set.h"

namespace sgm {

/// An octree with value semantics: copies are independent.
class Octree {
 public:
  /// top: coarsest level with meshes, 0..kMaxLevel. finest_cell: edge of a level-0 cell in units. Only virtual nodes
  /// that lie completely inside the world can be split.
  Octree(int top, int32_t finest_cell);

  int top() const { return top_; }
  bool isSplit(const ChunkKey& node) const { return split_.contains(node); }
  /// True if the chunk of this node is drawn.
  bool isLeaf(const ChunkKey& node) const { return node.level <= top_ && isSplit(parentOf(node)) && !isSplit(node); }
  /// Returns the drawn chunk at a position (in units). If the virtual node there is not split, returns the chunk of the
  /// top level, although it is not drawn.
  ChunkKey leafAt(Int3 place) const;
  /// True if the node can be split, because its virtual node lies inside the world.
  bool canSplit(const ChunkKey& node) const;
  bool empty() const { return split_.empty(); }

  /// Splits a node and all of its ancestors. Returns false, without any change, if canSplit() is false.
  bool split(ChunkKey node);
  /// Undoes the splits of a node and of all of its descendants.
  void merge(const ChunkKey& node);

  /// Returns the drawn chunks, sorted by virtual node, then recursively in the order of childOf().
  std::vector<ChunkKey> leaves() const;
  /// Returns the split nodes, sorted from coarse to fine, then by position.
  std::vector<ChunkKey> splitNodes() const;

  friend bool operator==(const Octree& a, const Octree& b) { return a.top_ == b.top_ && a.split_ == b.split_; }

 private:
  int top_;
  int32_t finest_cell_;  ///< edge of a level-0 cell in units
  /// range of the coordinates of virtual nodes inside the world, the same on every axis
  int32_t first_virtual_ = 0, last_virtual_ = -1;
  ChunkSet split_;
};

/// A violation of a rule next to a split node. It is repaired by splitting `needed`; around an edge, also by splitting
/// `or_else` or by merging `across`. For a violation across a face, all three members are the same node.
struct BrokenRule {
  ChunkKey needed, or_else, across;
};

/// Appends to `broken` the violations of the octree's rules next to a split node.
void findBrokenRules(const Octree& tree, const ChunkKey& node, std::vector<BrokenRule>& broken);

/// Splits further nodes until both rules hold. If a node at the end of the world cannot be split, merges the finer node
/// beside it instead.
void refineToRules(Octree& tree);

/// Returns the faces of a drawn chunk where a seam is drawn, because they border a coarser chunk or a virtual node: bit
/// (1 << Face).
uint8_t coarserFaces(const Octree& tree, const ChunkKey& leaf);

/// Returns the blocks around a drawn chunk that belong to coarser chunks or virtual nodes.
Neighbourhood coarserBlocks(const Octree& tree, const ChunkKey& leaf);

}  // namespace sgm
