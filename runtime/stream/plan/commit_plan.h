#pragma once
// The next frame: as much of the wanted octree as can be drawn now, closed by its seams, and nothing half done.

#include <functional>
#include <vector>

#include "stream/plan/octree.h"

namespace sgm {

/// What is there to draw. Asked about chunks of the committed tree, of the target and of what lies between them;
/// answers must not change during one call.
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
  Octree tree;  ///< closed under the rules; every leaf's body and needed seams are ready
  /// Seams that kept something from being committed.
  std::vector<MissingSeams> missing;
};

/// The octree nearest to the target that can replace the committed one in one step. Wherever not everything is ready
/// the committed chunks stay, or a coarser chunk that is ready stands in for finer ones that are not.
/// Preconditions: both trees keep the rules and have the same top; the committed tree's leaves and seams are ready.
CommitPlan planCommit(const Octree& committed, const Octree& target, const Readiness& ready);

}  // namespace sgm
