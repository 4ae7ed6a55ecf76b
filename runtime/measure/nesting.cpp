#include "measure/nesting.h"

#include <algorithm>
#include <limits>
#include <vector>

#include "measure/column.h"
#include "measure/exact_sign.h"

namespace sgm::measure {
namespace {

/// True if the shell has an inside: only such shells can surround a point with solid.
bool bounds(const Shell& shell) { return shell.closed() && shell.manifold; }
/// True if the shell is open and manifold. A cut through a larger mesh may have opened it; within the cutting box, the
/// shell still separates solid from void.
bool boundsUpToCut(const Shell& shell) { return !shell.closed() && shell.manifold; }

/// Returns the z at which a triangle crosses the vertical line through a point.
double heightAt(const std::array<Point, 3>& t, Point at) {
  const Point normal = crossOf(t[0], t[1], t[2]);
  const auto [low, high] = std::minmax({t[0].z, t[1].z, t[2].z});
  const double height = t[0].z - (normal.x * (at.x - t[0].x) + normal.y * (at.y - t[0].y)) / normal.z;
  return height >= low ? std::min(height, high) : low;
}

/// On which side of the nearest open shell a point lies: not known, in the solid, or in the void (in_open).
enum class BesideCut : uint8_t { unknown, in_solid, in_open };

/// Permutes coordinates cyclically so that `axis` becomes z. The orientation of triangles does not change.
Point turned(Point p, int axis) { return {p[(axis + 1) % 3], p[(axis + 2) % 3], p[axis]}; }

constexpr int kColumns = 6;

/// Finds the nearest open shell above a point, and returns on which side of this shell the point lies. If no open shell
/// lies above, or the line only touches it, searches below the point, then along the other axes. nullopt if one of
/// these searches would visit more than max_steps nodes of the tree.
std::optional<BesideCut> besideCut(const Triangles& mesh, const Bvh& tree, const Shells& parts, Point at,
                                   uint64_t max_steps) {
  for (int number = 0; number < kColumns; ++number) {
    const Bvh::Column column{(2 + number / 2) % 3, number % 2 == 0};
    const int away = column.above ? 1 : -1;
    const Point place = turned(at, column.axis);
    double nearest = std::numeric_limits<double>::infinity();
    // At the crossing nearest to the point: the number of triangles that face away from the point, minus the number
    // that face towards it.
    int facing = 0;
    const bool ended = tree.visitColumn(at, column, max_steps, [&](uint32_t triangle) {
      const uint32_t shell = parts.of_triangle[triangle];
      if (shell == kNoShell || !boundsUpToCut(parts.shells[shell])) return;
      std::array<Point, 3> t;
      for (size_t k = 0; k < 3; ++k) t[k] = turned(mesh.points[mesh.triangles[triangle][k]], column.axis);
      const int turn = turnOver(t, place.x, place.y);
      if (turn == 0 || turn * orientation(t[0], t[1], t[2], place) * away <= 0) return;
      const double height = heightAt(t, place) * away;
      if (height > nearest) return;
      facing = (height < nearest ? 0 : facing) + turn * away;
      nearest = height;
    });
    if (!ended) return std::nullopt;
    if (facing != 0) return facing > 0 ? BesideCut::in_solid : BesideCut::in_open;
  }
  return BesideCut::unknown;
}

}  // namespace

std::optional<int> depthAt(const Triangles& mesh, const Bvh& tree, const Shells& parts, uint32_t all_but, Point at,
                           uint64_t max_steps) {
  // The depth is 0 far above the mesh. So, from the top down to the point, each triangle that faces up enters a solid,
  // and each triangle that faces down leaves one.
  int depth = 0;
  const bool ended = tree.visitColumn(at, {}, max_steps, [&](uint32_t triangle) {
    const uint32_t shell = parts.of_triangle[triangle];
    if (shell == all_but || shell == kNoShell || !bounds(parts.shells[shell])) return;
    const Triangle& corners = mesh.triangles[triangle];
    const std::array<Point, 3> t{mesh.points[corners[0]], mesh.points[corners[1]], mesh.points[corners[2]]};
    const int turn = turnOver(t, at.x, at.y);
    if (turn != 0 && turn * orientation(t[0], t[1], t[2], at) > 0) depth += turn;
  });
  return ended ? std::optional<int>(depth) : std::nullopt;
}

Nesting nestingOf(const Triangles& mesh, const Bvh& tree, const Shells& parts, bool is_cut, uint64_t max_steps,
                  JobSystem& jobs) {
  constexpr size_t kTogether = 16;
  const size_t shells = parts.shells.size(), blocks = (shells + kTogether - 1) / kTogether;
  const uint64_t share = shells > 0 ? max_steps / shells / (is_cut ? 1 + kColumns : 1) + 1 : 0;
  // True if the space around all shells is known to be void. This is the case if two conditions hold: no shell is open,
  // so that one common space surrounds all shells; and one shell faces outward, so that this space is void.
  const bool is_open = std::any_of(parts.shells.begin(), parts.shells.end(),
                                   [](const Shell& shell) { return bounds(shell) && shell.volume > 0; }) &&
                       std::none_of(parts.shells.begin(), parts.shells.end(), boundsUpToCut);
  std::vector<Nesting> found(blocks);
  parallelFor(jobs, blocks, [&](size_t block) {
    Nesting& here = found[block];
    for (size_t s = block * kTogether; s < std::min(shells, (block + 1) * kTogether); ++s) {
      const Shell& shell = parts.shells[s];
      if (!bounds(shell)) continue;
      const Point at = mesh.points[mesh.triangles[shell.first][0]];
      std::optional<int> depth = shells > 1 ? depthAt(mesh, tree, parts, static_cast<uint32_t>(s), at, share) : 0;
      if (is_cut && depth) {
        // The search starts at the middle of a triangle. Its first corner would be unsuitable: in meshes on a grid,
        // corners often lie exactly above other corners.
        const Triangle& corners = mesh.triangles[shell.first];
        const Point middle = (1.0 / 3) * (mesh.points[corners[0]] + mesh.points[corners[1]] + mesh.points[corners[2]]);
        const std::optional<BesideCut> beside = besideCut(mesh, tree, parts, middle, share);
        const bool in_solid =
            beside == BesideCut::in_solid || (beside == BesideCut::unknown && shell.volume < 0 && !is_open);
        depth = beside ? std::optional<int>(*depth + (in_solid ? 1 : 0)) : std::nullopt;
      }
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
        if ((all.*list).size() < kMaxExamples) (all.*list).push_back(shell);
    }
  }
  return all;
}

}  // namespace sgm::measure
