#pragma once
// Converts a region of a world to triangles for measuring.

#include "asset/triangle_mesh.h"
#include "mesh/weld.h"

namespace sgm::measure {

inline asset::Point pointOf(const std::array<double, 3>& p) { return {p[0], p[1], p[2]}; }

/// Metres from the mesh's origin, exact; points and triangles in the mesh's order. Without materials.
asset::TriangleMesh trianglesOf(const WorldMesh& mesh);

}  // namespace sgm::measure
