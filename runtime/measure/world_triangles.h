#pragma once
// Converts a region of a world to triangles for measuring.

#include "asset/triangle_mesh.h"
#include "mesh/weld.h"

namespace sgm::measure {

inline asset::Point pointOf(const std::array<double, 3>& p) { return {p[0], p[1], p[2]}; }

/// Converts positions to metres from the mesh's origin, exactly; points and triangles keep their order. Drops
/// materials.
asset::TriangleMesh trianglesOf(const WorldMesh& mesh);

}  // namespace sgm::measure
