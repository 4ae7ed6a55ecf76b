// Makes the report on an upload: its measures, its class, and a preview mesh.

#include <algorithm>
#include <utility>

#include "asset/read/mesh_limits.h"
#include "tools/cli/classify/classification.h"
#include "tools/cli/classify/commands.h"
#include "tools/cli/classify/inspect.h"
#include "tools/cli/classify/master_key.h"
#include "tools/cli/classify/page_mesh.h"
#include "tools/cli/measure/measure_report.h"
#include "tools/support/measured_mesh.h"

namespace sgm::cli {
namespace {

using measure::MeshMeasures;

/// The mesh of an upload, and what is known about its source.
struct Subject {
  asset::TriangleMesh mesh;
  /// Set for a region of a grammar: the region's box, whose faces may cut the surface open.
  std::optional<measure::Cut> cut;
  double density = 0;  ///< set for a region of a grammar: grid cells per metre
  Json known, more;    ///< known: additional members of the object "measures"; more: additional members of the report
};

Json previewJson(const Preview& preview, size_t of_triangles) {
  return {{"triangles", preview.indices.size() / 3},
          {"points", preview.positions.size()},
          {"of_triangles", of_triangles},
          {"origin", {preview.origin.x, preview.origin.y, preview.origin.z}},
          {"low", {preview.low[0], preview.low[1], preview.low[2]}},
          {"high", {preview.high[0], preview.high[1], preview.high[2]}}};
}

Json nearestJson(const Classified& classified) {
  Json nearest = Json::array();
  for (const measure::Master& master : classified.nearest)
    nearest.push_back({{"class", master.class_name}, {"name", master.name}, {"shares", master.shares}});
  return nearest;
}

void addClassification(Json& json, const Result<Classified>& classified) {
  json["classification"] = classified ? toJson(*classified) : Json(nullptr);
  json["classification_error"] = classified ? Json(nullptr) : Json(classified.error().message);
  json["nearest_masters"] = classified ? nearestJson(*classified) : Json::array();
}

std::string nameOf(const InspectOptions& options) {
  return options.name.empty() ? "upload." + options.kind : options.name;
}

/// The JSON pointer to the place in a glTF file that an error message names; empty if it names none.
std::string placeOf(const std::string& message) {
  constexpr std::string_view kAccessor = "accessor ";
  const std::string_view pointer = asset::pointerIn(message);
  if (!pointer.empty() || !message.starts_with(kAccessor)) return std::string(pointer);
  const size_t end = message.find_first_not_of("0123456789", kAccessor.size());
  return "/accessors/" + message.substr(kAccessor.size(), end - kAccessor.size());
}

InspectAnswer refused(const InspectProblem& problem) { return {toJson(problem), {}}; }

/// Measures and classifies a mesh, and makes its preview. Reports a problem only if memory is exhausted.
InspectAnswer judged(const Subject& subject, const InspectOptions& options, const Result<masters::OpenedBase>& base,
                     const Stopwatch& watch) {
  const asset::TriangleMesh& mesh = subject.mesh;
  const Result<std::unique_ptr<JobSystem>> jobs = makeThreadPool(0);
  if (!jobs) return refused(outOfMemory(options));
  measure::MeshSettings settings;
  settings.cut = subject.cut;

  // Measuring, classifying and simplifying are independent, so they run concurrently.
  std::optional<Result<MeshMeasures>> measures;
  std::optional<Result<Classified>> classified;
  Preview preview;
  const std::array<std::function<void()>, 3> works{
      [&] {
        measures = measure::measureMesh({mesh.points, mesh.triangles}, settings, **jobs);
      },
      [&] {
        classified = base ? classifyTriangles(mesh, ClassifyOptions{}.mode, subject.density, *base, **jobs)
                          : Result<Classified>(base.error());
      },
      [&] { preview = previewOf(mesh); }};
  parallelFor(**jobs, works.size(), [&](size_t work) { works[work](); });
  if (!*measures) return refused(problemOf(measures->error(), options));

  const MeshMeasures& m = **measures;
  InspectAnswer answer;
  Json report = reportJson(subject.known, nameOf(options), m, mesh.origin);
  report["seconds"] = watch.seconds();
  answer.json = {{"valid", m.validButForCut() && m.triangles > 0}, {"measures", std::move(report)}};
  addClassification(answer.json, *classified);
  if (!preview.indices.empty()) answer.preview = bytesOf(preview);
  answer.json["preview"] = preview.indices.empty() ? Json(nullptr) : previewJson(preview, mesh.triangles.size());
  answer.json.update(subject.more);
  return answer;
}

bool saysOfRegion(const InspectOptions& options) {
  return !options.region.empty() || !options.cell.empty() || !options.seed.empty() || !options.sets.empty();
}

}  // namespace

InspectAnswer inspectUpload(std::span<const std::byte> bytes, const InspectOptions& options,
                            const Result<masters::OpenedBase>& base) {
  const Stopwatch watch;
  Subject subject;
  subject.more = Json::object();
  if (options.kind == "sgm") {
    InspectedGrammar grammar = meshUploadedGrammar(bytes, options);
    if (!grammar.region) return refused(grammar.problem);
    subject.mesh = trianglesOf(*grammar.region);
    subject.cut = cutOf(*grammar.region);
    subject.density = 1 / metres(grammar.region->cell);
    subject.known = std::move(grammar.measures);
    subject.more["diagnostics"] = std::move(grammar.diagnostics);
    if (!grammar.region->empty_because.empty()) subject.more["empty_because"] = grammar.region->empty_because;
    return judged(subject, options, base, watch);
  }
  if (saysOfRegion(options))
    return refused(problemOf(
        {Code::bad_input, "region, cell, seed and set are for grammars: leave them out for a mesh"}, options));
  const asset::MeshFileKind kind = *asset::meshFileKind("." + options.kind);
  Result<asset::TriangleMesh> mesh = readMeshBytes(bytes, kind);
  if (!mesh) {
    InspectProblem problem = problemOf(mesh.error(), options);
    problem.pointer = placeOf(problem.detail);
    return refused(problem);
  }
  subject.mesh = std::move(*mesh);
  subject.known = {{"notes", subject.mesh.notes}};
  return judged(subject, options, base, watch);
}

}  // namespace sgm::cli
