#pragma once
// PLY to triangles: text, and binary of either byte order. The file is untrusted: all that it says is checked, and what
// it may ask for is capped.

#include <cstddef>
#include <span>

#include "asset/read/mesh_limits.h"
#include "asset/triangle_mesh.h"

namespace sgm::asset {

/// The file's faces, polygons cut into triangles, its strips of triangles (`tristrips`), and of its vertices x y z,
/// where there are all of them nx ny nz, and u v, s t or texture_u texture_v. Other elements and properties are passed
/// over. Notes tell of faces of fewer than three corners, of polygons that cross themselves, of values on a line of
/// text that the header does not declare, and of what stands behind the end. Errors: bad_input, with the line or the
/// byte in the message; limit.
Result<TriangleMesh> readPly(std::span<const std::byte> bytes, const MeshLimits& limits = {});

}  // namespace sgm::asset
