#pragma once
// The meshes that `measure` and `classify` examine, from a mesh file or from a region of a grammar's world.

#include <cstddef>
#include <span>
#include <string>

#include "asset/read/mesh_file.h"
#include "measure/defect_places.h"
#include "tools/support/region.h"
#include "tools/support/sandbox.h"

namespace sgm::cli {

/// Whether the file name ends in .sgm, in upper or lower case; meshFileKind() compares extensions in the same way.
bool isGrammarFile(const std::string& path);

/// Parses a mesh file in memory. The number of triangles is not limited. Errors: those of readMesh().
Result<asset::TriangleMesh> readMeshBytes(std::span<const std::byte> bytes, std::optional<asset::MeshFileKind> kind);

/// Reads a mesh file, and prints the reader's notes to stderr, one on each line. Errors: io; those of readMesh(), with
/// the file name prepended.
Result<asset::TriangleMesh> readMeshFile(const std::string& file);

/// Reads a mesh file in the sandboxed process, and encodes its points, triangles and origin as the answer to
/// askSandboxForMesh(). Errors: those of readMeshFile().
Result<std::string> meshFileAnswer(const std::string& file);
/// Lets the sandboxed process read a mesh file, and decodes its answer. Errors: those of readMeshFile() and
/// askSandbox().
Result<asset::TriangleMesh> askSandboxForMesh(const std::string& file, const SandboxOptions& options);

/// The box of the region, relative to the mesh's origin, in metres. Its faces may cut the surface.
measure::Cut cutOf(const Region& region);

/// The region's mesh, with positions in metres from its origin. With sharp features, this is the mesh before vertices
/// on creases were split.
asset::TriangleMesh trianglesOf(const Region& region);

}  // namespace sgm::cli
