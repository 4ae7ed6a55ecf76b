// Figures 14 and 15: histograms of dihedral angles at several densities of the mesh, histograms of the main classes,
// and the accuracy of classification with these histograms.

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>

#include "tools/classify/build.h"
#include "tools/cli/classify/master_key.h"
#include "tools/cli/measure/commands.h"
#include "tools/paper/chart.h"
#include "tools/paper/command_line.h"
#include "tools/paper/parts.h"
#include "tools/paper/report_context.h"
#include "tools/support/measured_mesh.h"
#include "tools/support/render_options.h"

namespace sgm::cli {
namespace {

using measure::Histogram;
using measure::HistogramMode;

constexpr HistogramMode kModes[] = {HistogramMode::printed, HistogramMode::corrected, HistogramMode::curvature};

/// Converts a histogram to a step curve over v, the quantity that equation 14 of the paper divides into bins.
Series stepsOf(const std::string& name, std::span<const double> shares, int32_t first_bin, uint32_t bins) {
  Series series{name, {}, Series::Style::steps};
  for (size_t i = 0; i <= shares.size(); ++i) {
    const double v = (first_bin - 1 + static_cast<double>(i)) / bins;
    series.points.push_back({v, i < shares.size() ? 100 * shares[i] : 0});
  }
  return series;
}

LineChart histogramChart(HistogramMode mode, const std::string& of) {
  LineChart chart;
  chart.title = fmt::format("Histogram of {}, mode {}", of, measure::nameOf(mode));
  chart.x.title = fmt::format("v, mode {}", measure::nameOf(mode));
  chart.y = {"edges, %", false, true, {}, {}};
  chart.width = 380;
  chart.height = 300;
  if (mode == HistogramMode::printed) {
    chart.x.low = -0.4;
    chart.x.high = 0.4;
  } else {
    chart.x.low = 0;
    chart.x.high = 1;
  }
  return chart;
}

// Figure 14.

constexpr const char* kHouse = "storeys.sgm";
const std::vector<std::string> kHouseSets{"floors=3", "convex=0.6"};

struct Density {
  double ld = 0;
  uint64_t triangles = 0;
  std::vector<Histogram> by_mode;
  std::string verdict;
};

/// The class that `sgm classify` reports with default options and the built-in reference histograms.
Result<std::string> verdictOf(const asset::TriangleMesh& mesh, const masters::MasterSet& set, JobSystem& jobs) {
  const measure::MasterKey key = masters::defaultKey();
  const Result<Histogram> histogram = measure::innerHistogram({mesh.points, mesh.triangles}, key.settings(), jobs);
  if (!histogram) return histogram.error();
  const Result<measure::Classification> said =
      measure::classify(histogram->shares, key, set.of(key), *set.limitsOf(key));
  if (!said) return said.error();
  return said->verdict;
}

Result<std::vector<Density>> measureDensities(ReportContext& report_context, std::vector<std::string>& commands) {
  const masters::MasterSet set = masters::builtInMasters();
  std::vector<Density> densities;
  for (const double ld : {2.0, 5.0, 10.0}) {
    WorldOptions options = report_context.on(kHouse);
    options.sets = kHouseSets;
    options.density = ld;
    const Result<Region> region = report_context.mesh(options);
    if (!region) return region.error();
    const asset::TriangleMesh mesh = trianglesOf(*region);
    Density& density = densities.emplace_back();
    density.ld = ld;
    density.triangles = mesh.triangles.size();
    for (const HistogramMode mode : kModes) {
      measure::HistogramSettings settings;
      settings.mode = mode;
      Result<Histogram> histogram =
          measure::innerHistogram({mesh.points, mesh.triangles}, settings, report_context.jobs());
      if (!histogram) return histogram.error();
      density.by_mode.push_back(std::move(*histogram));
    }
    Result<std::string> verdict = verdictOf(mesh, set, report_context.jobs());
    if (!verdict) return verdict.error();
    density.verdict = std::move(*verdict);
    MeasureOptions measured = report_context.on<MeasureOptions>(kHouse);
    measured.sets = kHouseSets;
    measured.density = ld;
    measured.no_self_intersections = true;
    measured.json = true;
    for (const HistogramMode mode : kModes) {
      measured.mode = measure::nameOf(mode);
      commands.push_back(commandOf(measured));
    }
    commands.push_back(commandOf("classify", options));
  }
  return densities;
}

double largestShare(const Histogram& histogram) { return *std::ranges::max_element(histogram.shares); }

Result<ReportItem> densityItem(ReportContext& report_context) {
  ReportItem report_item;
  report_item.id = "figure-14";
  report_item.title = "Figure 14. Levels of detail 2, 5 and 10";
  report_item.printed = {
      "“Level of detail (LD), from left LD=2, LD=5, LD=10.”",
      "“The verification of the correctness of the model depends on the density of the grid. The best "
      "results are obtained for LD = 10 (Fig. 14).”",
      "“When density is large, the histogram is reduced to a single bar, the most common value of angle.”"};
  Markup row;
  for (const int ld : {2, 5, 10}) {
    RenderOptions options = report_context.on<RenderOptions>(kHouse);
    options.sets = kHouseSets;
    options.density = ld;
    options.wires = true;
    options.camera = "10.6,6.6,11.4:6.3,4.9,6.8";
    options.fov = 40;
    options.size = report_context.pick("560x560", "360x360");
    const Result<Markup> picture = report_context.picture(options, fmt::format("detail-{}", ld),
                                                          fmt::format("A house's corner as a mesh with LD = {}", ld),
                                                          fmt::format("LD = {}", ld), report_item.commands);
    if (!picture) return picture.error();
    row += *picture;
  }
  const Result<std::vector<Density>> densities = measureDensities(report_context, report_item.commands);
  if (!densities) return densities.error();
  Markup charts;
  std::vector<std::vector<std::string>> rows{{"Largest bar"}};
  Json numbers = Json::array();
  for (const Density& density : *densities) rows[0].push_back(fmt::format("LD = {}", density.ld));
  for (size_t m = 0; m < std::size(kModes); ++m) {
    LineChart chart = histogramChart(kModes[m], "a house at LD = 2, 5 and 10");
    std::vector<std::string>& cells =
        rows.emplace_back(std::vector<std::string>{fmt::format("mode {}", measure::nameOf(kModes[m]))});
    for (const Density& density : *densities) {
      const Histogram& h = density.by_mode[m];
      chart.series.push_back(stepsOf(fmt::format("LD = {}", density.ld), h.shares, h.first_bin, h.settings.bins));
      cells.push_back(fmt::format("{:.1f} %", 100 * largestShare(h)));
    }
    charts += drawn(chart);
  }
  std::vector<std::string> below{"printed: entries below the array"}, verdicts{"classified as"}, triangles{"triangles"};
  for (const Density& density : *densities) {
    const Histogram& printed = density.by_mode[0];
    below.push_back(
        fmt::format("{:.1f} %", 100 * static_cast<double>(printed.below_first) / static_cast<double>(printed.edges)));
    verdicts.push_back(density.verdict);
    triangles.push_back(fmt::format("{}", density.triangles));
    Json of{{"ld", density.ld}, {"triangles", density.triangles}, {"class", density.verdict}};
    for (size_t m = 0; m < std::size(kModes); ++m)
      of["largest_share"][measure::nameOf(kModes[m])] = largestShare(density.by_mode[m]);
    of["entries_index_le_0"] = printed.below_first;
    numbers.push_back(std::move(of));
  }
  rows.insert(rows.end(), {below, triangles, verdicts});
  report_item.ours =
      ReportContext::row(row) + ReportContext::row(charts) + table("One house at three densities", rows) +
      element("p",
              "By angle, printed or corrected, the bars move together as the mesh becomes finer, since an edge half as "
              "long turns by half the angle, as the paper itself remarks. Curvature, the angle over the length of the "
              "edge, keeps curved parts in their bins. Its largest bar grows as well, since much of a house is flat "
              "and its corners have an ever smaller share of the edges. As printed, equation 13 gives v from −0.38 to "
              "0.38, never the 0.5 of a flat edge, and equation 14 gives indices of bins down to −12, before the start "
              "of the array that the paper describes.");
  report_item.measured =
      "storeys.sgm with three convex storeys. R = 33 bins, an odd number, so that flat edges lie inside one bin; "
      "smooth normals that point outward; every edge counts once per triangle. The classification uses curvature and "
      "the built-in reference histograms.";
  report_item.numbers = {{"densities", std::move(numbers)}};
  return report_item;
}

// Figure 15.

/// First seed of the test models. The built-in reference histograms were made with other seeds.
constexpr uint64_t kHeldOut = uint64_t{1} << 32;

std::vector<masters::Family> familiesFor(const ReportContext& report_context) {
  std::vector<masters::Family> families;
  for (const masters::Family& family : masters::families()) {
    const bool quick = family.cell == 1 || family.class_name == measure::kNoise;
    if (quick || !report_context.options().quick) families.push_back(family);
  }
  return families;
}

/// Makes test models of the families, with their histograms. families: must outlive the result.
Result<std::vector<masters::Specimen>> specimens(ReportContext& report_context,
                                                 std::span<const masters::Family> families) {
  WorldOptions options;
  options.backend = report_context.options().backend;
  const Result<std::unique_ptr<Backend>> backend = backendOf(options, report_context.jobs());
  if (!backend) return backend.error();
  ProgressBar bar(report_context.doing());
  return masters::specimensOf(families, report_context.pick<uint64_t>(4, 1), kHeldOut + report_context.options().seed,
                              **backend, report_context.jobs(), [&bar](uint64_t done, uint64_t total) {
                                bar.show(done, total);
                                return true;
                              });
}

/// Results of classifying models of known class with the reference histograms of one key.
struct Judged {
  measure::MasterKey key;
  std::map<std::string, std::map<std::string, int>> verdicts;  ///< numbers of models by true class, then by verdict
  /// For each true class, and each class that models were compared with, the sum of ClassDistance::mse over the models.
  std::map<std::string, std::map<std::string, double>> mse;
  std::map<std::string, std::vector<double>> mean;  ///< mean histogram of each true class
  std::map<std::string, int> models;
  int right = 0, all = 0;  ///< models that are not noise: number classified correctly, and total
};

Result<Judged> judge(std::span<const masters::Specimen> specimens, size_t key_number, const masters::MasterSet& set) {
  Judged judged{masters::masterKeys()[key_number], {}, {}, {}, {}};
  const std::vector<measure::Master> masters = set.of(judged.key);
  for (const masters::Specimen& specimen : specimens) {
    const std::vector<double>& shares = specimen.shares[key_number];
    if (shares.empty()) continue;
    const Result<measure::Classification> said =
        measure::classify(shares, judged.key, masters, *set.limitsOf(judged.key));
    if (!said) return said.error();
    const std::string is(specimen.family->class_name);
    ++judged.verdicts[is][said->verdict];
    ++judged.models[is];
    for (const measure::ClassDistance& distance : said->classes) judged.mse[is][distance.class_name] += distance.mse;
    std::vector<double>& mean = judged.mean[is];
    mean.resize(shares.size());
    for (size_t i = 0; i < shares.size(); ++i) mean[i] += shares[i];
    if (is == measure::kNoise) continue;
    ++judged.all;
    judged.right += said->verdict == is ? 1 : 0;
  }
  for (auto& [name, mean] : judged.mean)
    for (double& share : mean) share /= judged.models[name];
  return judged;
}

Markup confusion(const Judged& judged) {
  std::vector<std::vector<std::string>> rows{{"is"}};
  for (const std::string_view name : masters::classNames()) rows[0].emplace_back(name);
  rows[0].emplace_back(measure::kUnknown);
  for (const auto& [is, verdicts] : judged.verdicts) {
    std::vector<std::string>& row = rows.emplace_back(std::vector<std::string>{is});
    for (size_t c = 1; c < rows[0].size(); ++c) {
      const auto found = verdicts.find(rows[0][c]);
      row.push_back(fmt::format("{}", found == verdicts.end() ? 0 : found->second));
    }
  }
  const std::string noise(measure::kNoise);
  const auto unknown = judged.verdicts.contains(noise) ? judged.verdicts.at(noise) : std::map<std::string, int>{};
  return table(
      fmt::format("{}: {} of {} models of things are classified correctly, and {} of {} models of noise as unknown{}",
                  textOf(judged.key), judged.right, judged.all, unknown.contains("unknown") ? unknown.at("unknown") : 0,
                  judged.models.contains(noise) ? judged.models.at(noise) : 0,
                  judged.key.density == 0 ? "" : "; only models with this number of cells per metre"),
      rows);
}

Markup errorTable(const Judged& judged) {
  std::vector<std::string_view> classes = masters::classNames();
  classes.emplace_back(measure::kNoise);
  std::vector<std::vector<std::string>> rows{{"is"}};
  for (const std::string_view to : classes) rows[0].push_back("to " + std::string(to));
  for (const auto& [is, errors] : judged.mse) {
    std::vector<std::string>& row = rows.emplace_back(std::vector<std::string>{is});
    for (const std::string_view to : classes) {
      const auto found = errors.find(std::string(to));
      row.push_back(found == errors.end() ? "-" : fmt::format("{:.3f}", 1000 * found->second / judged.models.at(is)));
    }
  }
  return table(
      "Mean squared error of the square roots of the shares to the nearest reference histogram of each class, in "
      "thousandths, mean over the models",
      rows);
}

Result<ReportItem> classesItem(ReportContext& report_context) {
  ReportItem report_item;
  report_item.id = "figure-15";
  report_item.title = "Figure 15. Histograms of the main classes";
  report_item.printed = {
      "“Histograms for the main classes of results.”",
      "“The classification is based on the generation of a class histogram for new objects and its "
      "comparison to the master-histogram from the base, for which the mean square error is the smallest.”"};
  const std::vector<masters::Family> families = familiesFor(report_context);
  const Result<std::vector<masters::Specimen>> models = specimens(report_context, families);
  if (!models) return models.error();
  const masters::MasterSet set = masters::builtInMasters();
  const std::vector<measure::MasterKey> keys = masters::masterKeys();
  Markup charts, tables;
  Json judgements = Json::array();
  for (const HistogramMode mode : kModes) {
    // The reference histograms of the paper's two modes depend on the density (cells per metre): use those for a
    // density of 1, at which models of every class exist. The third mode has no density, which its key states as 0.
    const auto key = std::ranges::find_if(
        keys, [mode](const measure::MasterKey& k) { return k.mode == mode && (k.density == 0 || k.density == 1); });
    const Result<Judged> judged = judge(*models, static_cast<size_t>(key - keys.begin()), set);
    if (!judged) return judged.error();
    LineChart chart = histogramChart(mode, "the classes");
    measure::HistogramSettings settings = key->settings();
    const auto bins = static_cast<int32_t>(measure::binsOf(settings));
    const int32_t first = mode == HistogramMode::printed ? 1 - bins / 2 : 1;
    for (const std::string_view class_name : masters::classNames()) {
      const std::string name(class_name);
      if (judged->mean.contains(name))
        chart.series.push_back(stepsOf(name, judged->mean.at(name), first, settings.bins));
    }
    charts += drawn(chart);
    tables += confusion(*judged);
    if (*key == masters::defaultKey()) tables += errorTable(*judged);
    Json mean;
    for (const auto& [name, shares] : judged->mean) mean[name] = shares;
    judgements.push_back(
        {{"key", toJson(*key)}, {"right", judged->right}, {"models", judged->all}, {"mean", std::move(mean)}});
  }
  report_item.ours = ReportContext::row(charts) + element("h3", "Classification") + tables;
  const auto noise = std::ranges::count_if(
      *models, [](const masters::Specimen& s) { return s.family->class_name == measure::kNoise; });
  report_item.measured = fmt::format(
      "{} models, {} of them noise, the others of the classes {}, from {} pairs of a grammar and a density. Their "
      "parameters are drawn from the whole ranges, and the built-in reference histograms were made with other seeds. "
      "Reference histograms are means of clusters, at most {} per grammar, since caves of halls and caves of dripstone "
      "have no common mean. For curvature, the error is that of the square roots of the shares, so that the bin of "
      "flat edges alone does not decide. If the error exceeds a limit, or noise is nearest, the answer is unknown; the "
      "paper always answers.",
      models->size(), noise, fmt::join(masters::classNames(), ", "), families.size(),
      masters::mastersAGrammar(HistogramMode::curvature));
  report_item.commands = {commandOfPart(report_context.options(), "histograms"), "sgm masters list --json",
                          "sgm classify grammars/table4/muller.sgm"};
  report_item.numbers = {{"models", models->size()}, {"modes", std::move(judgements)}};
  return report_item;
}

}  // namespace

ReportItems histogramsPart(ReportContext& report_context) {
  Result<ReportItem> density = densityItem(report_context);
  if (!density) return density.error();
  Result<ReportItem> classes = classesItem(report_context);
  if (!classes) return classes.error();
  return std::vector<ReportItem>{std::move(*density), std::move(*classes)};
}

}  // namespace sgm::cli
