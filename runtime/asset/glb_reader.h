#pragma once
// Binary glTF 2.0 to triangles. The file is untrusted: all that it says is checked, and what it may ask for is capped.
// The specification: https://registry.khronos.org/glTF/specs/2.0/glTF-2.0.html

#include <cstddef>
#include <span>
#include <string_view>

#include "asset/triangle_mesh.h"
#include "base/result.h"

namespace sgm::asset {

struct GlbLimits {
  size_t json_bytes = 1u << 20;
  size_t points = 1u << 22;  ///< of all primitives, each as often as nodes show it
  size_t triangles = 1u << 22;
  size_t nodes = 1u << 16;
};

/// What to do about a file that readGlb refuses.
inline constexpr std::string_view kGlbAdvice =
    "save it as binary glTF 2.0 (.glb), all in one file, as triangles, uncompressed";

/// The triangles of the file's scene (of all nodes, where it has none), moved as its nodes say; of materials their
/// names. Skins, morph targets, cameras and lights are left out. Errors: bad_input, limit.
Result<TriangleMesh> readGlb(std::span<const std::byte> bytes, const GlbLimits& limits = {});

}  // namespace sgm::asset
