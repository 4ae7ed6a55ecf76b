#include "measure/nesting.h"

#include <algorithm>
#include <atomic>

#include "measure/column.h"
#include "measure/exact_sign.h"

namespace sgm::measure {

int depthAt(const Triangles& mesh, const Bvh& tree, const Shells& parts, uint32_t all_but, Point at) {
  // On the way up to where nothing is, each triangle that faces up leaves a solid.
  int depth = 0;
  tree.visitAbove(at, [&](uint32_t triangle) {
    if (parts.of_triangle[triangle] == all_but) return;
    const Triangle& corners = mesh.triangles[triangle];
    const std::array<Point, 3> t{mesh.points[corners[0]], mesh.points[corners[1]], mesh.points[corners[2]]};
    const int turn = turnOver(t, at.x, at.y);
    if (turn != 0 && turn * orientation(t[0], t[1], t[2], at) > 0) depth += turn;
  });
  return depth;
}

Nesting nestingOf(const Triangles& mesh, const Bvh& tree, const Shells& parts, JobSystem& jobs) {
  if (parts.shells.size() == 1) return {0, parts.shells[0].closed() && parts.shells[0].volume < 0 ? 1u : 0u, 0};
  constexpr size_t kTogether = 16;
  std::atomic<uint64_t> cavities = 0, inside_out = 0, nested = 0;
  parallelFor(jobs, (parts.shells.size() + kTogether - 1) / kTogether, [&](size_t block) {
    for (size_t s = block * kTogether; s < std::min(parts.shells.size(), (block + 1) * kTogether); ++s) {
      const Shell& shell = parts.shells[s];
      if (!shell.closed()) continue;
      const Point at = mesh.points[mesh.triangles[shell.first][0]];
      const bool inward = shell.volume < 0;
      const bool within = depthAt(mesh, tree, parts, static_cast<uint32_t>(s), at) > 0;
      if (inward) ++(within ? cavities : inside_out);
      if (!inward && within) ++nested;
    }
  });
  return {cavities, inside_out, nested};
}

}  // namespace sgm::measure
