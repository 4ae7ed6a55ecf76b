#pragma once
// Reads triangles from STL files, binary and text. The file is untrusted: all values in it are checked, and memory and
// time are limited.

#include <cstddef>
#include <span>

#include "asset/read/mesh_limits.h"
#include "asset/triangle_mesh.h"

namespace sgm::asset {

/// True if the file's size matches its number of triangles as binary STL. The size is more reliable than the first
/// bytes: many binary files begin with "solid", as text files do.
bool isBinaryStl(std::span<const std::byte> bytes);

/// True if the bytes begin as text STL does: with the word "solid", and no zero byte.
bool isTextStl(std::span<const std::byte> bytes);

/// Returns the file's triangles. Each triangle has three points of its own, so the caller must merge equal points.
/// Normals, colours and names of facets are ignored. Notes report bytes after the end. Errors: bad_input, with the line
/// or the byte in the message; limit.
Result<TriangleMesh> readStl(std::span<const std::byte> bytes, const MeshLimits& limits = {});

}  // namespace sgm::asset
