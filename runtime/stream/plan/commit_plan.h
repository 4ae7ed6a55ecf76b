#pragma once
// Plans the next frame: applies those changes towards the target octree whose chunks and seams are all ready to be
// drawn.

#include <functional>
#include <vector>

#include "stream/plan/octree.h"

namespace sgm {

/// Tells which chunks can be drawn. The functions are called for nodes of the committed tree and of the target tree,
/// and for nodes on the levels between the two trees. Their results must not change during a call of planCommit.
struct Readiness {
  std::function<bool(const ChunkKey&)> body;
  /// Returns the seams of a chunk that are ready to be drawn: bit (1 << Face).
  std::function<uint8_t(const ChunkKey&)> seams;
};

struct MissingSeams {
  ChunkKey chunk;
  uint8_t faces = 0;
};

struct CommitPlan {
  Octree tree;  ///< the next octree: it satisfies the octree's rules, and the bodies and seams of all leaves are ready
  /// seams that prevented a change because they are not ready
  std::vector<MissingSeams> missing;
};

/// Returns the octree nearest to the target that can replace the committed octree in one step. Where the target is not
/// ready, the committed chunks stay, or a ready coarser chunk is drawn in place of finer ones. Preconditions: both
/// trees satisfy the rules and have the same top level; the leaves and seams of the committed tree are ready.
CommitPlan planCommit(const Octree& committed, const Octree& target, const Readiness& ready);

}  // namespace sgm
