#pragma once
// PLY to triangles: text, and binary of either byte order. The file is untrusted: all that it says is checked, and what
// it may ask for is capped.

#include <cstddef>
#include <span>

#include "asset/mesh_limits.h"
#include "asset/triangle_mesh.h"

namespace sgm::asset {

/// The file's faces, polygons as fans (those of fewer than three corners are left out), and of its vertices x y z,
/// where there are all of them nx ny nz, and u v, s t or texture_u texture_v. Other elements and properties are passed
/// over. Errors: bad_input, with the line or the byte in the message; limit.
Result<TriangleMesh> readPly(std::span<const std::byte> bytes, const MeshLimits& limits = {});

}  // namespace sgm::asset
