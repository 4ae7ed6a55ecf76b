#pragma once
// Reads triangles from PLY files: text files, and binary files of either byte order. The file is untrusted: all values
// in it are checked, and memory and time are limited.

#include <cstddef>
#include <span>

#include "asset/read/mesh_limits.h"
#include "asset/triangle_mesh.h"

namespace sgm::asset {

/// Returns the file's faces, cut into triangles, and its triangle strips (`tristrips`). Of its vertices it reads x y z,
/// also nx ny nz if all three are present, and u v, s t or texture_u texture_v. Other elements and properties are
/// skipped. Notes report faces with fewer than three corners, self-intersecting polygons, undeclared values on a line
/// of text, and bytes after the end. Errors: bad_input, with the line or the byte in the message; limit.
Result<TriangleMesh> readPly(std::span<const std::byte> bytes, const MeshLimits& limits = {});

}  // namespace sgm::asset
