#pragma once
// Checks whether the surface of a meshed region is watertight, and counts its handles.

#include <cstdint>
#include <optional>
#include <string>

#include "mesh/weld.h"

namespace sgm {

struct Topology {
  /// True if the surface is a manifold, and each open edge lies in the outer border of the region, where the solid is
  /// cut. Such a surface is closed together with the cut faces. Also true for a region without surface.
  bool watertight = false;
  std::string leak;  ///< description of the problem, if the surface is not watertight; otherwise empty
  /// The number of handles of a closed surface, summed over its shells: 0 for a ball, 1 for a torus, 2 for two tori.
  /// nullopt if the surface is not closed: then the number depends on the part beyond the region's border. In this case
  /// `why` contains the reason.
  std::optional<uint64_t> genus;
  std::string why;
};

/// Checks the mesh of one level. extent: the box whose chunks were meshed, hi included.
Topology topologyOf(const WorldMesh& mesh, const IntBox& extent);

}  // namespace sgm
