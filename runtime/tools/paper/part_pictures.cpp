// Figures 7, 8 and 9: clouds, caves that morph from cubic to spherical, and architecture.

#include <fmt/core.h>

#include <array>
#include <cmath>
#include <numbers>

#include "tools/cli/measure/commands.h"
#include "tools/paper/chart.h"
#include "tools/paper/command_line.h"
#include "tools/paper/parts.h"
#include "tools/paper/report_context.h"
#include "tools/support/render_options.h"

namespace sgm::cli {

ReportItems cloudPart(ReportContext& report_context) {
  ReportItem report_item;
  report_item.id = "figure-7";
  report_item.title = "Figure 7. A cloud as a surface, as a mesh and as fog";
  report_item.printed = {
      "“The obtained cloud structure: left - image render with lambert material, middle - 3D mesh of the cloud shape, "
      "right - image render with volumetric shader.”",
      "“… the summing-up of many spheres of different radius. The resulting cloud structure resembles a blob.”"};
  RenderOptions options = report_context.on<RenderOptions>("cloud.sgm");
  options.seed = 3;
  options.region = "0,768,0:900,1668,900";
  options.camera = "977,1187,965:440,1366,332";
  options.fov = 46;
  options.size = report_context.pick("640x560", "400x350");
  Markup row;
  struct Panel {
    const char *name, *caption, *alt;
    double cell;
    bool wires, volume;
  };
  const double cell = report_context.pick(4.0, 8.0);
  for (const Panel& panel : {Panel{"cloud-surface", "Left: its surface, lit.",
                                   "A cumulus as a white surface under a blue sky", cell, false, false},
                             Panel{"cloud-mesh", "Middle: its mesh, with cells of 16 m.",
                                   "The same cumulus as a mesh whose triangles are visible", 16, true, false},
                             Panel{"cloud-fog", "Right: its density as fog, with scattered light.",
                                   "The same cumulus as soft fog", cell, false, true}}) {
    RenderOptions view = options;
    view.cell = panel.cell;
    view.wires = panel.wires;
    view.volume = panel.volume;
    const Result<Markup> picture =
        report_context.picture(view, panel.name, panel.alt, panel.caption, report_item.commands);
    if (!picture) return picture.error();
    row += *picture;
  }
  WorldOptions measured = report_context.on("cloud.sgm");
  measured.seed = options.seed;
  measured.region = options.region;
  measured.cell = 16;
  const Result<Region> region = report_context.mesh(measured);
  if (!region) return region.error();
  report_item.commands.push_back(commandOf("mesh", measured));
  const uint64_t triangles = region->meshed.mesh.indices.size() / 3;
  report_item.ours =
      ReportContext::row(row) +
      element("p", fmt::format("The mesh in the middle has {} triangles. All three pictures come from one "
                               "field, a sum of blobs on blobs displaced by noise: the fog is a function of "
                               "the same samples from which the surface is extracted.",
                               triangles));
  report_item.measured = "All three have the same camera; seed 3 of the sample grammar cloud.sgm.";
  report_item.numbers = {{"triangles", triangles}, {"cell", 16.0}};
  return std::vector<ReportItem>{std::move(report_item)};
}

namespace {

/// Volume and area of the hall for one value of the morph parameter t (0..1).
struct Morphed {
  double t = 0, volume = 0, area = 0;
};

Result<std::vector<Morphed>> morphSeries(ReportContext& report_context, bool power,
                                         std::vector<std::string>& commands) {
  std::vector<Morphed> series;
  const int steps = report_context.pick(16, 8);
  for (int i = 0; i <= steps; ++i) {
    Morphed& at = series.emplace_back();
    at.t = static_cast<double>(i) / steps;
    MeasureOptions options = report_context.on<MeasureOptions>("paper/hall.sgm");
    options.cell = report_context.pick(0.125, 0.25);
    options.sets = {fmt::format("round={}", at.t), fmt::format("power={}", power ? 1 : 0)};
    options.no_self_intersections = true;
    const Result<measure::MeshMeasures> measured = report_context.measure(options);
    if (!measured) return measured.error();
    at.volume = measured->sums.volume;
    at.area = measured->sums.area;
    if (2 * i == steps) commands.push_back(commandOf(options));
  }
  return series;
}

}  // namespace

ReportItems cavePart(ReportContext& report_context) {
  ReportItem report_item;
  report_item.id = "figure-8";
  report_item.title = "Figure 8. Caves from cubic to spherical";
  report_item.printed = {
      "“The obtained cave structures. Left – cubic, middle – various, right spheric.”",
      "“It is possible to obtain results from cubical to spherical topology tunnels structures based on "
      "the morphing parameter.”"};
  RenderOptions options = report_context.on<RenderOptions>("tunnels.sgm");
  options.cell = report_context.pick(0.125, 0.25);
  options.fov = 40;
  options.size = report_context.pick("560x560", "360x360");
  Markup row;
  struct Panel {
    const char *name, *caption, *alt;
    int x;
  };
  for (const Panel& panel : {Panel{"cave-cubic", "Left: cubic, parameter 0.", "A square hall and passage in rock", -32},
                             Panel{"cave-various", "Middle: various, here 0.5.", "A hall between square and round", 0},
                             Panel{"cave-spheric", "Right: spheric, 1.", "A round hall and passage in rock", 32}}) {
    RenderOptions view = options;
    view.camera = fmt::format("{},4,19:{},-0.6,-6", panel.x + 3, panel.x);
    const Result<Markup> picture =
        report_context.picture(view, panel.name, panel.alt, panel.caption, report_item.commands);
    if (!picture) return picture.error();
    row += *picture;
  }
  Markup whole;
  options.camera = "-14,20,72:-2.5,-1,-6";
  options.fov = 26;
  options.size = report_context.pick("1120x400", "720x260");
  const Result<Markup> all = report_context.picture(
      options, "cave-row", "A block of rock with five tunnels, the left square, the right round",
      "All in one block: the parameter goes from 0 on the left to 1 on the right.", report_item.commands);
  if (!all) return all.error();

  const Result<std::vector<Morphed>> linear = morphSeries(report_context, false, report_item.commands);
  if (!linear) return linear.error();
  const Result<std::vector<Morphed>> power = morphSeries(report_context, true, report_item.commands);
  if (!power) return power.error();
  LineChart chart;
  chart.title = "Volume of the hall over the morph's parameter, from the cube's to the ball's, linear and by exponent";
  chart.x.title = "morphing parameter";
  chart.y.title = "volume, m³";
  const double cube = 11.0 * 11 * 11, ball = 4 * std::numbers::pi / 3 * 5.5 * 5.5 * 5.5;
  Json points = Json::array();
  for (const auto& [name, series] : {std::pair{"linear", &*linear}, std::pair{"by exponent", &*power}}) {
    Series line{name, {}, Series::Style::line};
    for (const Morphed& at : *series) {
      line.points.push_back({at.t, at.volume});
      points.push_back({{"morph", name}, {"t", at.t}, {"volume", at.volume}, {"area", at.area}});
    }
    chart.series.push_back(std::move(line));
  }
  chart.series.push_back({"the cube's", {{0, cube}, {1, cube}}, Series::Style::dashed});
  chart.series.push_back({"the ball's", {{0, ball}, {1, ball}}, Series::Style::dashed});
  report_item.ours =
      ReportContext::row(row) + *all + element("h3", "The morph in numbers") + drawn(chart) +
      element("p", fmt::format("The hall alone, in steps of the parameter: from {:.1f} m³ (the cube of 11 m "
                               "has {:.1f}; the mesh rounds its edges off) to {:.1f} m³ (the ball in it has "
                               "{:.1f}). Both ways of morphing are monotone, and neither leaves the cube.",
                               linear->front().volume, cube, linear->back().volume, ball));
  report_item.measured =
      fmt::format("Volumes by the divergence theorem, cells of {} m.", report_context.pick(0.125, 0.25));
  report_item.numbers = {{"cube", cube}, {"ball", ball}, {"series", std::move(points)}};
  return std::vector<ReportItem>{std::move(report_item)};
}

ReportItems architecturePart(ReportContext& report_context) {
  ReportItem report_item;
  report_item.id = "figure-9";
  report_item.title = "Figure 9. Architecture of several widths, heights and convexities";
  report_item.printed = {
      "“The obtained structures of various architecture objects types for LD = 10 and various settings for width, "
      "height "
      "and convexity for floors.”"};
  struct House {
    const char *name, *sets[3], *caption;
    uint64_t seed;
  };
  constexpr House kHouses[] = {
      {"house-plain", {"width=9", "height=3.2", "convex=0"}, "9 m wide, storeys of 3.2 m, convexity 0.", 0},
      {"house-wide", {"width=14", "height=3", "convex=0"}, "14 m wide, storeys of 3 m, convexity 0.", 2},
      {"house-high", {"width=8", "height=4.8", "convex=0"}, "8 m wide, storeys of 4.8 m, convexity 0.", 3},
      {"house-soft", {"width=11", "height=3.2", "convex=0.35"}, "11 m wide, convexity 0.35.", 4},
      {"house-convex", {"width=11", "height=3.2", "convex=0.7"}, "11 m wide, convexity 0.7.", 4},
      {"house-cushions", {"width=13", "height=4", "convex=1"}, "13 m wide, storeys of 4 m, convexity 1.", 6},
  };
  std::vector<std::vector<std::string>> rows{{"House", "Seed", "Triangles", "Area, m²", "Volume, m³"}};
  Json houses = Json::array();
  Markup row;
  for (const House& house : kHouses) {
    RenderOptions options = report_context.on<RenderOptions>("building.sgm");
    options.density = report_context.pick(10.0, 5.0);
    options.seed = house.seed;
    options.sets.assign(std::begin(house.sets), std::end(house.sets));
    options.fov = 40;
    options.size = report_context.pick("480x480", "320x320");
    const Result<Markup> picture =
        report_context.picture(options, house.name, "A house with balconies: " + std::string(house.caption),
                               house.caption, report_item.commands);
    if (!picture) return picture.error();
    row += *picture;
    MeasureOptions measured = report_context.on<MeasureOptions>("building.sgm");
    measured.density = options.density;
    measured.seed = options.seed;
    measured.sets = options.sets;
    measured.no_self_intersections = true;
    const Result<measure::MeshMeasures> m = report_context.measure(measured);
    if (!m) return m.error();
    report_item.commands.push_back(commandOf(measured));
    rows.push_back({house.caption, fmt::format("{}", house.seed), fmt::format("{}", m->triangles),
                    fmt::format("{:.1f}", m->sums.area), fmt::format("{:.1f}", m->sums.volume)});
    houses.push_back({{"sets", options.sets},
                      {"seed", house.seed},
                      {"triangles", m->triangles},
                      {"area", m->sums.area},
                      {"volume", m->sums.volume},
                      {"watertight", m->watertight()}});
  }
  report_item.ours = ReportContext::row(row) + table("The same houses, measured", rows);
  report_item.measured = fmt::format(
      "The grammar building.sgm, LD = {}{}: cells of {} m. Convexity morphs the walls of storeys from boxes to "
      "superquadrics.",
      report_context.pick(10, 5), report_context.pick("", " instead of the paper's 10, to be quick"),
      report_context.pick(0.1, 0.2));
  report_item.numbers = {{"ld", report_context.pick(10.0, 5.0)}, {"houses", std::move(houses)}};
  return std::vector<ReportItem>{std::move(report_item)};
}

}  // namespace sgm::cli
