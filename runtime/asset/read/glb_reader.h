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

/// The advice that follows a problem with a GLB file.
inline constexpr std::string_view kGlbAdvice =
    "save it as binary glTF 2.0 (.glb), all in one file, as triangles, uncompressed";

/// Reads the triangles of the file's scene, or of all nodes if it has no scene: triangles, strips and fans. They are
/// morphed by the default weights and placed by their skins or nodes. Reads NORMAL, and the texture coordinates of the
/// material's first texture (0 for primitives without coordinates, if others have them). Of materials, only the names
/// are read. Also reads glTF as JSON text whose buffers are `data:` URIs. Notes in the result report lines, points,
/// hidden nodes, other scenes and extensions that are left out, and violations of the format. Cameras, lights and
/// animations are ignored. Errors: bad_input, with the JSON pointer or the byte in the message; limit.
Result<TriangleMesh> readGlb(std::span<const std::byte> bytes, const MeshLimits& limits = {});

}  // namespace sgm::asset
