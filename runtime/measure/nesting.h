#pragma once
// Checks the orientation of closed shells by what surrounds them.

#include <cstdint>
#include <optional>
#include <vector>

#include "base/jobs.h"
#include "measure/bvh.h"
#include "measure/shells.h"

namespace sgm::measure {

/// Of closed, manifold shells: the inside of other shells is undefined.
struct Nesting {
  uint64_t cavities = 0;    ///< shells that face inward and lie in a solid
  uint64_t inside_out = 0;  ///< shells that face inward and lie in no solid
  uint64_t nested = 0;      ///< shells that face outward and lie in a solid: their contents count twice
  std::vector<uint32_t> first_inside_out, first_nested;  ///< shells: at most kMostExamples of each
  uint64_t not_judged = 0;                               ///< steps did not suffice: too much lies above them
};

/// The winding number of the closed, manifold shells except `all_but` around the point: 0 outside of them, 1 inside
/// one. Exact. tree: of the mesh's triangles. nullopt if the search would visit more than `most_steps` nodes.
std::optional<int> depthAt(const Triangles& mesh, const Bvh& tree, const Shells& parts, uint32_t all_but, Point at,
                           uint64_t most_steps);

/// Each shell is classified by its first corner. is_cut: the mesh was cut from a larger one. Then the nearest open
/// shell along an axis from the shell's first triangle shows whether that triangle lies in a solid that continues
/// beyond the cut. If no open shell lies along an axis, a shell that faces inward is a cavity of such a solid; but if
/// the mesh has no open shell at all, and another shell faces outward, it is inside out. most_steps: visited nodes of
/// the tree, shared evenly by the shells. The same for any number of threads.
Nesting nestingOf(const Triangles& mesh, const Bvh& tree, const Shells& parts, bool is_cut, uint64_t most_steps,
                  JobSystem& jobs);

}  // namespace sgm::measure
