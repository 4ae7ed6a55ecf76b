#pragma once
// Which closed shells face the right way, by what they stand in.

#include <cstdint>

#include "base/jobs.h"
#include "measure/bvh.h"
#include "measure/shells.h"

namespace sgm::measure {

struct Nesting {
  uint64_t cavities = 0;    ///< closed shells that face inward, in a solid
  uint64_t inside_out = 0;  ///< closed shells that face inward, in the open
  uint64_t nested = 0;      ///< closed shells that face outward, in a solid: what they hold counts twice
};

/// How often the triangles of the other shells go round the point: 0 outside of them, 1 inside one. Exact; of open
/// shells it says little. tree: of the mesh's triangles.
int depthAt(const Triangles& mesh, const Bvh& tree, const Shells& parts, uint32_t all_but, Point at);

/// Each shell is judged by its first corner.
Nesting nestingOf(const Triangles& mesh, const Bvh& tree, const Shells& parts, JobSystem& jobs);

}  // namespace sgm::measure
