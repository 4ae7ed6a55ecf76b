// `sgm measure`: measures a mesh file or a region of a grammar's world, and checks whether the mesh is the surface of a
// solid.

#include <fmt/core.h>

#include <utility>
#include <vector>

#include "tools/cli/measure/commands.h"
#include "tools/cli/measure/measure_report.h"
#include "tools/cli/measure/measure_void.h"
#include "tools/cli/measure/sampled_report.h"
#include "tools/support/console.h"
#include "tools/support/measured_mesh.h"
#include "tools/support/options.h"

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

/// The mesh to measure, and the parts of its report that are known before it is measured.
struct Subject {
  const asset::TriangleMesh& mesh;
  /// Only for a region of a grammar's world: the region's box. The surface may be cut open in the faces of this box.
  std::optional<measure::Cut> cut;
  Json json;              ///< properties of the source of the mesh
  std::string text;       ///< properties of the source of the mesh as text, printed after the mesh's name
  std::string_view unit;  ///< unit of length in the text: " m", or empty if unknown
  std::vector<std::pair<std::string, Section>> sections;  ///< optional sections with their names in JSON
};

constexpr char kSound = '+', kUnsound = '-';

/// Measures the mesh. Returns the text to print, preceded by the character kSound or kUnsound.
Result<std::string> reportOf(const Subject& subject, const MeasureOptions& options, JobSystem& jobs,
                             const Stopwatch& watch) {
  measure::MeshSettings settings = settingsOf(options);
  settings.cut = subject.cut;
  const asset::TriangleMesh& mesh = subject.mesh;
  const Result<measure::MeshMeasures> measures = [&] {
    ProgressBar bar("measuring");
    settings.progress = [&bar](uint64_t done, uint64_t total) { bar.show(done, total); };
    return measure::measureMesh({mesh.points, mesh.triangles}, settings, jobs);
  }();
  if (!measures) return measures.error();
  const char verdict = measures->validButForCut() && measures->triangles > 0 ? kSound : kUnsound;
  if (options.json) {
    Json json = reportJson(subject.json, options.file, *measures, mesh.origin);
    for (const auto& [name, section] : subject.sections) json[name] = section.json;
    json["seconds"] = watch.seconds();
    return verdict + json.text() + "\n";
  }
  std::string text = fmt::format("{}{}: {} triangles, {} points{}, {:.2f} s\n", verdict, options.file,
                                 measures->triangles, measures->points, subject.text, watch.seconds()) +
                     textOf(*measures, mesh.origin, subject.unit);
  for (const auto& [name, section] : subject.sections) text += section.text;
  return text;
}

Exit printed(const Result<std::string>& report, bool strict) {
  if (!report) return reportError(report.error());
  fmt::print("{}", std::string_view(*report).substr(1));
  return strict && report->front() == kUnsound ? Exit::input : Exit::done;
}

/// Measures the distance between two meshes. other: mesh of the file that --against names.
Result<Section> against(const asset::TriangleMesh& mesh, asset::TriangleMesh other, const MeasureOptions& options,
                        JobSystem& jobs) {
  for (measure::Point& p : other.points) p = p + (other.origin - mesh.origin);
  const measure::Triangles triangles{mesh.points, mesh.triangles};
  const measure::AreaVolume sums = measure::areaVolume(triangles, jobs);
  measure::HausdorffSettings settings;
  settings.tolerance = 1e-4 * length(sums.high - sums.low);
  const ProgressBar bar("comparing");
  const Result<measure::Hausdorff> found = hausdorff(triangles, {other.points, other.triangles}, settings, jobs);
  if (!found) return Error{found.error().code, "--against: " + found.error().message};
  return distanceSection(*found, options.against, other.triangles.size(), mesh.origin);
}

Result<std::string> measureFile(const MeasureOptions& options) {
  const Stopwatch watch;
  const auto read = [](const std::string& file) {
    const ProgressBar bar("reading");
    return readMeshFile(file);
  };
  const Result<asset::TriangleMesh> mesh = read(options.file);
  if (!mesh) return mesh.error();
  const Result<std::unique_ptr<JobSystem>> jobs = makeThreadPool(options.threads);
  if (!jobs) return jobs.error();
  Subject subject{*mesh, {}, {{"notes", mesh->notes}}, {}, mesh->in_metres ? " m" : "", {}};
  auto& sections = subject.sections;
  if (options.texels) sections.emplace_back("texels", texelSection(*mesh, *options.texels));
  if (options.drawing) sections.emplace_back("drawing", drawingSection(drawingCost({mesh->points, mesh->triangles})));
  if (!options.against.empty()) {
    Result<asset::TriangleMesh> other = read(options.against);
    if (!other) return other.error();
    Result<Section> section = against(*mesh, std::move(*other), options, **jobs);
    if (!section) return section.error();
    sections.emplace_back("against", std::move(*section));
  }
  return reportOf(subject, options, **jobs, watch);
}

