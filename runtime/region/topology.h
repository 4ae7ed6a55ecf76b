#pragma once
// Is the surface of a meshed region watertight, and how many handles has it?

#include <cstdint>
#include <optional>
#include <string>

#include "mesh/weld.h"

namespace sgm {

struct Topology {
  /// A manifold, each of whose open edges lies in the outer border of the region, where the solid is cut: so the
  /// surface and the cut faces together close. True of a region without surface.
  bool watertight = false;
  std::string leak;  ///< what is wrong where it is not watertight
  /// Handles of a closed surface, summed over its shells: 0 for a ball, 1 for a torus, 2 for two of them. Nothing where
  /// the surface is not closed, since what lies beyond the border decides; `why` says so.
  std::optional<uint64_t> genus;
  std::string why;
};

/// mesh: of one level. extent: the box whose chunks were meshed, hi included.
Topology topologyOf(const WorldMesh& mesh, const IntBox& extent);

}  // namespace sgm
