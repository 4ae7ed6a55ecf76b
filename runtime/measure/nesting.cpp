#include "measure/nesting.h"

#include <algorithm>
#include <vector>

#include "measure/column.h"
#include "measure/exact_sign.h"

namespace sgm::measure {
namespace {

/// Whether the shell has an inside: only such ones make a place lie in a solid.
bool bounds(const Shell& shell) { return shell.closed() && shell.manifold; }

}  // namespace

std::optional<int> depthAt(const Triangles& mesh, const Bvh& tree, const Shells& parts, uint32_t all_but, Point at,
                           uint64_t most_steps) {
  // On the way up to where nothing is, each triangle that faces up leaves a solid.
  int depth = 0;
  const bool ended = tree.visitAbove(at, most_steps, [&](uint32_t triangle) {
    const uint32_t shell = parts.of_triangle[triangle];
    if (shell == all_but || shell == kNoShell || !bounds(parts.shells[shell])) return;
    const Triangle& corners = mesh.triangles[triangle];
    const std::array<Point, 3> t{mesh.points[corners[0]], mesh.points[corners[1]], mesh.points[corners[2]]};
    const int turn = turnOver(t, at.x, at.y);
    if (turn != 0 && turn * orientation(t[0], t[1], t[2], at) > 0) depth += turn;
  });
  return ended ? std::optional<int>(depth) : std::nullopt;
}

Nesting nestingOf(const Triangles& mesh, const Bvh& tree, const Shells& parts, uint64_t most_steps, JobSystem& jobs) {
  constexpr size_t kTogether = 16;
  const size_t shells = parts.shells.size(), blocks = (shells + kTogether - 1) / kTogether;
  const uint64_t share = shells > 0 ? most_steps / shells + 1 : 0;
  std::vector<Nesting> found(blocks);
  parallelFor(jobs, blocks, [&](size_t block) {
    Nesting& here = found[block];
    for (size_t s = block * kTogether; s < std::min(shells, (block + 1) * kTogether); ++s) {
      const Shell& shell = parts.shells[s];
      if (!bounds(shell)) continue;
      const Point at = mesh.points[mesh.triangles[shell.first][0]];
      const std::optional<int> depth = shells > 1 ? depthAt(mesh, tree, parts, static_cast<uint32_t>(s), at, share) : 0;
      if (!depth) {
        ++here.not_judged;
      } else if (shell.volume < 0 && *depth > 0) {
        ++here.cavities;
      } else if (shell.volume < 0) {
        ++here.inside_out;
        here.first_inside_out.push_back(static_cast<uint32_t>(s));
      } else if (*depth > 0) {
        ++here.nested;
        here.first_nested.push_back(static_cast<uint32_t>(s));
      }
    }
  });
  Nesting all;
  for (const Nesting& block : found) {
    all.cavities += block.cavities;
    all.inside_out += block.inside_out;
    all.nested += block.nested;
    all.not_judged += block.not_judged;
    for (const auto list : {&Nesting::first_inside_out, &Nesting::first_nested}) {
      for (const uint32_t shell : block.*list)
        if ((all.*list).size() < kMostExamples) (all.*list).push_back(shell);
    }
  }
  return all;
}

}  // namespace sgm::measure
