#pragma once
// Reads mesh files of any supported format.

#include <cstddef>
#include <optional>
#include <span>
#include <string_view>

#include "asset/read/mesh_limits.h"
#include "asset/triangle_mesh.h"

namespace sgm::asset {

enum class MeshFileKind { glb, obj, ply, stl };

/// Returns the kind by the extension of a path, in upper or lower case; .gltf counts as .glb. Error: invalid_argument,
/// which lists the supported extensions.
Result<MeshFileKind> meshFileKind(std::string_view path);
/// Returns the kind by the first bytes or the size of a file; nullopt if the format is unknown.
std::optional<MeshFileKind> meshFileKind(std::span<const std::byte> bytes);

/// Returns the advice that follows a problem in a file of this kind.
std::string_view meshFileAdvice(MeshFileKind kind);

/// Reads the triangles of a file by the reader of its kind. The bytes determine the kind if they are unambiguous.
/// `named` is the kind by the file name or media type, nullopt if unknown; if the bytes contradict it, a note is added.
/// Text may be in UTF-8 or UTF-16. Linear in the file's size. Errors: bad_input, with the line, the byte or the JSON
/// pointer in the message; limit. The message ends with a remedy.
Result<TriangleMesh> readMesh(std::span<const std::byte> bytes, std::optional<MeshFileKind> named,
                              const MeshLimits& limits = {});

/// Same as readMesh, with messages that state only the problem. `kind` is set to the kind that the bytes show.
Result<TriangleMesh> readMeshOf(std::span<const std::byte> bytes, std::optional<MeshFileKind>& kind,
                                const MeshLimits& limits = {});

}  // namespace sgm::asset
