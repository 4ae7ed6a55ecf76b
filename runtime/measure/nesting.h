#pragma once
// Checks the orientation of closed shells by the solids around them.

#include <cstdint>
#include <optional>
#include <vector>

#include "base/jobs.h"
#include "measure/bvh.h"
#include "measure/shells.h"

namespace sgm::measure {

/// Counts of closed, manifold shells. Other shells have no defined inside, and are not judged.
struct Nesting {
  uint64_t cavities = 0;    ///< shells that face inward and lie in a solid
  uint64_t inside_out = 0;  ///< shells that face inward and lie in no solid
  uint64_t nested = 0;      ///< shells that face outward and lie in a solid, so that the volume inside counts twice
  /// indices of the first such shells, at most kMaxExamples of each kind
  std::vector<uint32_t> first_inside_out, first_nested;
  /// shells that were not classified, because too many triangles lie above them
  uint64_t not_judged = 0;
};

/// Returns the winding number around the point of all closed, manifold shells except `all_but`: 0 outside of them, 1
/// inside one. Exact. tree: of the mesh's triangles. nullopt if the search would visit more than `max_steps` nodes.
std::optional<int> depthAt(const Triangles& mesh, const Bvh& tree, const Shells& parts, uint32_t all_but, Point at,
                           uint64_t max_steps);

/// Classifies each shell by its first corner. is_cut: the mesh was cut from a larger one. Then the nearest open shell
/// along an axis from the shell's first triangle shows whether that triangle lies in a solid that continues beyond the
/// cut. If no open shell lies along an axis, a shell that faces inward is a cavity of such a solid; but if the mesh has
/// no open shell at all, and another shell faces outward, it is inside out. max_steps: number of nodes of the tree
/// that may be visited, divided evenly among the shells. The result is the same for any number of threads.
Nesting nestingOf(const Triangles& mesh, const Bvh& tree, const Shells& parts, bool is_cut, uint64_t max_steps,
                  JobSystem& jobs);

}  // namespace sgm::measure
