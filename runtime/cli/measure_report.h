#pragma once
// What `sgm measure` says of a mesh.

#include <string>
#include <vector>

#include "cli/json.h"
#include "measure/mesh_measures.h"

namespace sgm::cli {

/// Everything, in the mesh's unit.
Json toJson(const measure::MeshMeasures& measures);
/// The same in lines for people, below a line that names the mesh.
std::string textOf(const measure::MeshMeasures& measures);
/// What is wrong with it as a solid's surface, one sentence each.
std::vector<std::string> problemsOf(const measure::MeshMeasures& measures);
/// What could not be looked at, likewise. A mesh is valid where both are empty.
std::vector<std::string> unknownsOf(const measure::MeshMeasures& measures);

}  // namespace sgm::cli
