#pragma once
// The next frame: as much of the wanted octree as can be drawn now, closed by its seams, with no partial change.

#include <functional>
#include <vector>

#include "stream/plan/octree.h"

namespace sgm {

/// Tells what can be drawn. Called for chunks of the committed tree, of the target, and between them; answers must not
/// change during one call of planCommit.
struct Readiness {
  std::function<bool(const ChunkKey&)> body;
  /// The seams of a ready chunk that can be drawn, bit (1 << Face).
  std::function<uint8_t(const ChunkKey&)> seams;
};

struct MissingSeams {
  ChunkKey chunk;
  uint8_t faces = 0;
};

struct CommitPlan {
  Octree tree;  ///< satisfies the rules; the body and needed seams of every leaf are ready
  /// Seams whose absence prevented a commit.
  std::vector<MissingSeams> missing;
};

/// Returns the octree nearest to the target that can replace the committed one in one step. Where something is not
/// ready, the committed chunks stay, or a ready coarser chunk stands in for finer ones. Preconditions: both trees
/// satisfy the rules and have the same top; the committed tree's leaves and seams are ready.
CommitPlan planCommit(const Octree& committed, const Octree& target, const Readiness& ready);

}  // namespace sgm
