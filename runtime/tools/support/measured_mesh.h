#pragma once
// The triangles that `measure` and `classify` examine, from a file or from a grammar's region.

#include <cstddef>
#include <span>
#include <string>

#include "asset/read/mesh_file.h"
#include "measure/defect_places.h"
#include "tools/support/region.h"
#include "tools/support/sandbox.h"

namespace sgm::cli {

/// Whether the path's file name ends in .sgm, in upper or lower case, as meshFileKind() treats names of mesh files.
bool isGrammarFile(const std::string& path);

/// Reads a mesh file from memory, with any number of triangles. Errors: those of readMesh.
Result<asset::TriangleMesh> readMeshBytes(std::span<const std::byte> bytes, std::optional<asset::MeshFileKind> kind);

/// Reads a mesh file, and prints the reader's notes to stderr, one on each line. Errors: io; those of readMesh, with
/// the file's name in front.
Result<asset::TriangleMesh> readMeshFile(const std::string& file);

/// In a sandboxed process: the answer to askSandboxForMesh(), which has only points, triangles and the origin of the
/// file's mesh. Errors: those of readMeshFile.
Result<std::string> meshFileAnswer(const std::string& file);
/// The mesh of a file that the sandboxed process reads. Errors: those of readMeshFile and askSandbox.
Result<asset::TriangleMesh> askSandboxForMesh(const std::string& file, const SandboxOptions& options);

/// The box that was meshed, relative to the mesh's origin, at whose faces the surface may be cut.
measure::Cut cutOf(const Region& region);

/// The region's mesh, with positions in metres from its origin. If creases were split for sharp features, the mesh
/// before the split.
asset::TriangleMesh trianglesOf(const Region& region);

}  // namespace sgm::cli
