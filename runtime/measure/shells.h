#pragma once
// The connected parts of a mesh, and the shape of each.

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "measure/edges.h"

namespace sgm::measure {

/// A shell: triangles that are connected across edges.
struct Shell {
  uint64_t triangles = 0;
  uint64_t edges = 0;
  uint64_t vertices = 0;      ///< number of vertices; a vertex counts once for each of its fans in this shell
  uint64_t border_edges = 0;  ///< number of edges that belong to only one triangle
  uint64_t borders = 0;       ///< number of closed loops that the border edges form
  uint32_t first = 0;         ///< lowest triangle number of the shell
  /// True if every edge has one triangle, or two that use it in opposite directions, and if no two fans share a vertex,
  /// not even two fans of different shells.
  bool manifold = true;
  double area = 0;
  double volume = 0;  ///< volume as in AreaVolume, about the mesh's centre; meaningful only for closed shells

  bool closed() const { return border_edges == 0; }
  /// The Euler characteristic: vertices - edges + triangles.
  int64_t euler() const {
    return static_cast<int64_t>(vertices) - static_cast<int64_t>(edges) + static_cast<int64_t>(triangles);
  }
  /// The number of handles: 0 for a ball or a disk, 1 for a torus. nullopt if the shell is not manifold.
  std::optional<uint64_t> genus() const;
};

struct Shells {
  std::vector<Shell> shells;  ///< sorted by descending number of triangles; among equals, by Shell::first
  /// "Independent objects", section 7.3 of the paper: groups of triangles connected through vertices. Two cubes that
  /// touch at a corner are one object and two shells.
  uint64_t objects = 0;
  /// Non-manifold vertices, each with one of its triangles: at most kMaxExamples.
  std::vector<std::pair<uint32_t, uint32_t>> pinched;
  /// index into shells of each triangle; kNoShell if the triangle has a repeated corner
  LargeVector<uint32_t> of_triangle;
};

inline constexpr uint32_t kNoShell = 0xFFFFFFFFu;

/// The maximum number of examples that are listed for a defect. More would not help a reader.
inline constexpr size_t kMaxExamples = 16;

/// Finds the shells of a mesh. edges: the edges of the same triangles. centre: see Shell::volume. A triangle with a
/// repeated corner belongs to no shell; but shells that it touches count as connected, so they are one object
/// (Shells::objects).
Shells shellsOf(const Triangles& mesh, const Edges& edges, Point centre);

}  // namespace sgm::measure
