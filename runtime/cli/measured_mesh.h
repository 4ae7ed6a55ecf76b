#pragma once
// The triangles that `measure` and `classify` look at, from a file or from a grammar's region.

#include <string>

#include "asset/mesh_file.h"
#include "cli/region.h"

namespace sgm::cli {

/// Errors: io; those of readMesh, with the file's name in front.
Result<asset::TriangleMesh> readMeshFile(const std::string& file, asset::MeshFileKind kind);

/// Positions in metres from the mesh's origin; the mesh before its creases are split, where it has been.
asset::TriangleMesh trianglesOf(const Region& region);

}  // namespace sgm::cli
