#pragma once
// Files of triangles from outside, whatever their format.

#include <cstddef>
#include <optional>
#include <span>
#include <string_view>

#include "asset/mesh_limits.h"
#include "asset/triangle_mesh.h"

namespace sgm::asset {

enum class MeshFileKind { glb, obj, ply, stl };

/// By what a path's name ends in, in letters of any case. Error: invalid_argument, naming the four.
Result<MeshFileKind> meshFileKind(std::string_view path);
/// By how a file begins, or by its size; nothing where it is none of the four.
std::optional<MeshFileKind> meshFileKind(std::span<const std::byte> bytes);

/// What to do about a file that its reader refuses.
std::string_view meshFileAdvice(MeshFileKind kind);

/// The triangles of a file, as the kind's own reader says. Linear in the file's size. Errors: bad_input, with the line,
/// the byte or the JSON pointer in the message; limit. Behind what is wrong the message says what to do.
Result<TriangleMesh> readMesh(std::span<const std::byte> bytes, MeshFileKind kind, const MeshLimits& limits = {});

}  // namespace sgm::asset
