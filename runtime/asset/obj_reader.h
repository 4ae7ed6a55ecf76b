#pragma once
// Wavefront OBJ to triangles. The file is untrusted: all that it says is checked, and what it may ask for is capped.

#include <cstddef>
#include <span>

#include "asset/mesh_limits.h"
#include "asset/triangle_mesh.h"

namespace sgm::asset {

/// The file's faces, polygons as fans, with the names that `usemtl` gives; points are those of `v`, in their order,
/// whether a face uses them or not. Objects, groups, lines, points, curves and what `mtllib` names are left out.
/// Errors: bad_input, with the line in the message and beside it; limit.
Result<TriangleMesh> readObj(std::span<const std::byte> bytes, const MeshLimits& limits = {});

}  // namespace sgm::asset
