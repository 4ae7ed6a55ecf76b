// sgm measure: what a mesh file, or a grammar's region, measures, and whether it is the surface of a solid.

#include <fmt/core.h>

#include <filesystem>

#include "cli/commands.h"
#include "cli/limited_process.h"
#include "cli/measure_report.h"
#include "cli/measure_void.h"
#include "cli/measured_mesh.h"

namespace sgm::cli {
namespace {

measure::MeshSettings settingsOf(const MeasureOptions& options) {
  measure::MeshSettings settings;
  settings.weld = options.weld;
  settings.self_intersections = !options.no_self_intersections;
  settings.cubes = options.cubes;
  settings.histogram.bins = options.bins;
  settings.histogram.length = options.curvature_length;
  settings.histogram.unique_edges = options.unique_edges;
  settings.histogram.mode = measure::modeNamed(options.mode).value_or(settings.histogram.mode);
  return settings;
}

/// What is printed of a mesh; of what: the line above it.
Result<std::string> reportOf(const measure::Triangles& mesh, const MeasureOptions& options, JobSystem& jobs,
                             const std::string& what, Json json, double seconds) {
  const Stopwatch watch;
  const Result<measure::MeshMeasures> measures = measure::measureMesh(mesh, settingsOf(options), jobs);
  if (!measures) return measures.error();
  if (options.json) {
    json.update(toJson(*measures));
    json["seconds"] = seconds + watch.seconds();
    return json.text() + "\n";
  }
  return fmt::format("{}: {} triangles, {} points, {:.2f} s\n", what, measures->triangles, measures->points,
                     seconds + watch.seconds()) +
         textOf(*measures);
}

Result<std::string> measureFile(const MeasureOptions& options, asset::MeshFileKind kind) {
  const Stopwatch watch;
  const Result<asset::TriangleMesh> mesh = readMeshFile(options.file, kind);
  if (!mesh) return mesh.error();
  const Result<std::unique_ptr<JobSystem>> jobs = makeThreadPool(options.threads);
  if (!jobs) return jobs.error();
  return reportOf({mesh->points, mesh->triangles}, options, **jobs, options.file, {{"file", options.file}},
                  watch.seconds());
}

Exit measureGrammar(const MeasureOptions& options) {
  const RegionResult made = meshRegion(options);
  if (!made.region) return made.status;
  const Region& region = *made.region;
  const asset::TriangleMesh mesh = trianglesOf(region);
  const Result<std::unique_ptr<JobSystem>> jobs = makeThreadPool(options.threads);
  if (!jobs) return complain(jobs.error());
  Json json = toJson(options, region);
  json["file"] = options.file;
  const Result<std::string> report =
      reportOf({mesh.points, mesh.triangles}, options, **jobs, options.file, std::move(json), region.seconds);
  if (!report) return complain(report.error());
  fmt::print("{}", *report);
  return Exit::done;
}

}  // namespace

Exit measureMesh(const MeasureOptions& options) {
  const bool grammar = std::filesystem::path(options.file).extension() == ".sgm";
  if (asksForVoid(options)) {
    if (grammar) return measureVoid(options);
    return complain(Exit::usage, "--from, --to and --radius ask for the void of a grammar: a mesh file has none");
  }
  if (grammar) return measureGrammar(options);
  const Result<asset::MeshFileKind> kind = asset::meshFileKind(std::string_view(options.file));
  if (!kind) return complain(Exit::usage, kind.error().message + "; or a grammar, .sgm");
  ProcessLimits limits;
  limits.memory = options.memory << 20;
  limits.seconds = options.seconds;
  const Result<std::string> report = runLimited([&] { return measureFile(options, *kind); }, limits);
  if (!report) return complain(report.error());
  fmt::print("{}", *report);
  return Exit::done;
}

}  // namespace sgm::cli
