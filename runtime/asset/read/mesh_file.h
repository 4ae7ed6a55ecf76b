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

/// Returns the format by a path's file name extension, in upper or lower case; .gltf counts as .glb. Error:
/// invalid_argument, with the supported extensions in the message.
Result<MeshFileKind> meshFileKind(std::string_view path);
/// Returns the format by the content of a file (its first bytes or its size); nullopt if the format is unknown.
std::optional<MeshFileKind> meshFileKind(std::span<const std::byte> bytes);

/// Returns the advice that follows an error message about a file of this format.
std::string_view meshFileAdvice(MeshFileKind kind);

/// Reads the triangles of a file of any supported format. The content determines the format if it is unambiguous.
/// `named` is the format by file name or media type, nullopt if unknown; if the content contradicts it, a note is
/// added. Text may be in UTF-8 or UTF-16. Takes time linear in the file's size. Errors: bad_input, with the line, the
/// byte or the JSON pointer in the message; limit. The message ends with a remedy.
Result<TriangleMesh> readMesh(std::span<const std::byte> bytes, std::optional<MeshFileKind> named,
                              const MeshLimits& limits = {});

/// Same as readMesh(), but error messages state only the problem, without a remedy. Sets `kind` to the format of the
/// content.
Result<TriangleMesh> readMeshOf(std::span<const std::byte> bytes, std::optional<MeshFileKind>& kind,
                                const MeshLimits& limits = {});

}  // namespace sgm::asset
