#pragma once
// The report of `sgm measure`.

#include <string>
#include <string_view>
#include <vector>

#include "base/json.h"
#include "measure/mesh_measures.h"

namespace sgm::cli {

/// All measures, in the mesh's unit. origin: origin of the mesh's points; places are reported relative to 0.
Json toJson(const measure::MeshMeasures& measures, measure::Point origin = {});
/// The whole report except its time: the `known` members, the file's name, and all measures.
Json reportJson(Json known, const std::string& file, const measure::MeshMeasures& measures, measure::Point origin);
/// All measures as lines of text, below a line that names the mesh. unit: " m", or empty if unknown.
std::string textOf(const measure::MeshMeasures& measures, measure::Point origin = {}, std::string_view unit = "");
/// Defects of the mesh as a solid's surface, one sentence each, with the first place if there is one.
std::vector<std::string> problemsOf(const measure::MeshMeasures& measures, measure::Point origin = {});
/// The same for failed checks. A mesh is valid if both are empty.
std::vector<std::string> unknownsOf(const measure::MeshMeasures& measures);

}  // namespace sgm::cli
