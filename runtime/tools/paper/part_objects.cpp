// Figure 12: separate objects in buildings, caves and clouds, and a cloud with ten of them.

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <optional>

#include "region/measure.h"
#include "tools/paper/chart.h"
#include "tools/paper/command_line.h"
#include "tools/paper/parts.h"
#include "tools/paper/workshop.h"
#include "tools/support/render_options.h"

namespace sgm::cli {
namespace {

constexpr uint64_t kWanted = 10;      // the paper: "10 separate elements"
constexpr uint64_t kMostClouds = 64;  // maximum number of clouds that are searched

Result<uint64_t> objectsOf(Workshop& workshop, const WorldOptions& options) {
  const Result<Region> region = workshop.mesh(options);
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

/// A scattered cloud with ten separate objects. Seeds are searched in order, from the seed of the report on.
Result<std::optional<RenderOptions>> cloudOfTen(Workshop& workshop) {
  RenderOptions options = workshop.on<RenderOptions>("paper/scattered.sgm");
  options.cell = workshop.pick(4.0, 8.0);
  for (uint64_t i = 0; i < kMostClouds; ++i) {
    options.seed = workshop.options().seed + i;
    const Result<uint64_t> objects = objectsOf(workshop, options);
    if (!objects) return objects.error();
    if (*objects == kWanted) return std::optional(options);
  }
  return std::optional<RenderOptions>();
}

}  // namespace

Exhibits objectsPart(Workshop& workshop) {
  Exhibit exhibit;
  exhibit.id = "figure-12";
  exhibit.title = "Figure 12. Independent objects";
  exhibit.printed = {
      "“Left - independent model objects for: architecture, caves and clouds. Right - example of the distributed cloud "
      "with 10 separate elements.”",
      "“It is most likely that a single type of object exists mostly in the case of architecture modelling, secondary "
      "for the caves and the least likely in the case of clouds modelling.”"};
  const auto models = workshop.pick<uint64_t>(24, 8);
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
      WorldOptions options = workshop.on(kind.grammar);
      options.region = kind.region;
      options.cell = kind.cell;
      options.sets = {kind.set};
      options.seed = workshop.options().seed + i;
      const Result<uint64_t> objects = objectsOf(workshop, options);
      if (!objects) return objects.error();
      counts.push_back(*objects);
      if (i == 0) exhibit.commands.push_back(commandOf("mesh", options));
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
  exhibit.ours = Workshop::row(drawn(single) + drawn(mean)) + table("Independent objects of models by seed", rows);

  const Result<std::optional<RenderOptions>> cloud = cloudOfTen(workshop);
  if (!cloud) return cloud.error();
  if (*cloud) {
    RenderOptions options = **cloud;
    options.camera = "120,-150,820:0,20,0";
    options.fov = 34;
    options.size = workshop.pick("1120x560", "720x360");
    const Result<Markup> picture = workshop.picture(
        options, "cloud-of-ten", "A scattered cloud of ten separate parts",
        fmt::format(
            "As in the paper on the right: a distributed cloud of {} separate objects, seed {} of scattered.sgm.",
            kWanted, options.seed),
        exhibit.commands);
    if (!picture) return picture.error();
    exhibit.ours += *picture;
  } else {
    exhibit.ours += element("p", fmt::format("None of {} clouds had {} objects.", kMostClouds, kWanted));
  }
  exhibit.measured = fmt::format(
      "Section 7.3: triangles that share a vertex are one object. Exact keys of vertices and union-find replace the "
      "paper's quadratic search. {} models of each kind, with seeds from {} on: whole buildings, cubes of 192 m of an "
      "endless cave, and 2.3 km of sky. If a region cuts a passage or a cloud, its parts are separate objects, so that "
      "caves and clouds have more objects than they would have as a whole.",
      models, workshop.options().seed);
  exhibit.commands.push_back(commandOfPart(workshop.options(), "objects"));
  exhibit.numbers = {
      {"models", models}, {"kinds", std::move(kinds)}, {"cloud_of_ten_seed", *cloud ? Json((*cloud)->seed) : Json()}};
  return std::vector<Exhibit>{std::move(exhibit)};
}

}  // namespace sgm::cli
