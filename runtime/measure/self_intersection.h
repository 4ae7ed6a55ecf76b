#pragma once
// Triangles of a mesh that meet each other where they should not.

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
  uint64_t pairs = 0;   ///< of triangles that meetWrongly(); at least so many where not all were looked at
  uint64_t folded = 0;  ///< of these: those that lie upon each other at an edge
  /// Not where so many triangles lie close to each other that the steps did not suffice.
  bool complete = true;
  /// The lower triangle first; at most kMostExamples of those that fold, and of those that cut.
  std::vector<std::pair<uint32_t, uint32_t>> folded_examples, examples;

  uint64_t cuts() const { return pairs - folded; }
};

/// Receives how far some work is. One call at a time, from any thread, with `done` rising.
using MeasureProgress = std::function<void(uint64_t done, uint64_t total)>;

/// Exact (triangle_pair.h). tree: of the same triangles. most_steps: looks at two nodes of it or at two triangles; of
/// triangles that meet, kStepsAPair: of a heap of them nobody needs to know how many exactly. The same for any number
/// of threads.
SelfIntersections selfIntersections(const Triangles& mesh, const Bvh& tree, uint64_t most_steps, JobSystem& jobs,
                                    const MeasureProgress& progress = {});

}  // namespace sgm::measure
