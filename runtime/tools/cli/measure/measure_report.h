#pragma once
// The report of `sgm measure`.

#include <string>
#include <string_view>
#include <vector>

#include "base/json.h"
#include "measure/mesh_measures.h"

namespace sgm::cli {

/// All measures as JSON, in the mesh's unit of length. origin: world position of the mesh's origin; it is added to
/// reported positions.
Json toJson(const measure::MeshMeasures& measures, measure::Point origin = {});
/// The report of `sgm measure` as JSON, except the elapsed time: it has the members of `known`, the file's name, and
/// all measures.
Json reportJson(Json known, const std::string& file, const measure::MeshMeasures& measures, measure::Point origin);
/// Returns all measures as lines of text. The caller prints them below a line that names the mesh. unit: suffix of
/// lengths, " m"; empty if the mesh's unit is unknown.
std::string textOf(const measure::MeshMeasures& measures, measure::Point origin = {}, std::string_view unit = "");
/// Reasons why the mesh is not the surface of a solid: one sentence for each kind of defect, with the position of its
/// first occurrence if known.
std::vector<std::string> problemsOf(const measure::MeshMeasures& measures, measure::Point origin = {});
/// Checks that could not be carried out, one sentence each. A mesh is valid if problemsOf() and unknownsOf() are empty.
std::vector<std::string> unknownsOf(const measure::MeshMeasures& measures);

}  // namespace sgm::cli
