#pragma once
// Binary glTF 2.0 to triangles. The file is untrusted: all that it says is checked, and what it may ask for is capped.
// The specification: https://registry.khronos.org/glTF/specs/2.0/glTF-2.0.html

#include <cstddef>
#include <span>
#include <string_view>

#include "asset/read/mesh_limits.h"
#include "asset/triangle_mesh.h"

namespace sgm::asset {

/// What to do about a file that readGlb refuses.
inline constexpr std::string_view kGlbAdvice =
    "save it as binary glTF 2.0 (.glb), all in one file, as triangles, uncompressed";

/// The triangles of the file's scene (of all nodes, if it has none): triangles, strips and fans, morphed by the default
/// weights, held by their skins or moved as their nodes say, with NORMAL and the texture coordinates that the
/// material's first texture names (zero for primitives that have none, if others have); of materials their names. Also
/// glTF as JSON text whose buffers are `data:` URIs. Notes tell of lines and points, hidden nodes, other scenes and
/// extensions that are left out, and of what is not as the format demands. Cameras, lights and animations are left out.
/// Errors: bad_input, with the JSON pointer or the byte in the message; limit.
Result<TriangleMesh> readGlb(std::span<const std::byte> bytes, const MeshLimits& limits = {});

}  // namespace sgm::asset
