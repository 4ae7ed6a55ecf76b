#pragma once
// Reads triangles from Wavefront OBJ. The file is untrusted: all values in it are checked, and memory and time are
// limited.

#include <cstddef>
#include <span>

#include "asset/read/mesh_limits.h"
#include "asset/triangle_mesh.h"

namespace sgm::asset {

/// Returns the file's faces, cut into triangles, with the material names of `usemtl` lines. The points are those of the
/// `v` lines, in their order, even if no face uses them. Objects, groups and `mtllib` files are ignored. Notes report
/// lines, points and curves that are left out, self-intersecting polygons, and corners that refer to missing normals or
/// texture coordinates. Errors: bad_input, with the line in the message and in Error::line; limit.
Result<TriangleMesh> readObj(std::span<const std::byte> bytes, const MeshLimits& limits = {});

}  // namespace sgm::asset
