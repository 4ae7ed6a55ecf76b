#include "mesh/joined_loops.h"

#include <algorithm>
#include <utility>

#include "mesh/loop_triangles.h"

namespace sgm {

bool CellLoop::canTriangulate() const {
  const auto n = static_cast<size_t>(count);
  std::array<std::array<bool, kLongestBodyLoop>, kLongestBodyLoop> can{};
  for (size_t i = 0; i + 1 < n; ++i) can[i][i + 1] = true;
  for (size_t span = 2; span < n; ++span) {
    for (size_t i = 0; i + span < n; ++i) {
      const size_t j = i + span;
      if (span != n - 1 && (points[i].faces & points[j].faces) != 0) continue;
      for (size_t k = i + 1; k < j; ++k) can[i][j] = can[i][j] || (can[i][k] && can[k][j]);
    }
  }
  return can[0][n - 1];
}

std::span<const uint32_t> CellLoop::triangulated(Triangles& triangles) const {
  return {triangles.data(), triangulateAnyLoop<kLongestBodyLoop>(points.data(), count, triangles.data())};
}

FaceName JoinedLoops::faceOf(const SurfaceLoop& loop, uint32_t a, uint32_t b) const {
  FaceName name{loop.cell, sharedFace(body_.part().keys[a], body_.part().keys[b])};
  // A face is identified by its axis and by the cell on its high side. If the face is the low face of this cell, that
  // is this cell, otherwise the next cell along the axis.
  if (body_.part().keys[a].corner[name.axis] != body_.cornerOf(loop.cell)[name.axis]) ++name.cell[name.axis];
  return name;
}

uint32_t JoinedLoops::numberOf(const FaceName& name) const {
  const auto at = std::lower_bound(faces_.begin(), faces_.end(), name,
                                   [](const AmbiguousFace& face, const FaceName& n) { return face.name < n; });
  return at != faces_.end() && at->name == name ? static_cast<uint32_t>(at - faces_.begin()) : kNone;
}

bool JoinedLoops::isJoined(const FaceName& name) const {
  const uint32_t face = numberOf(name);
  return face != kNone && faces_[face].is_joined;
}
bool JoinedLoops::isJoinedAt(const Int3& cell) const {
  const std::array<FaceName, 6> names = FaceName::of(cell);
  return std::any_of(names.begin(), names.end(), [this](const FaceName& name) { return isJoined(name); });
}

/// Returns the sides (segments between consecutive vertices) of a cell's loops. Two sides lie in each joined face;
/// these two sides exchange their second ends.
JoinedLoops::CellSides JoinedLoops::sidesOf(const Int3& cell) const {
  CellSides of_cell;
  visitSides(cell, [&](const SurfaceLoop& loop, uint32_t a, uint32_t b) {
    const uint32_t face = numberOf(faceOf(loop, a, b));
    of_cell.all[of_cell.count++] = {a, b, face != kNone && faces_[face].is_joined ? face : kNone};
  });
  for (Side& side : of_cell.sides()) {
    for (Side& other : of_cell.sides()) {
      if (&other <= &side || side.face == kNone || other.face != side.face) continue;
      std::swap(side.to, other.to);
    }
  }
  return of_cell;
}

CellLoops JoinedLoops::loopsOf(const Int3& cell) const {
  const Int3 corner = body_.cornerOf(cell);
  std::array<uint32_t, kCubeEdges> vertex, next;
  next.fill(kNone);
  CellSides of_sides = sidesOf(cell);
  for (const Side& side : of_sides.sides()) {
    const uint32_t from = cubeEdge(body_.part().keys[side.from], corner);
    vertex[from] = side.from;
    next[from] = cubeEdge(body_.part().keys[side.to], corner);
  }
  CellLoops of_cell;
  for (uint32_t start = 0; start < kCubeEdges; ++start) {
    if (next[start] == kNone) continue;
    CellLoop& loop = of_cell.all[of_cell.count++];
    for (uint32_t edge = start; next[edge] != kNone;) {
      const Int3 at = placeOf(body_.part(), vertex[edge]);
      loop.points[static_cast<size_t>(loop.count++)] = {at.x, at.y, at.z, kCubeEdgeFaces[edge], vertex[edge]};
      edge = std::exchange(next[edge], kNone);
    }
  }
  return of_cell;
}

}  // namespace sgm
