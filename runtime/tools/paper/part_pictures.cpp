// Figures 7, 8 and 9: clouds, caves that morph from cubic to spherical, and architecture.

#include <fmt/core.h>

#include <array>
#include <cmath>
#include <numbers>

#include "tools/cli/measure/commands.h"
#include "tools/paper/chart.h"
#include "tools/paper/command_line.h"
#include "tools/paper/parts.h"
#include "tools/paper/workshop.h"
#include "tools/support/render_options.h"

namespace sgm::cli {

Exhibits cloudPart(Workshop& workshop) {
  Exhibit exhibit;
  exhibit.id = "figure-7";
  exhibit.title = "Figure 7. A cloud as a surface, as a mesh and as fog";
  exhibit.printed = {
      "“The obtained cloud structure: left - image render with lambert material, middle - 3D mesh of the cloud shape, "
      "right - image render with volumetric shader.”",
      "“… the summing-up of many spheres of different radius. The resulting cloud structure resembles a blob.”"};
  RenderOptions options = workshop.on<RenderOptions>("cloud.sgm");
  options.seed = 3;
  options.region = "0,768,0:900,1668,900";
  options.camera = "977,1187,965:440,1366,332";
  options.fov = 46;
  options.size = workshop.pick("640x560", "400x350");
  Markup row;
  struct Panel {
    const char *name, *caption, *alt;
    double cell;
    bool wires, volume;
  };
  const double cell = workshop.pick(4.0, 8.0);
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
    const Result<Markup> picture = workshop.picture(view, panel.name, panel.alt, panel.caption, exhibit.commands);
    if (!picture) return picture.error();
    row += *picture;
  }
  WorldOptions measured = workshop.on("cloud.sgm");
  measured.seed = options.seed;
  measured.region = options.region;
  measured.cell = 16;
  const Result<Region> region = workshop.mesh(measured);
  if (!region) return region.error();
  exhibit.commands.push_back(commandOf("mesh", measured));
  const uint64_t triangles = region->meshed.mesh.indices.size() / 3;
  exhibit.ours = Workshop::row(row) +
                 element("p", fmt::format("The mesh in the middle has {} triangles. All three pictures come from one "
                                          "field, a sum of blobs on blobs displaced by noise: the fog is a function of "
                                          "the same samples from which the surface is extracted.",
                                          triangles));
  exhibit.measured = "All three have the same camera; seed 3 of the sample grammar cloud.sgm.";
  exhibit.numbers = {{"triangles", triangles}, {"cell", 16.0}};
  return std::vector<Exhibit>{std::move(exhibit)};
}

namespace {

/// Volume and area of the hall for one value t of the morph parameter.
struct Morphed {
  double t = 0, volume = 0, area = 0;
};

Result<std::vector<Morphed>> morphSeries(Workshop& workshop, bool power, std::vector<std::string>& commands) {
  std::vector<Morphed> series;
  const int steps = workshop.pick(16, 8);
  for (int i = 0; i <= steps; ++i) {
    Morphed& at = series.emplace_back();
    at.t = static_cast<double>(i) / steps;
    MeasureOptions options = workshop.on<MeasureOptions>("paper/hall.sgm");
    options.cell = workshop.pick(0.125, 0.25);
    options.sets = {fmt::format("round={}", at.t), fmt::format("power={}", power ? 1 : 0)};
    options.no_self_intersections = true;
    const Result<measure::MeshMeasures> measured = workshop.measure(options);
    if (!measured) return measured.error();
    at.volume = measured->sums.volume;
    at.area = measured->sums.area;
    if (2 * i == steps) commands.push_back(commandOf(options));
  }
  return series;
}

}  // namespace

