#pragma once
// Binary glTF 2.0 to triangles. The file is untrusted: all that it says is checked, and what it may ask for is capped.
// The specification: https://registry.khronos.org/glTF/specs/2.0/glTF-2.0.html

#include <cstddef>
#include <span>
#include <string_view>

#include "asset/mesh_limits.h"
#include "asset/triangle_mesh.h"

namespace sgm::asset {

/// What to do about a file that readGlb refuses.
inline constexpr std::string_view kGlbAdvice =
    "save it as binary glTF 2.0 (.glb), all in one file, as triangles, uncompressed";

/// The triangles of the file's scene (of all nodes, where it has none), moved as its nodes say, with NORMAL and
/// TEXCOORD_0 (zero for primitives that have none, where others have); of materials their names. Skins, morph targets,
/// cameras and lights are left out. Errors: bad_input, with the JSON pointer or the byte in the message; limit.
Result<TriangleMesh> readGlb(std::span<const std::byte> bytes, const MeshLimits& limits = {});

}  // namespace sgm::asset
