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
  uint64_t pairs = 0;   ///< number of pairs of triangles that fold or cut; a lower bound if not complete
  uint64_t folded = 0;  ///< number of these pairs that fold, that is, overlap at an edge
  /// False if the search stopped after its maximum number of steps, because too many triangles lie close together.
  bool complete = true;
  /// Examples, as pairs of triangle numbers, the lower number first. folded_examples: at most kMaxExamples pairs that
  /// fold; examples: at most kMaxExamples pairs that cut.
  std::vector<std::pair<uint32_t, uint32_t>> folded_examples, examples;

  uint64_t cuts() const { return pairs - folded; }
};

/// Receives progress notices. Calls come from any thread, never concurrently, with ascending `done`.
using MeasureProgress = std::function<void(uint64_t done, uint64_t total)>;

/// Finds all pairs of triangles that intersect. Exact (triangle_pair.h). tree: a tree of the same triangles. max_steps
/// limits the work. A visit of two nodes of the tree is one step, and so is a test of two triangles. A pair that
/// intersects counts as kStepsAPair steps, so that the search ends early in a large heap of intersecting triangles. The
/// result is the same for any number of threads.
SelfIntersections selfIntersections(const Triangles& mesh, const Bvh& tree, uint64_t max_steps, JobSystem& jobs,
                                    const MeasureProgress& progress = {});

}  // namespace sgm::measure
