#pragma once
// Checks whether the surface of a meshed region is watertight, and counts its handles.

#include <cstdint>
#include <optional>
#include <string>

#include "mesh/weld.h"

namespace sgm {

struct Topology {
  /// The surface is a manifold, and each open edge lies in the outer border of the region, where the solid is cut: so
  /// surface and cut faces together are closed. True for a region without surface.
  bool watertight = false;
  std::string leak;  ///< the problem if it is not watertight
  /// Handles of a closed surface, summed over its shells: 0 for a ball, 1 for a torus, 2 for two of them. nullopt if
  /// the surface is not closed, since the part beyond the border decides; `why` says so.
  std::optional<uint64_t> genus;
  std::string why;
};

/// mesh: of one level. extent: the box whose chunks were meshed, hi included.
Topology topologyOf(const WorldMesh& mesh, const IntBox& extent);

}  // namespace sgm
