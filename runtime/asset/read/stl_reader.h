#pragma once
// STL to triangles, binary and text. The file is untrusted: all that it says is checked, and what it may ask for is
// capped.

#include <cstddef>
#include <span>

#include "asset/read/mesh_limits.h"
#include "asset/triangle_mesh.h"

namespace sgm::asset {

/// Whether the bytes are binary STL by their number, which says more than their beginning: many binary files begin with
/// "solid", as text does.
bool isBinaryStl(std::span<const std::byte> bytes);

/// Whether the bytes begin as STL does as text.
bool isTextStl(std::span<const std::byte> bytes);

/// The file's triangles, each with three points of its own: that corners meet is for the caller to find out. Facets'
/// normals, colours and names are left out. Notes tell of what stands behind the end. Errors: bad_input, with the line
/// or the byte in the message; limit.
Result<TriangleMesh> readStl(std::span<const std::byte> bytes, const MeshLimits& limits = {});

}  // namespace sgm::asset
