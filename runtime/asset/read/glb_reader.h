#pragma once
// Reads triangles from binary glTF 2.0. The file is untrusted: all values in it are checked, and memory and time are
// limited.
// The specification: https://registry.khronos.org/glTF/specs/2.0/glTF-2.0.html

#include <cstddef>
#include <span>
#include <string_view>

#include "asset/read/mesh_limits.h"
#include "asset/triangle_mesh.h"

namespace sgm::asset {

/// The advice that follows an error message about a GLB file.
inline constexpr std::string_view kGlbAdvice =
    "save it as binary glTF 2.0 (.glb), all in one file, as triangles, uncompressed";

/// Reads the triangles of the file's scene, or of all nodes if it has no scene. Accepts triangle lists, strips and
/// fans. Meshes are morphed by their default weights and transformed by their skins or nodes. Reads NORMAL and, of each
/// material, the name and the texture coordinates of its most visible texture; primitives without texture coordinates
/// get 0 if others have them. Also reads glTF as JSON text whose buffers are `data:` URIs.
///
/// Notes in the result report violations of the format, and lines, points, hidden nodes, further scenes and extensions
/// that are left out. Cameras, lights and animations are ignored without a note. Errors: bad_input, with the JSON
/// pointer or the byte in the message; limit.
Result<TriangleMesh> readGlb(std::span<const std::byte> bytes, const MeshLimits& limits = {});

}  // namespace sgm::asset
