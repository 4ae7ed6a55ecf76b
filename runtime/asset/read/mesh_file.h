#pragma once
// Reads mesh files from outside, of any supported format.

#include <cstddef>
#include <optional>
#include <span>
#include <string_view>

#include "asset/read/mesh_limits.h"
#include "asset/triangle_mesh.h"

namespace sgm::asset {

enum class MeshFileKind { glb, obj, ply, stl };

/// The kind by the extension of a path, in any case; .gltf is read as .glb. Error: invalid_argument, with the supported
/// extensions.
Result<MeshFileKind> meshFileKind(std::string_view path);
/// The kind by the first bytes of a file, or by its size; nullopt if the format is unknown.
std::optional<MeshFileKind> meshFileKind(std::span<const std::byte> bytes);

/// The remedy for a file that its reader rejects.
std::string_view meshFileAdvice(MeshFileKind kind);

/// Reads the triangles of a file by the reader of its kind. The bytes determine the kind if they are unambiguous.
/// `named` is the kind by the file name or media type, nullopt if unknown; if the bytes contradict it, a note is added.
/// Text may be in UTF-8 or UTF-16. Linear in the file's size. Errors: bad_input, with the line, the byte or the JSON
/// pointer in the message; limit. The message ends with a remedy.
Result<TriangleMesh> readMesh(std::span<const std::byte> bytes, std::optional<MeshFileKind> named,
                              const MeshLimits& limits = {});

/// The same, with messages that state only the problem; `kind` is set to the kind of the bytes.
Result<TriangleMesh> readMeshOf(std::span<const std::byte> bytes, std::optional<MeshFileKind>& kind,
                                const MeshLimits& limits = {});

}  // namespace sgm::asset
