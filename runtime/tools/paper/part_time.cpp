// Figure 16: time to mesh a cave as a function of the mesh's density and of the number of triangles.

#include <fmt/core.h>

#include <cmath>

#include "tools/paper/backend_runs.h"
#include "tools/paper/chart.h"
#include "tools/paper/parts.h"
#include "tools/paper/report_context.h"

namespace sgm::cli {
namespace {

/// The exponent e of the best fit y = c x^e, by least squares of the logarithms.
double exponentOf(const std::vector<std::array<double, 2>>& points) {
  double n = 0, x = 0, y = 0, xx = 0, xy = 0;
  for (const auto& [a, b] : points) {
    const double u = std::log(a), v = std::log(b);
    n += 1;
    x += u;
    y += v;
    xx += u * u;
    xy += u * v;
  }
  return (n * xy - x * y) / (n * xx - x * x);
}

}  // namespace

ReportItems timePart(ReportContext& report_context) {
  ReportItem report_item;
  report_item.id = "figure-16";
  report_item.title = "Figure 16. Time against the mesh's detail and its triangles";
  report_item.printed = {
      "“Time vs. mesh detail (LD, represented by sampling density) and number of triangles for the cave example shown "
      "in "
      "Figure 18.”",
      "“All simulations were performed on nVidia GeForce GTX 460M GPU, i7-2630QM CPU and 12 GB RAM.”"};
  const StageModel& cave = stageModels()[0];
  const Result<std::vector<BackendRun>> backend_runs =
      makeBackendRuns({report_context.options().backend == "auto" ? "cpu" : report_context.options().backend},
                      report_context.options().threads);
  if (!backend_runs) return backend_runs.error();
  const std::vector<int32_t> sizes =
      report_context.pick(std::vector{16, 32, 64, 128, 256}, std::vector{16, 32, 64, 128});
  const auto runs = report_context.pick<uint64_t>(7, 3);
  std::vector<std::vector<std::string>> rows{{"LD", "cell, m", "triangles"}};
  std::vector<Series> by_density, by_triangles;
  for (const BackendRun& backend_run : *backend_runs) {
    if (!backend_run.backend) continue;
    const std::string name = fmt::format("{}, {}", backend_run.name,
                                         backend_run.workers == 1   ? "1 worker"
                                         : backend_run.workers == 0 ? "a device"
                                                                    : fmt::format("{} workers", backend_run.workers));
    by_density.push_back({name, {}, Series::Style::line});
    by_triangles.push_back({name, {}, Series::Style::line});
    rows[0].push_back(name + ", ms");
  }
  Json points = Json::array();
  ProgressBar bar(report_context.doing());
  uint64_t done = 0;
  for (const int32_t size : sizes) {
    const int32_t cell = cave.edge * kUnitsPerMetre / size;
    const Result<StageResult> result = measureStage(
        cave, cell, runs, *backend_runs, [&] { bar.show(++done, sizes.size() * (runs + 1) * by_density.size()); });
    if (!result) return result.error();
    const double density = 1 / metres(cell);
    std::vector<std::string>& row = rows.emplace_back(std::vector<std::string>{
        shortNumber(density), shortNumber(metres(cell)), fmt::format("{}", result->triangles)});
    size_t s = 0;
    for (const StageRow& of : result->rows) {
      if (!of.measured()) continue;
      by_density[s].points.push_back({density, 1000 * of.median()});
      by_triangles[s].points.push_back({static_cast<double>(result->triangles), 1000 * of.median()});
      row.push_back(fmt::format("{:.2f}", 1000 * of.median()));
      points.push_back(
          {{"ld", density}, {"triangles", result->triangles}, {"name", of.name}, {"seconds", of.median()}});
      ++s;
    }
  }
  LineChart density, triangles;
  density.title = "Time to mesh a cave over the density of the mesh";
  density.x = {"LD, cells per metre", true, false, {}, {}};
  triangles.title = "Time to mesh a cave over the number of its triangles";
  triangles.x = {"triangles", true, false, {}, {}};
  for (const int32_t size : sizes) density.x.marks.push_back(static_cast<double>(size) / cave.edge);
  for (LineChart* chart : {&density, &triangles}) {
    chart->y = {"time, ms", true, false, {}, {}};
    chart->width = 460;
    chart->height = 340;
  }
  const double by_ld = exponentOf(by_density[0].points), by_count = exponentOf(by_triangles[0].points);
  density.series = by_density;
  triangles.series = by_triangles;
  report_item.ours =
      ReportContext::row(drawn(density) + drawn(triangles)) + table("64 m of the cave", rows) +
      element(
          "p",
          fmt::format(
              "With one worker, the time grows with the power {:.2f} of LD and {:.2f} of the number of triangles. The "
              "number of samples grows with the third power of LD; but space that is proven to be all rock or all void "
              "is never sampled, so that the cost is that of the surface, which grows with the second power.",
              by_ld, by_count));
  report_item.measured = fmt::format(
      "Medians of {} warm runs from derived cells to packed meshes, {} m of cave.sgm with seed {}; all runs made "
      "meshes of the same hash. The cave of figure 18 is not in the paper.",
      runs, cave.edge, cave.seed);
  report_item.commands = {commandOfPart(report_context.options(), "time")};
  report_item.numbers = {
      {"runs", runs}, {"points", std::move(points)}, {"exponent_ld", by_ld}, {"exponent_triangles", by_count}};
  return std::vector<ReportItem>{std::move(report_item)};
}

}  // namespace sgm::cli