/// Measures, for each pair of successive levels, the distance between the meshes of the two levels. The region is
/// extended to whole chunks.
Result<Section> levelsOf(const MeasureOptions& options, const WorldField& world, Backend& backend, JobSystem& jobs,
                         const Region& region) {
  Section all;
  all.json = Json::array();
  const ProgressBar bar("comparing levels");
  const WorldMesh* fine = region.unsplit ? &*region.unsplit : &region.meshed.mesh;
  IntBox extent = region.meshed.extent;
  RegionMesh held(world.memory());
  for (int level = options.level; level < options.level + options.levels; ++level) {
    Result<RegionMesh> coarse = meshRegion(world, backend, jobs, extent, level + 1, options.max_chunks, options.sharp);
    if (!coarse) return coarse.error();
    const int32_t cell = world.cellAt(level + 1);
    measure::HausdorffSettings settings;
    settings.tolerance = 0.01 * metres(cell);
    const Result<LevelDistance> found = levelDistance(*fine, extent, coarse->mesh, cell, settings, jobs);
    if (!found)
      return Error{found.error().code, fmt::format("--levels: {} and {}: {}", level, level + 1, found.error().message)};
    Section section = levelSection(*found, level, cell, fine->origin);
    all.json.push_back(std::move(section.json));
    all.text += section.text;
    held = std::move(*coarse);
    fine = &held.mesh;
    extent = held.extent;
  }
  return all;
}

/// Describes the seed, cell size and region from which the mesh was made.
std::string textOf(const WorldOptions& options, const Region& region) {
  const IntBox& extent = region.meshed.extent;
  return fmt::format(", seed {}, cells of {} m, region {},{},{}:{},{},{} m", options.seed, metres(region.cell),
                     metres(extent.lo.x), metres(extent.lo.y), metres(extent.lo.z), metres(extent.hi.x),
                     metres(extent.hi.y), metres(extent.hi.z));
}

Exit measureGrammar(const MeasureOptions& options) {
  std::optional<asset::TriangleMesh> other;
  if (!options.against.empty()) {
    Result<asset::TriangleMesh> read = askSandboxForMesh(options.against, options.sandbox);
    if (!read) return reportError(read.error());
    other = std::move(*read);
  }
  std::vector<std::pair<std::string, Section>> sections;
  RegionPlan plan;
  plan.texture = options.texels.has_value();
  plan.after = [&](const WorldField& world, Backend& backend, JobSystem& jobs, const Region& region) -> Result<void> {
    if (options.field) {
      const ProgressBar bar("sampling the field");
      const Result<FieldAgreement> found = fieldAgreement(world, jobs, region.meshed.mesh, options.level);
      if (!found) return found.error();
      sections.emplace_back("field", fieldSection(*found, region.cell, region.meshed.mesh.origin));
    }
    if (options.texels) sections.emplace_back("texels", texelSection(region, *options.texels));
    if (options.levels > 0) {
      Result<Section> section = levelsOf(options, world, backend, jobs, region);
      if (!section) return section.error();
      sections.emplace_back("levels", std::move(*section));
    }
    return {};
  };
  const Stopwatch watch;
  const RegionResult made = meshRegion(options, plan);
  if (!made.region) return made.status;
  const asset::TriangleMesh mesh = trianglesOf(*made.region);
  const Result<std::unique_ptr<JobSystem>> jobs = makeThreadPool(options.threads);
  if (!jobs) return reportError(jobs.error());
  if (options.drawing) sections.emplace_back("drawing", drawingSection(drawingCost({mesh.points, mesh.triangles})));
  if (other) {
    Result<Section> section = against(mesh, std::move(*other), options, **jobs);
    if (!section) return reportError(section.error());
    sections.emplace_back("against", std::move(*section));
  }
  return printed(reportOf({mesh, cutOf(*made.region), toJson(options, *made.region), textOf(options, *made.region),
                           " m", std::move(sections)},
                          options, **jobs, watch),
                 options.strict);
}

}  // namespace

Exit measureMesh(const MeasureOptions& options) {
  const bool grammar = isGrammarFile(options.file);
  if (options.sandbox.sandboxed)
    return answerFromSandbox(options.sandbox,
                             [&] { return grammar ? meshFileAnswer(options.against) : measureFile(options); });
  if (asksForVoid(options)) {
    if (grammar) return measureVoid(options);
    return reportError(Exit::usage, "--from, --to and --radius measure the void of a grammar: a mesh file has none");
  }
  if (grammar && options.against.empty() && !options.of_files.empty())
    return reportError(Exit::usage, options.of_files.front() + " is for mesh files, and for a grammar's --against");
  if (grammar && options.level + options.levels > kMaxLevel)
    return reportError(Exit::usage, fmt::format("--level and --levels reach level {}, and {} is the coarsest",
                                                options.level + options.levels, kMaxLevel));
  if (grammar) return measureGrammar(options);
  if (options.field || options.levels > 0) {
    return reportError(Exit::usage, fmt::format("{} is for grammars: a mesh file has no field and no levels",
                                                options.field ? "--field" : "--levels"));
  }
  if (!options.of_grammars.empty())
    return reportError(Exit::usage, options.of_grammars.front() + " is for grammars: a mesh file is measured as it is");
  return printed(askSandbox(options.sandbox), options.strict);
}

}  // namespace sgm::cli
