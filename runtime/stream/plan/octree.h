#pragma once
// The octree of drawn chunks. It keeps two rules under which seams close the surface.
//
// Nodes have chunk keys. A node of level l is split if finer chunks are drawn instead of it. The coarsest meshes have
// level `top`. One level above are the VIRTUAL nodes, which fill the whole world and have no mesh; their field is the
// domain's own state, the same everywhere. An unsplit virtual node is an outer neighbour of the drawn chunks: a seam
// towards it closes their outer faces in the same way as a seam between two levels.
//
// The rules (mesh/seam.h): the levels of chunks that share a face differ by at most one, and around an edge of a
// level's grid split and unsplit nodes never alternate crosswise.

#include <vector>

#include "mesh/fans.h"
#include "stream/plan/chunk_set.h"

namespace sgm {

/// Has value semantics: copies are independent.
class Octree {
 public:
  /// top: coarsest level with meshes, 0..kMaxLevel. finest_cell: edge of a level-0 cell in units; only virtual nodes
  /// that lie wholly inside the world can be split.
  Octree(int top, int32_t finest_cell);

  int top() const { return top_; }
  bool isSplit(const ChunkKey& node) const { return split_.contains(node); }
  /// True if this chunk is drawn.
  bool isLeaf(const ChunkKey& node) const { return node.level <= top_ && isSplit(parentOf(node)) && !isSplit(node); }
  /// Returns the chunk that is drawn at a place (in units); the chunk of the top level there if its virtual node is not
  /// split.
  ChunkKey leafAt(Int3 place) const;
  /// True if split() would split the node: it has a virtual node inside the world.
  bool canSplit(const ChunkKey& node) const;
  bool empty() const { return split_.empty(); }

  /// Splits a node and all its ancestors. If canSplit() is false, returns false and changes nothing.
  bool split(ChunkKey node);
  /// Removes the split of a node and of all its descendants.
  void merge(const ChunkKey& node);

  /// Returns the drawn chunks, sorted by virtual node, then in the order of childOf().
  std::vector<ChunkKey> leaves() const;
  /// Returns the split nodes, coarsest first, then by position.
  std::vector<ChunkKey> splitNodes() const;

  friend bool operator==(const Octree& a, const Octree& b) { return a.top_ == b.top_ && a.split_ == b.split_; }

 private:
  int top_;
  int32_t finest_cell_;  ///< edge of a level-0 cell in units
  /// range of coordinates, on every axis, of the virtual nodes inside the world
  int32_t first_virtual_ = 0, last_virtual_ = -1;
  ChunkSet split_;
};

/// A violation of a rule next to a split node. Splitting `needed` repairs it. Around an edge, it is also repaired by
/// splitting `or_else` or by merging `across`; for two faces, all three are the same node.
struct BrokenRule {
  ChunkKey needed, or_else, across;
};

/// Appends the violations of rules next to a split node.
void findBrokenRules(const Octree& tree, const ChunkKey& node, std::vector<BrokenRule>& broken);

/// Splits further nodes until both rules hold. Where the end of the world prevents a split, merges the finer side.
void refineToRules(Octree& tree);

/// Returns the faces of a drawn chunk that border a coarser chunk or a virtual node, where a seam is drawn: bit (1 <<
/// Face).
uint8_t coarserFaces(const Octree& tree, const ChunkKey& leaf);

/// Returns the blocks around a drawn chunk that belong to coarser chunks or virtual nodes.
Neighbourhood coarserBlocks(const Octree& tree, const ChunkKey& leaf);

}  // namespace sgm
