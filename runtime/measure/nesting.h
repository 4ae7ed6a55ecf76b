#pragma once
// Checks whether closed shells (connected parts of a surface) face the right way: outward in the void, inward in a
// solid.

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
  /// indices of the first shells that are inside out, and of the first nested ones; at most kMaxExamples each
  std::vector<uint32_t> first_inside_out, first_nested;
  /// number of shells that were not classified, because a search for the shells around them would have visited too many
  /// nodes of the tree
  uint64_t not_judged = 0;
};

/// Returns the sum of the winding numbers that all closed, manifold shells except the shell `all_but` have around the
/// point `at`: 0 outside of them, 1 inside one. Exact. tree: of the mesh's triangles. nullopt if the search would visit
/// more than `max_steps` nodes.
std::optional<int> depthAt(const Triangles& mesh, const Bvh& tree, const Shells& parts, uint32_t all_but, Point at,
                           uint64_t max_steps);

/// Classifies each shell by its first corner. is_cut: the mesh was cut from a larger one, so a shell may also lie in a
/// solid that continues beyond the cut. To decide this, the nearest open shell along an axis from the middle of the
/// shell's first triangle is found: its orientation shows whether the triangle lies in the solid. If no axis leads to
/// an open shell, a shell that faces inward is assumed to lie in a solid that continues beyond the cut, so it counts as
/// a cavity. Exception: if the mesh has no open shell at all and some closed shell faces outward, void surrounds all
/// shells, and nothing is assumed. Only manifold shells are considered. max_steps: number of nodes of the tree that may
/// be visited, divided evenly among the shells. The result is the same for any number of threads.
Nesting nestingOf(const Triangles& mesh, const Bvh& tree, const Shells& parts, bool is_cut, uint64_t max_steps,
                  JobSystem& jobs);

}  // namespace sgm::measure
