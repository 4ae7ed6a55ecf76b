#pragma once
// Plans the next frame: the part of the target octree that can be drawn now, with all seams, and with no change carried
// out partially.

#include <functional>
#include <vector>

#include "stream/plan/octree.h"

namespace sgm {

/// Says what can be drawn. The functions are called for nodes of the committed tree, of the target, and between them;
/// their results must not change during one call of planCommit.
struct Readiness {
  std::function<bool(const ChunkKey&)> body;
  /// Returns the seams of a ready chunk that can be drawn: bit (1 << Face).
  std::function<uint8_t(const ChunkKey&)> seams;
};

struct MissingSeams {
  ChunkKey chunk;
  uint8_t faces = 0;
};

struct CommitPlan {
  Octree tree;  ///< satisfies the octree's rules; the body and the needed seams of every leaf are ready
  /// Seams that would have allowed a change if they had been ready.
  std::vector<MissingSeams> missing;
};

/// Returns the octree nearest to the target that can replace the committed one in one step. Where the target is not
/// ready, the committed chunks stay, or a ready coarser chunk stands in for finer ones. Preconditions: both trees
/// satisfy the rules and have the same top level; the leaves and seams of the committed tree are ready.
CommitPlan planCommit(const Octree& committed, const Octree& target, const Readiness& ready);

}  // namespace sgm
