#pragma once
// The edges and corners of a region's mesh.

#include "base/jobs.h"
#include "mesh/sharpen.h"
#include "stream/world_field.h"

namespace sgm::api {

/// As sharpen(), with the field that the level's chunks were made from. Precondition: the mesh is a welded region of
/// that level. Errors: those of WorldField::compile.
Result<WorldMesh> sharpenRegion(const WorldField& world, JobSystem& jobs, const WorldMesh& mesh, int level);

}  // namespace sgm::api
