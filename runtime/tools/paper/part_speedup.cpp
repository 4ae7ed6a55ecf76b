// Figures 1 and 2 and tables 1 to 3: speedup, efficiency and throughput.

#include <fmt/core.h>

#include <array>

#include "tools/paper/backend_runs.h"
#include "tools/paper/bench_report.h"
#include "tools/paper/bundle.h"
#include "tools/paper/chart.h"
#include "tools/paper/commands.h"
#include "tools/paper/parts.h"
#include "tools/paper/printed.h"
#include "tools/paper/report_context.h"
#include "world/world_field.h"

namespace sgm::cli {
namespace {

std::vector<std::string> backendsOf(const PaperOptions& options) {
  return options.backend == "auto" ? std::vector<std::string>{} : std::vector<std::string>{options.backend};
}

std::string whoIs(const StageRow& row) {
  if (row.name == "sequential") return "sequential";
  return row.workers == 0 ? row.name
                          : fmt::format("{}, {} worker{}", row.name, row.workers, row.workers == 1 ? "" : "s");
}

// Figures 1 and 2.

constexpr double kCell = 0.5;  // edge of a grid cell, in metres

/// The measurement for one number of position points, the parameter of figures 1 and 2.
struct PointsRun {
  int points = 0;
  /// numbers of shape nodes and of instructions in the field program that contains all points
  size_t nodes = 0, instructions = 0;
  StageResult result;
};

/// Counts the shape nodes and the instructions of the field program, and stores the numbers in `run`.
Result<void> countNodes(PointsRun& run, bool hybrid) {
  const CompileResult compiled = compileBundled("paper/points.sgm");
  if (!compiled.program) return Error{Code::bad_input, renderDiagnostics(compiled)};
  WorldFieldSettings settings;
  settings.program = compiled.program;
  settings.parameters = ParameterValues::defaults(*compiled.program);
  for (const auto& [name, value] : {std::pair{"points", double(run.points)}, std::pair{"hybrid", hybrid ? 1.0 : 0.0}})
    if (const Result<void> set = settings.parameters.set(*compiled.program, name, value); !set) return set.error();
  settings.finest_cell = static_cast<int32_t>(kCell * kUnitsPerMetre);
  const WorldField world(std::move(settings), std::pmr::new_delete_resource());
  const Result<std::shared_ptr<const DerivedCell>> cell = world.cell(0, {0, 0, 0});
  if (!cell) return cell.error();
  run.nodes = (*cell)->chunk.shapes.size();
  const Result<std::shared_ptr<const FieldProgram>> program = world.compile(compiled.program->domain.box, 0);
  if (!program) return program.error();
  run.instructions = (*program)->instrs.size();
  return {};
}

Result<std::vector<PointsRun>> measurePoints(ReportContext& report_context, bool hybrid) {
  const Result<std::vector<BackendRun>> backend_runs =
      makeBackendRuns(report_context.options().backend == "auto" ? std::vector<std::string>{"cpu"}
                                                                 : backendsOf(report_context.options()),
                      report_context.options().threads);
  if (!backend_runs) return backend_runs.error();
  const std::vector<int> counts =
      report_context.pick(std::vector{5, 25, 50, 100, 200, 300, 400, 500, 600, 700}, std::vector{5, 50, 200, 450, 700});
  const auto runs = report_context.pick<uint64_t>(7, 3);
  std::vector<PointsRun> all;
  ProgressBar bar(report_context.doing());
  uint64_t done = 0;
  for (const int points : counts) {
    PointsRun run;
    run.points = points;
    const std::pair<std::string_view, double> parameters[] = {{"points", points}, {"hybrid", hybrid ? 1 : 0}};
    const StageModel model{"points", "paper/points.sgm", 0, {-32, -32, -32}, 64, parameters};
    Result<StageResult> result =
        measureStage(model, static_cast<int32_t>(kCell * kUnitsPerMetre), runs, *backend_runs,
                     [&] { bar.show(++done, counts.size() * backend_runs->size() * (runs + 1)); });
    if (!result) return result.error();
    run.result = std::move(*result);
    if (const Result<void> counted = countNodes(run, hybrid); !counted) return counted.error();
    all.push_back(std::move(run));
  }
  return all;
}

/// Increase of a quantity per position point: its difference between the runs with the most and the fewest points,
/// divided by the difference of their numbers of points.
double slope(const std::vector<PointsRun>& runs, size_t PointsRun::*of) {
  return static_cast<double>(runs.back().*of - runs.front().*of) / (runs.back().points - runs.front().points);
}

ReportItem pointsItem(ReportContext& report_context, bool hybrid, const std::vector<PointsRun>& runs) {
  ReportItem report_item;
  report_item.id = hybrid ? "figure-2" : "figure-1";
  report_item.title =
      hybrid ? "Figure 2. Speedup of the hybrid system" : "Figure 1. Speedup of the shape morphing system";
  report_item.printed = {
      hybrid
          ? "“… in Figure 2 shape hybrid system speedup as a function of the number of measurements of α (α is set of "
            "the position points).”"
          : "“Figure 1. Speedup of the parallel shape morphing system”",
      "“The points were changed from 5 to 700 and the run time for the sequential shape morphing system and the shape "
      "hybrid system and their parallel versions were measured.”",
      hybrid ? "“Computational complexity of the hybrid system shapes: O(α) = 14P(r + r0 + ab)[a + r(b + a)]²”"
             : "“Computational complexity of the shapes morphing system: O(α) = 41P(r + r0 + ab)[a + r(b + a)]²”"};
  LineChart speedups, times;
  speedups.title = "Speedup over the number of position points";
  speedups.y = {"speedup", false, true, {}, {}};
  times.title = "Time over the number of position points";
  times.y = {"time, ms", false, true, {}, {}};
  for (LineChart* chart : {&speedups, &times}) {
    chart->x = {"position points α", false, true, {}, {}};
    chart->width = 460;
    chart->height = 320;
  }
  std::vector<std::vector<std::string>> rows{{"α", "nodes", "instructions"}};
  for (const StageRow& row : runs.front().result.rows) {
    if (!row.measured()) continue;
    times.series.push_back({whoIs(row), {}, Series::Style::line});
    rows[0].push_back(whoIs(row) + ", ms");
    if (row.name == "sequential") continue;
    rows[0].push_back("speedup");
    speedups.series.push_back({whoIs(row), {}, Series::Style::line});
  }
  Json points = Json::array();
  for (const PointsRun& run : runs) {
    std::vector<std::string>& row = rows.emplace_back(std::vector<std::string>{
        fmt::format("{}", run.points), fmt::format("{}", run.nodes), fmt::format("{}", run.instructions)});
    size_t t = 0, s = 0;
    for (const StageRow& of : run.result.rows) {
      if (!of.measured()) continue;
      const StageFigures figures = figuresOf(run.result, of);
      times.series[t++].points.push_back({double(run.points), 1000 * figures.seconds});
      row.push_back(fmt::format("{:.2f}", 1000 * figures.seconds));
      points.push_back({{"points", run.points},
                        {"nodes", run.nodes},
                        {"instructions", run.instructions},
                        {"name", of.name},
                        {"seconds", figures.seconds},
                        {"speedup", figures.speedup}});
      if (of.name == "sequential") continue;
      speedups.series[s++].points.push_back({double(run.points), figures.speedup});
      row.push_back(fmt::format("{:.2f}", figures.speedup));
    }
  }
  report_item.ours =
      ReportContext::row(drawn(speedups) + drawn(times)) + table("By the number of position points", rows);
  report_item.measured = fmt::format(
      "At each point, a ball that morphs into a cube, {}. Medians of {} warm runs from derived cells to packed meshes, "
      "64 m in cells of {} m; every run on every backend made meshes of the same hash.",
      hybrid ? "both collapsed into one shape by a morphic rule" : "both of them sampled and then blended",
      runs.front().result.rows[0].seconds.size(), kCell);
  report_item.commands = {commandOfPart(report_context.options(), "speedup"),
                          fmt::format("sgm mesh grammars/paper/points.sgm --set points=700 --set hybrid={} --cell {}",
                                      hybrid ? 1 : 0, kCell)};
  report_item.numbers = {{"cell", kCell},
                         {"nodes_a_point", slope(runs, &PointsRun::nodes)},
                         {"instructions_a_point", slope(runs, &PointsRun::instructions)},
                         {"points", std::move(points)}};
  return report_item;
}

/// Compares the morphing and the hybrid rule by our numbers of shape nodes and instructions per position point. The
/// paper has 41 nodes per point for morphing, and 14 for the hybrid rule.
Markup nodesCompared(const std::vector<PointsRun>& morphing, const std::vector<PointsRun>& hybrid) {
  const double before = slope(morphing, &PointsRun::nodes), after = slope(hybrid, &PointsRun::nodes);
  BarChart chart;
  chart.title = "Nodes and instructions per position point, morphing and hybrid";
  chart.y.title = "per position point";
  chart.groups = {"nodes", "instructions"};
  chart.series = {{"morphing", {before, slope(morphing, &PointsRun::instructions)}},
                  {"hybrid", {after, slope(hybrid, &PointsRun::instructions)}}};
  chart.width = 460;
  chart.height = 260;
  return element("h3", "14 against 41") + drawn(chart) +
         element("p",
                 fmt::format(
                     "The paper's two complexities differ only by the factors 14 and 41: {:.2f}. Here a morphic rule "
                     "saves nodes: {:.2f} per point if it collapses two shapes into one, and {:.2f} if both are kept: "
                     "{:.2f}. It does not always save time: a superquadric costs more than a ball and a box together.",
                     14.0 / 41, after, before, after / before));
}

// Tables 1 to 3.

Result<std::vector<StageResult>> measureStages(ReportContext& report_context, const BenchOptions& options) {
  std::vector<StageResult> results;
  ProgressBar bar(report_context.doing());
  uint64_t done = 0;
  for (const StageModel& model : stageModels()) {
    const Result<std::vector<BackendRun>> backend_runs = makeBackendRuns(options.backends, options.threads);
    if (!backend_runs) return backend_runs.error();
    const auto cell = static_cast<int32_t>(model.edge * kUnitsPerMetre / static_cast<int32_t>(options.cells));
    Result<StageResult> result = measureStage(model, cell, options.runs, *backend_runs, [&] {
      bar.show(++done, stageModels().size() * backend_runs->size() * (options.runs + 1));
    });
    if (!result) return result.error();
    results.push_back(std::move(*result));
  }
  return results;
}

constexpr std::array<const char*, 3> kStageNames = {"A – cave", "B – cloud", "C – building"};

/// A table of one quantity: a column for each stage, a row with the paper's values, and a row for each backend run.
Markup stageTable(const std::vector<StageResult>& results, const std::string& caption,
                  std::vector<std::vector<std::string>> rows,
                  const std::function<std::string(const StageResult&, const StageRow&)>& figure) {
  rows.insert(rows.begin(), std::vector<std::string>{""});
  for (const char* name : kStageNames) rows[0].emplace_back(name);
  for (size_t r = 0; r < results[0].rows.size(); ++r) {
    if (!results[0].rows[r].measured()) continue;
    std::vector<std::string>& row = rows.emplace_back(std::vector<std::string>{"ours, " + whoIs(results[0].rows[r])});
    for (const StageResult& result : results) row.push_back(figure(result, result.rows[r]));
  }
  return table(caption, rows);
}

template <class Value>
std::vector<std::string> paperRow(const std::string& name, Value value) {
  std::vector<std::string> row{name};
  for (const PaperStage& stage : kPaperStages) row.push_back(value(stage));
  return row;
}

ReportItem speedupTable(const std::vector<StageResult>& results) {
  ReportItem report_item;
  report_item.id = "table-1";
  report_item.title = "Table 1. Speedup";
  report_item.printed = {"“Table 1. Evaluation of the parallel algorithm - speedup for m = 255”",
                         "Parallel: A 0.096 s, B 0.125 s, C 0.069 s. Sequential: A 0.81 s, B 0.62 s, C 0.54 s."};
  report_item.ours =
      stageTable(results, "Seconds",
                 {paperRow("paper, sequential", [](const PaperStage& s) { return fmt::format("{}", s.sequential); }),
                  paperRow("paper, parallel", [](const PaperStage& s) { return fmt::format("{}", s.parallel); })},
                 [](const StageResult& result, const StageRow& row) {
                   return fmt::format("{:.4f}", figuresOf(result, row).seconds);
                 });
  report_item.ours += stageTable(
      results, "Speedup (equation 2)",
      {paperRow("paper, by its times", [](const PaperStage& s) { return fmt::format("{:.2f}", s.speedup()); })},
      [](const StageResult& result, const StageRow& row) {
        return fmt::format("{:.2f}", figuresOf(result, row).speedup);
      });
  BarChart chart;
  chart.title = "Speedup by stage, the paper's and ours";
  chart.y.title = "speedup";
  chart.groups.assign(kStageNames.begin(), kStageNames.end());
  BarChart::Bars paper{"paper, m = 255", {}};
  for (const PaperStage& stage : kPaperStages) paper.values.push_back(stage.speedup());
  chart.series.push_back(std::move(paper));
  for (size_t r = 1; r < results[0].rows.size(); ++r) {
    if (!results[0].rows[r].measured()) continue;
    BarChart::Bars bars{whoIs(results[0].rows[r]), {}};
    for (const StageResult& result : results) bars.values.push_back(figuresOf(result, result.rows[r]).speedup);
    chart.series.push_back(std::move(bars));
  }
  report_item.ours += drawn(chart);
  return report_item;
}

ReportItem efficiencyTable(const std::vector<StageResult>& results) {
  ReportItem report_item;
  report_item.id = "table-2";
  report_item.title = "Table 2. Efficiency";
  report_item.printed = {
      "“Table 2. Evaluation of the parallel algorithm – efficiency for m = 255”: A 0.028, B 0.015, C 0.027."};
  report_item.ours = stageTable(
      results, "Efficiency (equation 3): speedup over workers",
      {paperRow("paper, printed", [](const PaperStage& s) { return fmt::format("{}", s.efficiency); }),
       paperRow("paper, by its times",
                [](const PaperStage& s) { return fmt::format("{:.4f}", efficiency(s.speedup(), kPaperWorkers)); })},
      [](const StageResult& result, const StageRow& row) {
        const StageFigures figures = figuresOf(result, row);
        return figures.efficiency ? fmt::format("{:.3f}", *figures.efficiency) : std::string("workers unknown");
      });
  return report_item;
}

ReportItem throughputTable(const std::vector<StageResult>& results) {
  ReportItem report_item;
  report_item.id = "table-3";
  report_item.title = "Table 3. Throughput";
  report_item.printed = {
      "“Table 3. Evaluation of the parallel algorithm – throughput for m = 255”: sequential 0.8 Gflop/s, parallel "
      "20.61 "
      "Gflop/s, for all stages."};
  report_item.ours = stageTable(
      results, "Throughput (equation 4): 10⁹ field operations per second; the paper counts Gflop/s",
      {paperRow("paper, sequential", [](const PaperStage&) { return fmt::format("{}", kPaperSequentialThroughput); }),
       paperRow("paper, parallel", [](const PaperStage&) { return fmt::format("{}", kPaperParallelThroughput); })},
      [](const StageResult& result, const StageRow& row) {
        return fmt::format("{:.3f}", figuresOf(result, row).throughput / 1e9);
      });
  report_item.ours +=
      element("p",
              "A field operation is one instruction of a pruned field program, at one sample: a distance, "
              "a minimum or an octave of noise. Each is many flop.");
  return report_item;
}

}  // namespace

ReportItems speedupPart(ReportContext& report_context) {
  const Result<std::vector<PointsRun>> morphing = measurePoints(report_context, false);
  if (!morphing) return morphing.error();
  const Result<std::vector<PointsRun>> hybrid = measurePoints(report_context, true);
  if (!hybrid) return hybrid.error();
  std::vector<ReportItem> report_items{pointsItem(report_context, false, *morphing),
                                       pointsItem(report_context, true, *hybrid)};
  report_items[1].ours += nodesCompared(*morphing, *hybrid);

  BenchOptions options;
  options.runs = report_context.pick<uint64_t>(10, 3);
  options.cells = report_context.pick<uint64_t>(256, 64);
  options.backends = backendsOf(report_context.options());
  options.threads = report_context.options().threads;
  const Result<std::vector<StageResult>> results = measureStages(report_context, options);
  if (!results) return results.error();
  std::string measured =
      fmt::format("Medians of {} warm runs of each stage from derived cells to packed meshes:", options.runs);
  for (const StageResult& result : *results) {
    measured +=
        fmt::format(" {} m of {} with seed {} in cells of {} m, {} triangles, hash {:016x};", result.model->edge,
                    result.model->file, result.model->seed, metres(result.cell), result.triangles, result.hash.value());
  }
  measured.back() = '.';
  for (const StageRow& row : results->front().rows)
    measured += row.measured() ? fmt::format(" {}: {}.", whoIs(row), row.device)
                               : fmt::format(" {}: not measured: {}.", row.name, row.reason);
  std::string command = fmt::format("sgm bench paper --size {} --runs {}", options.cells, options.runs);
  for (const std::string& backend : options.backends) command += " --backend " + backend;
  if (options.threads != 0) command += fmt::format(" --threads {}", options.threads);
  report_items.push_back(speedupTable(*results));
  report_items.push_back(efficiencyTable(*results));
  report_items.push_back(throughputTable(*results));
  for (size_t i = 2; i < report_items.size(); ++i) {
    report_items[i].measured = measured;
    report_items[i].commands = {command};
    report_items[i].numbers = toJson(options, *results);
  }
  return report_items;
}

}  // namespace sgm::cli
