#pragma once
// What `sgm measure` says of a mesh.

#include <string>
#include <string_view>
#include <vector>

#include "base/json.h"
#include "measure/mesh_measures.h"

namespace sgm::cli {

/// Everything, in the mesh's unit. origin: where its points count from; places are told from 0.
Json toJson(const measure::MeshMeasures& measures, measure::Point origin = {});
/// The whole report, but for the time that it took: what is `known` of the mesh by itself, the file's name, and
/// everything.
Json reportJson(Json known, const std::string& file, const measure::MeshMeasures& measures, measure::Point origin);
/// Everything in lines for people, below a line that names the mesh. unit: " m", or nothing where it is not known.
std::string textOf(const measure::MeshMeasures& measures, measure::Point origin = {}, std::string_view unit = "");
/// What is wrong with it as a solid's surface, one sentence each, with the first place where there is one.
std::vector<std::string> problemsOf(const measure::MeshMeasures& measures, measure::Point origin = {});
/// What could not be looked at, likewise. A mesh is valid where both are empty.
std::vector<std::string> unknownsOf(const measure::MeshMeasures& measures);

}  // namespace sgm::cli
