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

/// Whether the path's name ends in .sgm, in any case, as meshFileKind() treats names of meshes.
bool isGrammarFile(const std::string& path);

/// The triangles of a file in memory, of any number. Errors: those of readMesh.
Result<asset::TriangleMesh> readMeshBytes(std::span<const std::byte> bytes, std::optional<asset::MeshFileKind> kind);

/// Prints the reader's notes to stderr, a line each. Errors: io; those of readMesh, with the file's name in front.
Result<asset::TriangleMesh> readMeshFile(const std::string& file);

/// In a sandboxed process: the answer to askSandboxForMesh(), which has only points, triangles and the origin of the
/// file's mesh. Errors: those of readMeshFile.
Result<std::string> meshFileAnswer(const std::string& file);
/// The mesh of a file that the sandboxed process reads. Errors: those of readMeshFile and askSandbox.
Result<asset::TriangleMesh> askSandboxForMesh(const std::string& file, const SandboxOptions& options);

/// The box that was meshed, relative to the mesh's origin.
measure::Cut cutOf(const Region& region);

/// Positions in metres from its origin; the mesh before its creases were split, if they were.
asset::TriangleMesh trianglesOf(const Region& region);

}  // namespace sgm::cli
