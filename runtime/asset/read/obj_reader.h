#pragma once
// Wavefront OBJ to triangles. The file is untrusted: all that it says is checked, and what it may ask for is capped.

#include <cstddef>
#include <span>

#include "asset/read/mesh_limits.h"
#include "asset/triangle_mesh.h"

namespace sgm::asset {

/// The file's faces with the names that `usemtl` gives, polygons cut into triangles; points are those of `v`, in their
/// order, whether a face uses them or not. Objects, groups and what `mtllib` names are left out. Notes tell of lines,
/// points and curves that are left out, of polygons that cross themselves, and of corners that name normals or texture
/// coordinates which the file does not have. Errors: bad_input, with the line in the message and beside it; limit.
Result<TriangleMesh> readObj(std::span<const std::byte> bytes, const MeshLimits& limits = {});

}  // namespace sgm::asset
