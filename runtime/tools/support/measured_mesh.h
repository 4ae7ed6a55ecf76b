#pragma once
// The triangles that `measure` and `classify` examine, from a file or from a grammar's region.

#include <cstddef>
#include <span>
#include <string>

#include "asset/read/mesh_file.h"
#include "measure/defect_places.h"
#include "tools/support/limited_process.h"
#include "tools/support/region.h"

namespace sgm::cli {

/// Whether the path's name ends in .sgm, in any case, as meshFileKind() treats names of meshes.
bool isGrammarFile(const std::string& path);

/// The triangles of a file in memory, of any number. Errors: those of readMesh.
Result<asset::TriangleMesh> readMeshBytes(std::span<const std::byte> bytes, std::optional<asset::MeshFileKind> kind);

/// Prints the reader's notes to stderr, a line each. Errors: io; those of readMesh, with the file's name in front.
Result<asset::TriangleMesh> readMeshFile(const std::string& file);

/// The same in a sandboxed process, which returns only points, triangles and the origin. To be called before this
/// process has threads. Errors: those of readMeshFile and runLimited.
Result<asset::TriangleMesh> readMeshFileApart(const std::string& file, const ProcessLimits& limits);

/// The box that was meshed, relative to the mesh's origin.
measure::Cut cutOf(const Region& region);

/// Positions in metres from its origin; the mesh before its creases were split, if they were.
asset::TriangleMesh trianglesOf(const Region& region);

}  // namespace sgm::cli
