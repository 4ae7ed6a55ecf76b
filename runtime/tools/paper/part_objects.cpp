// Figure 12: numbers of separate objects in buildings, caves and clouds, and a cloud with ten separate objects.

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <optional>

#include "region/measure.h"
#include "tools/paper/chart.h"
#include "tools/paper/command_line.h"
#include "tools/paper/parts.h"
#include "tools/paper/report_context.h"
#include "tools/support/render_options.h"

namespace sgm::cli {
namespace {

constexpr uint64_t kWanted = 10;     // number of objects of the cloud in the paper: "10 separate elements"
constexpr uint64_t kMaxClouds = 64;  // maximum number of seeds that are tried to find a cloud with kWanted objects

Result<uint64_t> objectsOf(ReportContext& report_context, const WorldOptions& options) {
  const Result<Region> region = report_context.mesh(options);
  if (!region) return region.error();
  return measuresOf(region->meshed.mesh).objects;
}

struct Kind {
  const char* name;
  const char* grammar;
  const char* region;
  double cell;
  const char* set;
};
constexpr Kind kKinds[] = {{"architecture", "building.sgm", "", 0.25, "balconies=30%"},
                           {"caves", "cave.sgm", "0,0,0:192,192,192", 1.5, "boxy=0.3"},
                           {"clouds", "cloud.sgm", "0,768,0:2304,1536,2304", 24, "cover=80%"}};

/// Searches for a scattered cloud with ten separate objects. Tries seeds in order, from the seed of the report on;
/// nullopt if none is found.
Result<std::optional<RenderOptions>> cloudOfTen(ReportContext& report_context) {
  RenderOptions options = report_context.on<RenderOptions>("paper/scattered.sgm");
  options.cell = report_context.pick(4.0, 8.0);
  for (uint64_t i = 0; i < kMaxClouds; ++i) {
    options.seed = report_context.options().seed + i;
    const Result<uint64_t> objects = objectsOf(report_context, options);
    if (!objects) return objects.error();
    if (*objects == kWanted) return std::optional(options);
  }
  return std::optional<RenderOptions>();
}

}  // namespace

ReportItems objectsPart(ReportContext& report_context) {
  ReportItem report_item;
  report_item.id = "figure-12";
  report_item.title = "Figure 12. Independent objects";
  report_item.printed = {
      "“Left - independent model objects for: architecture, caves and clouds. Right - example of the distributed cloud "
      "with 10 separate elements.”",
      "“It is most likely that a single type of object exists mostly in the case of architecture modelling, secondary "
      "for the caves and the least likely in the case of clouds modelling.”"};
  const auto models = report_context.pick<uint64_t>(24, 8);
  BarChart single, mean;
  single.title = "Share of models that are one object, by kind";
  single.y.title = "models that are one object, %";
  single.width = mean.width = 420;
  mean.title = "Mean number of independent objects per model, by kind";
  mean.y.title = "objects per model, mean";
  BarChart::Bars shares{"share", {}}, means{"mean", {}};
  std::vector<std::vector<std::string>> rows{{"Kind", "models", "one object", "fewest", "median", "most"}};
  Json kinds = Json::array();
  for (const Kind& kind : kKinds) {
    std::vector<uint64_t> counts;
    for (uint64_t i = 0; i < models; ++i) {
      WorldOptions options = report_context.on(kind.grammar);
      options.region = kind.region;
      options.cell = kind.cell;
      options.sets = {kind.set};
      options.seed = report_context.options().seed + i;
      const Result<uint64_t> objects = objectsOf(report_context, options);
      if (!objects) return objects.error();
      counts.push_back(*objects);
      if (i == 0) report_item.commands.push_back(commandOf("mesh", options));
    }
    kinds.push_back({{"kind", kind.name}, {"objects", counts}});
    std::ranges::sort(counts);
    double sum = 0;
    for (const uint64_t count : counts) sum += static_cast<double>(count);
    const auto one = static_cast<double>(std::ranges::count(counts, 1u));
    single.groups.emplace_back(kind.name);
    mean.groups.emplace_back(kind.name);
    shares.values.push_back(100 * one / static_cast<double>(models));
    means.values.push_back(sum / static_cast<double>(models));
    rows.push_back({kind.name, fmt::format("{}", models), fmt::format("{:.0f} %", shares.values.back()),
                    fmt::format("{}", counts.front()), fmt::format("{}", counts[counts.size() / 2]),
                    fmt::format("{}", counts.back())});
  }
  single.series = {shares};
  mean.series = {means};
  report_item.ours =
      ReportContext::row(drawn(single) + drawn(mean)) + table("Independent objects of models by seed", rows);

  const Result<std::optional<RenderOptions>> cloud = cloudOfTen(report_context);
  if (!cloud) return cloud.error();
  if (*cloud) {
    RenderOptions options = **cloud;
    options.camera = "120,-150,820:0,20,0";
    options.fov = 34;
    options.size = report_context.pick("1120x560", "720x360");
    const Result<Markup> picture = report_context.picture(
        options, "cloud-of-ten", "A scattered cloud of ten separate parts",
        fmt::format(
            "As in the paper on the right: a distributed cloud of {} separate objects, seed {} of scattered.sgm.",
            kWanted, options.seed),
        report_item.commands);
    if (!picture) return picture.error();
    report_item.ours += *picture;
  } else {
    report_item.ours += element("p", fmt::format("None of {} clouds had {} objects.", kMaxClouds, kWanted));
  }
  report_item.measured = fmt::format(
      "Section 7.3: triangles that share a vertex are one object. Exact keys of vertices and union-find replace the "
      "paper's quadratic search. {} models of each kind, with seeds from {} on: whole buildings, cubes of 192 m of an "
      "endless cave, and 2.3 km of sky. If a region cuts a passage or a cloud, its parts are separate objects, so that "
      "caves and clouds have more objects than they would have as a whole.",
      models, report_context.options().seed);
  report_item.commands.push_back(commandOfPart(report_context.options(), "objects"));
  report_item.numbers = {
      {"models", models}, {"kinds", std::move(kinds)}, {"cloud_of_ten_seed", *cloud ? Json((*cloud)->seed) : Json()}};
  return std::vector<ReportItem>{std::move(report_item)};
}

}  // namespace sgm::cli
