#pragma once
// Finds triangles of a mesh that intersect.

#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

#include "base/jobs.h"
#include "measure/bvh.h"
#include "measure/shells.h"

namespace sgm::measure {

inline constexpr uint64_t kStepsAPair = 16;

struct SelfIntersections {
  uint64_t pairs = 0;   ///< of triangles that meetWrongly(); a lower bound if not complete
  uint64_t folded = 0;  ///< pairs among these that overlap at an edge
  /// False if so many triangles lie close together that the steps did not suffice.
  bool complete = true;
  /// The lower triangle first; at most kMostExamples of pairs that fold, and of pairs that cut.
  std::vector<std::pair<uint32_t, uint32_t>> folded_examples, examples;

  uint64_t cuts() const { return pairs - folded; }
};

/// Receives the progress of some work. Calls come from any thread, never concurrently, with ascending `done`.
using MeasureProgress = std::function<void(uint64_t done, uint64_t total)>;

/// Exact (triangle_pair.h). tree: of the same triangles. most_steps: visits of two nodes of it or tests of two
/// triangles; a pair that intersects counts kStepsAPair, since the exact number of a large heap of them is of no
/// interest. The same for any number of threads.
SelfIntersections selfIntersections(const Triangles& mesh, const Bvh& tree, uint64_t most_steps, JobSystem& jobs,
                                    const MeasureProgress& progress = {});

}  // namespace sgm::measure
