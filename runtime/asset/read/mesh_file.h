#pragma once
// Files of triangles from outside, whatever their format.

#include <cstddef>
#include <optional>
#include <span>
#include <string_view>

#include "asset/read/mesh_limits.h"
#include "asset/triangle_mesh.h"

namespace sgm::asset {

enum class MeshFileKind { glb, obj, ply, stl };

/// By what a path's name ends in, in letters of any case; .gltf is read as .glb is. Error: invalid_argument, naming the
/// endings.
Result<MeshFileKind> meshFileKind(std::string_view path);
/// By how a file begins, or by its size; nullopt if it is none of the four.
std::optional<MeshFileKind> meshFileKind(std::span<const std::byte> bytes);

/// What to do about a file that its reader refuses.
std::string_view meshFileAdvice(MeshFileKind kind);

/// The triangles of a file, as the reader of its kind says. The bytes decide the kind where they tell it: `named` is
/// what a name or a media type says, nullopt if that says nothing, and a note tells if the bytes say something else.
/// Text may be in UTF-8 or UTF-16. Linear in the file's size. Errors: bad_input, with the line, the byte or the JSON
/// pointer in the message; limit. Behind what is wrong the message says what to do.
Result<TriangleMesh> readMesh(std::span<const std::byte> bytes, std::optional<MeshFileKind> named,
                              const MeshLimits& limits = {});

/// The same, with messages that say what is wrong alone; `kind` becomes that of the bytes.
Result<TriangleMesh> readMeshOf(std::span<const std::byte> bytes, std::optional<MeshFileKind>& kind,
                                const MeshLimits& limits = {});

}  // namespace sgm::asset
