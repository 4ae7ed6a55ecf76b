#pragma once
// The connected parts of a mesh, and the shape of each.

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "measure/edges.h"

namespace sgm::measure {

/// Triangles that are connected across edges.
struct Shell {
  uint64_t triangles = 0;
  uint64_t edges = 0;
  uint64_t vertices = 0;      ///< one that several fans meet in counts once a fan, and once a shell
  uint64_t border_edges = 0;  ///< of one triangle
  uint64_t borders = 0;       ///< that these make: closed lines of them
  uint32_t first = 0;         ///< its lowest triangle
  /// Every edge has one triangle or two that go along it in opposite directions, and no fan meets another in a vertex,
  /// be it one of another shell.
  bool manifold = true;
  double area = 0;
  double volume = 0;  ///< as AreaVolume::volume about the mesh's centre: meant for closed shells alone

  bool closed() const { return border_edges == 0; }
  /// V - E + F.
  int64_t euler() const {
    return static_cast<int64_t>(vertices) - static_cast<int64_t>(edges) + static_cast<int64_t>(triangles);
  }
  /// Handles: 0 for a ball or a disk, 1 for a torus. Nothing where it is not manifold.
  std::optional<uint64_t> genus() const;
};

struct Shells {
  std::vector<Shell> shells;  ///< those with most triangles first; of equal ones that with the lowest
  /// "Independent objects", section 7.3 of the paper: groups of triangles connected through vertices. Two cubes that
  /// touch in a corner are one object and two shells.
  uint64_t objects = 0;
  /// Vertices where several fans meet, and a triangle at each: at most kMostExamples.
  std::vector<std::pair<uint32_t, uint32_t>> pinched;
  LargeVector<uint32_t> of_triangle;  ///< into shells; kNoShell of triangles with a corner twice
};

inline constexpr uint32_t kNoShell = 0xFFFFFFFFu;

/// Of what is wrong in a mesh, so many are named: a million would say no more.
inline constexpr size_t kMostExamples = 16;

/// edges: of these triangles. Triangles with a corner twice belong to no shell, and connect objects.
Shells shellsOf(const Triangles& mesh, const Edges& edges, Point centre);

}  // namespace sgm::measure
