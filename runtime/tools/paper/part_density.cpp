// Figures 10 and 11: area and volume as functions of the mesh's density, and their convergence.

#include <fmt/core.h>

#include <cmath>
#include <numbers>
#include <optional>

#include "region/measure.h"
#include "tools/cli/measure/commands.h"
#include "tools/paper/chart.h"
#include "tools/paper/command_line.h"
#include "tools/paper/parts.h"
#include "tools/paper/report_context.h"
#include "tools/support/measured_mesh.h"

namespace sgm::cli {
namespace {

/// A model that is meshed at several densities, each twice the previous density.
struct Model {
  const char *name, *grammar;
  uint64_t seed;
  const char* region;  ///< region in the form of --region; empty: the whole finite world
  double coarsest;     ///< edge of the grid cells at the lowest density, metres
  std::vector<std::string> sets{};
};

struct Sample {
  double cell = 0, area = 0, volume = 0;
};

struct Sampled {
  const Model* model = nullptr;
  std::vector<Sample> samples;  ///< one sample for each density, the coarsest first; each has half the cell size of
                                ///< the previous one
};

Result<Sampled> sample(ReportContext& report_context, const Model& model, int steps,
                       std::vector<std::string>& commands) {
  Sampled sampled{&model, {}};
  for (int i = 0; i < steps; ++i) {
    WorldOptions options = report_context.on(model.grammar);
    options.seed = model.seed;
    options.region = model.region;
    options.sets = model.sets;
    options.cell = model.coarsest / (1 << i);
    const Result<Region> region = report_context.mesh(options);
    if (!region) return region.error();
    sampled.samples.push_back(
        {*options.cell, measuresOf(region->meshed.mesh).area, cubeVolume(region->meshed.solid_samples, region->cell)});
    if (i + 1 == steps) commands.push_back(commandOf("mesh", options));
  }
  return sampled;
}

/// The observed order of convergence: log2 of the ratio of the last two changes of a value. The order is 2 for
/// quadratic convergence in the cell size, and 0 for logarithmic growth, whose changes are equal. nullopt if a change
/// is 0, or the two changes differ in sign.
std::optional<double> observedOrder(std::span<const double> values) {
  if (values.size() < 3) return std::nullopt;
  const double a = values[values.size() - 3], b = values[values.size() - 2], c = values.back();
  const double ratio = (b - a) / (c - b);
  if (!std::isfinite(ratio) || ratio <= 0) return std::nullopt;
  return std::log2(ratio);
}

std::string orderText(const std::optional<double>& order) {
  return order ? fmt::format("{:.2f}", *order) : "none: the values rise and fall";
}

Json orNull(const std::optional<double>& value) { return value ? Json(*value) : Json(nullptr); }

std::vector<double> valuesOf(const Sampled& sampled, double Sample::*of) {
  std::vector<double> values;
  for (const Sample& s : sampled.samples) values.push_back(s.*of);
  return values;
}

/// Adds one measure of all models to the report item: as a chart, a table and numbers. of: the member that contains the
/// measure.
void compare(const std::vector<Sampled>& all, double Sample::*of, const std::string& what, const std::string& unit,
             ReportItem& report_item) {
  LineChart chart;
  chart.title = fmt::format("{} against the density of the mesh, as a share of the value at the finest", what);
  chart.x = {"LD, as a multiple of the coarsest", true, false, {}, {}};
  chart.y.title = fmt::format("{}, % of the finest", what);
  const std::vector<Sample>& any = all.front().samples;
  for (size_t i = 0; i < any.size(); ++i) chart.x.marks.push_back(static_cast<double>(1 << i));
  std::vector<std::vector<std::string>> rows{{what + ", " + unit}};
  for (size_t i = 0; i < any.size(); ++i) rows[0].push_back(i == 0 ? "coarsest" : fmt::format("LD times {}", 1 << i));
  rows[0].emplace_back("last change");
  rows[0].emplace_back("observed order");
  Json models = Json::array();
  for (const Sampled& sampled : all) {
    const std::vector<double> values = valuesOf(sampled, of);
    Series series{sampled.model->name, {}, Series::Style::line};
    std::vector<std::string> row{fmt::format("{}, LD {} to {}", sampled.model->name,
                                             shortNumber(1 / sampled.samples.front().cell, 3),
                                             shortNumber(1 / sampled.samples.back().cell, 3))};
    for (size_t i = 0; i < values.size(); ++i) {
      series.points.push_back({static_cast<double>(1 << i), 100 * values[i] / values.back()});
      row.push_back(shortNumber(values[i], 6));
    }
    const std::optional<double> order = observedOrder(values);
    const double change = values.back() / values[values.size() - 2] - 1;
    row.push_back(fmt::format("{:+.2f} %", 100 * change));
    row.push_back(orderText(order));
    rows.push_back(std::move(row));
    chart.series.push_back(std::move(series));
    models.push_back({{"model", sampled.model->name},
                      {"coarsest_cell", sampled.samples.front().cell},
                      {"values", values},
                      {"order", orNull(order)}});
  }
  report_item.ours +=
      drawn(chart) + table(
                         "Each column halves the edge of the cells. A logarithm would have equal changes "
                         "(order 0); a limit approached with the square of the cell's edge has order 2",
                         rows);
  report_item.numbers["models"] = std::move(models);
}

/// Errors of the measures of a ball with a radius of 5 m, whose exact area and volume are known.
struct BallErrors {
  /// cell: edge of a grid cell, metres. The other members are relative errors. area, volume: errors of the mesh. all,
  /// any, centre: errors of the volume that is found by counting the cubes with all corners, any corner, or the centre
  /// inside the ball.
  double cell = 0, area = 0, volume = 0, all = 0, any = 0, centre = 0;
};

Result<std::vector<BallErrors>> ballErrors(ReportContext& report_context, std::vector<std::string>& commands) {
  constexpr double kArea = 4 * std::numbers::pi * 25, kVolume = kArea * 5 / 3;
  std::vector<BallErrors> errors;
  const int steps = report_context.pick(5, 4);
  for (int i = 0; i < steps; ++i) {
    MeasureOptions options = report_context.on<MeasureOptions>("sphere.sgm");
    options.cell = 1.0 / (1 << i);
    options.cubes = options.cell;
    options.no_self_intersections = true;
    const Result<measure::MeshMeasures> m = report_context.measure(options);
    if (!m) return m.error();
    const measure::CubeVolumes& cubes = *m->cubes;
    errors.push_back({*options.cell, m->sums.area / kArea - 1, m->sums.volume / kVolume - 1,
                      cubes.volumeOf(cubes.all) / kVolume - 1, cubes.volumeOf(cubes.any) / kVolume - 1,
                      cubes.volumeOf(cubes.centre) / kVolume - 1});
    if (i + 1 == steps) commands.push_back(commandOf(options));
  }
  return errors;
}

double lastOrder(const std::vector<BallErrors>& errors, double BallErrors::*of) {
  return std::log2(std::abs(errors[errors.size() - 2].*of / (errors.back().*of)));
}

struct Measured {
  const char* name;
  double BallErrors::*of;
};

Markup ballChart(const std::vector<BallErrors>& errors, std::span<const Measured> measured, const char* title) {
  LineChart chart;
  chart.title = title;
  chart.x = {"LD, cells per metre", true, false, {}, {}};
  chart.y = {"error, % of the exact value", true, false, {}, {}};
  for (const BallErrors& e : errors) chart.x.marks.push_back(1 / e.cell);
  for (const Measured& m : measured) {
    Series series{m.name, {}, Series::Style::line};
    for (const BallErrors& e : errors) series.points.push_back({1 / e.cell, 100 * std::abs(e.*m.of)});
    chart.series.push_back(std::move(series));
  }
  Series law{"order 2", {}, Series::Style::dashed};
  const double first = 100 * std::abs(errors[0].*measured[0].of);
  for (const BallErrors& e : errors)
    law.points.push_back({1 / e.cell, first * (e.cell / errors[0].cell) * (e.cell / errors[0].cell)});
  chart.series.push_back(std::move(law));
  return drawn(chart);
}

Markup ballTable(const std::vector<BallErrors>& errors, std::span<const Measured> measured) {
  std::vector<std::vector<std::string>> rows{{"Error, %"}};
  for (const BallErrors& e : errors) rows[0].push_back(fmt::format("LD = {}", shortNumber(1 / e.cell)));
  rows[0].push_back("order at the last halving");
  for (const Measured& m : measured) {
    std::vector<std::string>& row = rows.emplace_back(std::vector<std::string>{m.name});
    for (const BallErrors& e : errors) row.push_back(fmt::format("{:+.3f}", 100 * e.*m.of));
    row.push_back(fmt::format("{:.2f}", lastOrder(errors, m.of)));
  }
  return table("A ball of 5 m, whose area and volume are known", rows);
}

ReportItem areaItem(const std::vector<Sampled>& models, const std::vector<Sampled>& roughness,
                    const std::vector<BallErrors>& ball) {
  ReportItem report_item;
  report_item.id = "figure-10";
  report_item.title = "Figure 10. Area against the density of the mesh";
  report_item.printed = {
      "“Comparison of surface vs. mesh density examples: top - cave, middle - cloud, bottom - building (LD, "
      "represented "
      "by sampling density).”",
      "“The relationship between the parameters of sampling density and the surface of the resulting structures "
      "possesses logarithmic characteristics (Fig 22).”"};
  compare(models, &Sample::area, "Area", "m²", report_item);
  constexpr Measured kArea[] = {{"area (equation 7)", &BallErrors::area}};
  report_item.ours +=
      element("p",
              "Over a few densities the growth may look like a logarithm (an order near 0), while finer "
              "cells still find windows, ledges or noise. Once these are resolved, the growth ends.");
  report_item.ours += element("h3", "A smooth surface has a limit") +
                      ballChart(ball, kArea, "Error of the area of a ball over the density: it falls with its square") +
                      ballTable(ball, kArea);
  report_item.ours += element("h3", "The effect of roughness");
  LineChart chart;
  chart.title = "Area of two tunnels through rock over the density, smooth and rough";
  chart.x = {"LD, cells per metre", true, false, {}, {}};
  chart.y.title = "area, m²";
  for (const Sample& s : roughness[0].samples) chart.x.marks.push_back(1 / s.cell);
  Json rough = Json::array();
  for (const Sampled& sampled : roughness) {
    Series series{sampled.model->name, {}, Series::Style::line};
    for (const Sample& s : sampled.samples) series.points.push_back({1 / s.cell, s.area});
    chart.series.push_back(std::move(series));
    const std::vector<double> areas = valuesOf(sampled, &Sample::area);
    rough.push_back({{"model", sampled.model->name}, {"values", areas}, {"order", orNull(observedOrder(areas))}});
  }
  const double smooth = roughness[0].samples.back().area / roughness[0].samples.front().area - 1;
  const double rugged = roughness[1].samples.back().area / roughness[1].samples.front().area - 1;
  report_item.ours +=
      drawn(chart) +
      element("p", fmt::format("Two tunnels of tunnels.sgm. From the coarsest to the finest cells, the area of smooth "
                               "walls changes by {:+.1f} %, that of walls with fractal noise by {:+.1f} %: finer grids "
                               "find more of the noise, until its smallest octave is resolved.",
                               100 * smooth, 100 * rugged));
  report_item.measured =
      "Equation 7 is taken as S = Σ ½|(V2 − V1) × (V3 − V1)|, since the printed form is a vector; it is summed in "
      "double precision and in a fixed order. The areas of the cave and of the cloud are those inside a region that is "
      "a multiple of the largest chunk, without the faces where the region cuts them.";
  report_item.numbers["ball_order"] = lastOrder(ball, &BallErrors::area);
  report_item.numbers["roughness"] = std::move(rough);
  return report_item;
}

ReportItem volumeItem(const std::vector<Sampled>& models, const std::vector<BallErrors>& ball) {
  ReportItem report_item;
  report_item.id = "figure-11";
  report_item.title = "Figure 11. Volume against the density of the mesh";
  report_item.printed = {
      "“Comparison of volume vs mesh density examples: top - cave, middle - cloud, bottom - building (LD, represented "
      "by "
      "the sampling density).”",
      "“V_M = N_C · (C_E)³ (8) … C_E – the cube edge (C_E = 1/grid density), N_C – numbers of cubes inside.”"};
  compare(models, &Sample::volume, "Volume", "m³", report_item);
  constexpr Measured kVolumes[] = {{"divergence theorem", &BallErrors::volume},
                                   {"cubes with all corners inside", &BallErrors::all},
                                   {"cubes with any corner inside", &BallErrors::any},
                                   {"cubes with their centre inside", &BallErrors::centre}};
  report_item.ours +=
      element("h3", "What “inside” means") +
      ballChart(ball, kVolumes, "Error of the volume of a ball over the density, by four rules") +
      ballTable(ball, kVolumes) +
      element("p",
              "Equation 8 does not say which cubes are inside. By corners, its error falls with the edge of the cells; "
              "by centres, it falls faster but irregularly. The divergence theorem over the mesh has order 2.");
  report_item.measured =
      "Equation 8 uses a cube around each sample, which is inside if the sample is. The volume of the ball is also "
      "measured on its mesh, by cubes of the cell's edge under three rules, and by the divergence theorem. The volume "
      "of the cave is that of its rock.";
  report_item.numbers["ball_order"] = lastOrder(ball, &BallErrors::volume);
  report_item.numbers["ball_order_all_corners"] = lastOrder(ball, &BallErrors::all);
  report_item.numbers["ball_order_any_corner"] = lastOrder(ball, &BallErrors::any);
  return report_item;
}

}  // namespace

ReportItems densityPart(ReportContext& report_context) {
  const std::vector<Model> models{{"cave", "cave.sgm", 7, "64,64,64:192,192,192", 2},
                                  {"cloud", "cloud.sgm", 3, "0,768,0:768,1536,768", 24},
                                  {"building", "storeys.sgm", 0, "", 1}};
  // Mesh only the surroundings of the block: at the finest cell size, the whole world would have half a million chunks.
  constexpr const char* kBlock = "-32,-32,-32:32,32,32";
  const std::vector<Model> tunnels{{"smooth walls", "tunnels.sgm", 0, kBlock, 1, {"tunnels=2", "rough=0"}},
                                   {"rough walls", "tunnels.sgm", 0, kBlock, 1, {"tunnels=2", "rough=0.8"}}};
  std::vector<std::string> commands;
  const auto sampleAll = [&](const std::vector<Model>& of, int steps) -> Result<std::vector<Sampled>> {
    std::vector<Sampled> all;
    for (const Model& model : of) {
      Result<Sampled> sampled = sample(report_context, model, steps, commands);
      if (!sampled) return sampled.error();
      all.push_back(std::move(*sampled));
    }
    return all;
  };
  const Result<std::vector<Sampled>> sampled = sampleAll(models, report_context.pick(4, 3));
  if (!sampled) return sampled.error();
  const Result<std::vector<Sampled>> rough = sampleAll(tunnels, report_context.pick(5, 4));
  if (!rough) return rough.error();
  const Result<std::vector<BallErrors>> ball = ballErrors(report_context, commands);
  if (!ball) return ball.error();
  ReportItem area = areaItem(*sampled, *rough, *ball), volume = volumeItem(*sampled, *ball);
  commands.push_back(commandOfPart(report_context.options(), "density"));
  area.commands = volume.commands = commands;
  return std::vector<ReportItem>{std::move(area), std::move(volume)};
}

}  // namespace sgm::cli
