#pragma once
// Which closed shells face the right way, by what they stand in.

#include <cstdint>
#include <optional>
#include <vector>

#include "base/jobs.h"
#include "measure/bvh.h"
#include "measure/shells.h"

namespace sgm::measure {

/// Of shells that are closed and manifold: the inside of other shells is not known.
struct Nesting {
  uint64_t cavities = 0;                                 ///< that face inward, in a solid
  uint64_t inside_out = 0;                               ///< that face inward, in the open
  uint64_t nested = 0;                                   ///< that face outward, in a solid: what they hold counts twice
  std::vector<uint32_t> first_inside_out, first_nested;  ///< shells: at most kMostExamples of each
  uint64_t not_judged = 0;                               ///< with so much above them that the steps did not suffice
};

/// How often the closed, manifold shells but one go round the point: 0 outside of them, 1 inside one. Exact. tree: of
/// the mesh's triangles. Nothing where that takes more than so many looks at its nodes.
std::optional<int> depthAt(const Triangles& mesh, const Bvh& tree, const Shells& parts, uint32_t all_but, Point at,
                           uint64_t most_steps);

/// Each shell is judged by its first corner. is_cut: the mesh was cut from a larger one. Then the nearest open shell
/// along an axis from the shell's first triangle tells whether that triangle lies in a solid that goes on beyond the
/// cut. If no open shell lies along an axis, a shell that faces inward is a cavity of such a solid; but if the mesh has
/// no open shell at all, and another shell faces outward, it is inside out. most_steps: nodes of the tree that are
/// visited, shared out evenly over the shells. The same for any number of threads.
Nesting nestingOf(const Triangles& mesh, const Bvh& tree, const Shells& parts, bool is_cut, uint64_t most_steps,
                  JobSystem& jobs);

}  // namespace sgm::measure
