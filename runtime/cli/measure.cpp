// sgm measure: what a mesh file, or a grammar's region, measures, and whether it is the surface of a solid.

#include <fmt/core.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>

#include "asset/mesh_file.h"
#include "cli/commands.h"
#include "cli/limited_process.h"
#include "cli/measure_report.h"
#include "cli/region.h"

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
  for (const measure::HistogramMode mode :
       {measure::HistogramMode::printed, measure::HistogramMode::corrected, measure::HistogramMode::curvature}) {
    if (measure::nameOf(mode) == options.mode) settings.histogram.mode = mode;
  }
  return settings;
}

Result<std::vector<std::byte>> readBytes(const std::string& path) {
  const auto failed = [&](const std::string& why) {
    return Error{Code::io, fmt::format("cannot read {}: {}", path, why)};
  };
  std::error_code why;
  const std::filesystem::file_status status = std::filesystem::status(path, why);
  // Whatever else it may be, a pipe say, would be waited for.
  if (why && !std::filesystem::exists(status)) return failed(why.message());
  if (!std::filesystem::exists(status)) return failed("no such file");
  if (!std::filesystem::is_regular_file(status)) return failed("it is no file of bytes");
  const uintmax_t size = std::filesystem::file_size(path, why);
  std::ifstream file(path, std::ios::binary);
  if (why || !file) return failed(why ? why.message() : std::strerror(errno));
  std::vector<std::byte> bytes(size);
  file.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(size));
  if (file.gcount() != static_cast<std::streamsize>(size)) return failed("it ended before its size");
  return bytes;
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
  Result<std::vector<std::byte>> bytes = readBytes(options.file);
  if (!bytes) return bytes.error();
  // What a file may hold is limited by the process's memory alone.
  asset::MeshLimits limits;
  limits.points = limits.triangles = std::numeric_limits<uint32_t>::max();
  limits.farthest = 1e12;
  limits.json_bytes = size_t{64} << 20;
  limits.nodes = size_t{1} << 20;
  Result<asset::TriangleMesh> mesh = asset::readMesh(*bytes, kind, limits);
  if (!mesh) return Error{mesh.error().code, options.file + ": " + mesh.error().message};
  *bytes = {};
  const Result<std::unique_ptr<JobSystem>> jobs = makeThreadPool(options.threads);
  if (!jobs) return jobs.error();
  return reportOf({mesh->points, mesh->triangles}, options, **jobs, options.file, {{"file", options.file}},
                  watch.seconds());
}

Exit measureGrammar(const MeasureOptions& options) {
  const RegionResult made = meshRegion(options);
  if (!made.region) return made.status;
  const Region& region = *made.region;
  const WorldMesh& mesh = region.unsplit ? *region.unsplit : region.meshed.mesh;
  std::vector<measure::Point> points;
  points.reserve(mesh.positions.size());
  for (const std::array<double, 3>& p : mesh.positions) points.push_back({p[0], p[1], p[2]});
  std::vector<measure::Triangle> triangles;
  triangles.reserve(mesh.indices.size() / 3);
  for (size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
    triangles.push_back({mesh.indices[i], mesh.indices[i + 1], mesh.indices[i + 2]});
  }
  const Result<std::unique_ptr<JobSystem>> jobs = makeThreadPool(options.threads);
  if (!jobs) return complain(jobs.error());
  Json json = toJson(options, region);
  json["file"] = options.file;
  const Result<std::string> report =
      reportOf({points, triangles}, options, **jobs, options.file, std::move(json), region.seconds);
  if (!report) return complain(report.error());
  fmt::print("{}", *report);
  return Exit::done;
}

}  // namespace

Exit measureMesh(const MeasureOptions& options) {
  if (std::filesystem::path(options.file).extension() == ".sgm") return measureGrammar(options);
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