Exhibits cavePart(Workshop& workshop) {
  Exhibit exhibit;
  exhibit.id = "figure-8";
  exhibit.title = "Figure 8. Caves from cubic to spherical";
  exhibit.printed = {"“The obtained cave structures. Left – cubic, middle – various, right spheric.”",
                     "“It is possible to obtain results from cubical to spherical topology tunnels structures based on "
                     "the morphing parameter.”"};
  RenderOptions options = workshop.on<RenderOptions>("tunnels.sgm");
  options.cell = workshop.pick(0.125, 0.25);
  options.fov = 40;
  options.size = workshop.pick("560x560", "360x360");
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
    const Result<Markup> picture = workshop.picture(view, panel.name, panel.alt, panel.caption, exhibit.commands);
    if (!picture) return picture.error();
    row += *picture;
  }
  Markup whole;
  options.camera = "-14,20,72:-2.5,-1,-6";
  options.fov = 26;
  options.size = workshop.pick("1120x400", "720x260");
  const Result<Markup> all =
      workshop.picture(options, "cave-row", "A block of rock with five tunnels, the left square, the right round",
                       "All in one block: the parameter goes from 0 on the left to 1 on the right.", exhibit.commands);
  if (!all) return all.error();

  const Result<std::vector<Morphed>> linear = morphSeries(workshop, false, exhibit.commands);
  if (!linear) return linear.error();
  const Result<std::vector<Morphed>> power = morphSeries(workshop, true, exhibit.commands);
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
  exhibit.ours = Workshop::row(row) + *all + element("h3", "The morph in numbers") + drawn(chart) +
                 element("p", fmt::format("The hall alone, in steps of the parameter: from {:.1f} m³ (the cube of 11 m "
                                          "has {:.1f}; the mesh rounds its edges off) to {:.1f} m³ (the ball in it has "
                                          "{:.1f}). Both ways of morphing are monotone, and neither leaves the cube.",
                                          linear->front().volume, cube, linear->back().volume, ball));
  exhibit.measured = fmt::format("Volumes by the divergence theorem, cells of {} m.", workshop.pick(0.125, 0.25));
  exhibit.numbers = {{"cube", cube}, {"ball", ball}, {"series", std::move(points)}};
  return std::vector<Exhibit>{std::move(exhibit)};
}

Exhibits architecturePart(Workshop& workshop) {
  Exhibit exhibit;
  exhibit.id = "figure-9";
  exhibit.title = "Figure 9. Architecture of several widths, heights and convexities";
  exhibit.printed = {
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
    RenderOptions options = workshop.on<RenderOptions>("building.sgm");
    options.density = workshop.pick(10.0, 5.0);
    options.seed = house.seed;
    options.sets.assign(std::begin(house.sets), std::end(house.sets));
    options.fov = 40;
    options.size = workshop.pick("480x480", "320x320");
    const Result<Markup> picture = workshop.picture(
        options, house.name, "A house with balconies: " + std::string(house.caption), house.caption, exhibit.commands);
    if (!picture) return picture.error();
    row += *picture;
    MeasureOptions measured = workshop.on<MeasureOptions>("building.sgm");
    measured.density = options.density;
    measured.seed = options.seed;
    measured.sets = options.sets;
    measured.no_self_intersections = true;
    const Result<measure::MeshMeasures> m = workshop.measure(measured);
    if (!m) return m.error();
    exhibit.commands.push_back(commandOf(measured));
    rows.push_back({house.caption, fmt::format("{}", house.seed), fmt::format("{}", m->triangles),
                    fmt::format("{:.1f}", m->sums.area), fmt::format("{:.1f}", m->sums.volume)});
    houses.push_back({{"sets", options.sets},
                      {"seed", house.seed},
                      {"triangles", m->triangles},
                      {"area", m->sums.area},
                      {"volume", m->sums.volume},
                      {"watertight", m->watertight()}});
  }
  exhibit.ours = Workshop::row(row) + table("The same houses, measured", rows);
  exhibit.measured = fmt::format(
      "The grammar building.sgm, LD = {}{}: cells of {} m. Convexity morphs the walls of storeys from boxes to "
      "superquadrics.",
      workshop.pick(10, 5), workshop.pick("", " instead of the paper's 10, to be quick"), workshop.pick(0.1, 0.2));
  exhibit.numbers = {{"ld", workshop.pick(10.0, 5.0)}, {"houses", std::move(houses)}};
  return std::vector<Exhibit>{std::move(exhibit)};
}

}  // namespace sgm::cli
