#include "tools/paper/bench_report.h"

#include <fmt/core.h>

#include "tools/paper/commands.h"
#include "tools/paper/printed.h"

namespace sgm::cli {
namespace {

constexpr const char* kMeasured =
    "from derived cells to packed meshes: field programs are compiled, pruned, sampled and meshed, by each backend in "
    "turn. The first run is reported separately: it also derives the cells (which the paper's section 5 cannot "
    "measure) and prepares the device";
constexpr const char* kCounted =
    "instructions of the field programs, pruned to bricks, times the samples and vertices at which they are evaluated; "
    "each is a distance, a minimum or an octave of noise. They are counted in a separate run on the CPU. One operation "
    "is many flop; flop are not counted";
constexpr const char* kNoWorkers = "the device does not report its number of processors";

/// The texts of the paper's contradictions that concern the tables measured by `sgm bench paper`.
std::vector<std::string> inconsistencies() {
  std::vector<std::string> texts;
  for (const Contradiction& found : contradictions())
    if (found.of_tables) texts.push_back(found.text);
  return texts;
}

std::string hexHash(const StageResult& result) { return fmt::format("{:016x}", result.hash.value()); }

Json rowJson(const StageResult& result, const StageRow& row) {
  Json json{{"name", row.name}, {"measured", row.measured()}};
  if (!row.measured()) {
    json["reason"] = row.reason;
    return json;
  }
  const StageFigures figures = figuresOf(result, row);
  json.update({{"device", row.device},
               {"workers", row.workers > 0 ? Json(row.workers) : Json()},
               {"first_seconds", row.first},
               {"seconds", figures.seconds},
               {"run_seconds", row.seconds},
               {"speedup", figures.speedup},
               {"efficiency", figures.efficiency ? Json(*figures.efficiency) : Json()},
               {"operations_per_second", figures.throughput},
               {"chunks_on_cpu", row.on_cpu},
               {"triangles", result.triangles},
               {"hash", hexHash(result)}});
  if (!figures.efficiency) json["no_efficiency"] = kNoWorkers;
  return json;
}

Json paperJson(const PaperStage& paper) {
  return {{"sequential_seconds", paper.sequential},
          {"parallel_seconds", paper.parallel},
          {"speedup", paper.speedup()},
          {"printed_efficiency", paper.efficiency},
          {"efficiency", efficiency(paper.speedup(), kPaperWorkers)}};
}

void printRow(const BenchOptions& options, const StageResult& result, const StageRow& row) {
  if (!row.measured()) {
    fmt::print("  {:<17}not measured: {}\n", row.name, row.reason);
    return;
  }
  const StageFigures figures = figuresOf(result, row);
  fmt::print("  {:<17}{:>7}{:>10.4f}{:>10.4f}{:>9.2f}{:>12}{:>9.3f}{:>12}  {}\n", row.name,
             row.workers > 0 ? fmt::format("{}", row.workers) : "-", row.first, figures.seconds, figures.speedup,
             figures.efficiency ? fmt::format("{:.3f}", *figures.efficiency) : "-", figures.throughput / 1e9,
             result.triangles, hexHash(result));
  if (row.on_cpu > 0) {
    fmt::print(
        "  {:<17}left {} of {} chunks in all runs to the CPU: they were too large for the device, or it failed\n", "",
        row.on_cpu, (options.runs + 1) * result.chunks);
  }
}

void printPaper(const PaperStage& paper) {
  fmt::print("  {:<17}{:>7}{:>20.4f}{:>9.2f}{:>12}\n", "paper, sequential", 1, paper.sequential, 1.0, "-");
  fmt::print("  {:<17}{:>7}{:>20.4f}{:>9.2f}{:>12.3f}  by its own times {:.4f}\n", "paper, parallel", kPaperWorkers,
             paper.parallel, paper.speedup(), paper.efficiency, efficiency(paper.speedup(), kPaperWorkers));
}

void printStage(const BenchOptions& options, const StageResult& result, const PaperStage& paper) {
  const StageModel& model = *result.model;
  fmt::print("\n{}: {} m of {} with seed {}, cells of {} m: {} chunks, {:.1f} million field operations\n", model.name,
             model.edge, model.file, model.seed, metres(result.cell), result.chunks,
             static_cast<double>(result.operations) / 1e6);
  fmt::print("  {:<17}{:>7}{:>10}{:>10}{:>9}{:>12}{:>9}{:>12}  {}\n", "", "workers", "first, s", "median, s", "speedup",
             "efficiency", "Gop/s", "triangles", "hash");
  for (const StageRow& row : result.rows) printRow(options, result, row);
  printPaper(paper);
}

}  // namespace

Json toJson(const BenchOptions& options, std::span<const StageResult> results) {
  Json stages = Json::array();
  for (size_t s = 0; s < results.size(); ++s) {
    const StageResult& result = results[s];
    Json rows = Json::array();
    for (const StageRow& row : result.rows) rows.push_back(rowJson(result, row));
    stages.push_back({{"stage", result.model->name},
                      {"grammar", result.model->file},
                      {"seed", result.model->seed},
                      {"region", {metresJson(result.extent.lo), metresJson(result.extent.hi)}},
                      {"cell", metres(result.cell)},
                      {"cell_units", result.cell},
                      {"chunks", result.chunks},
                      {"operations", result.operations},
                      {"rows", std::move(rows)},
                      {"paper", paperJson(kPaperStages[s])}});
  }
  return {{"runs", options.runs},
          {"measured", kMeasured},
          {"counted", kCounted},
          {"stages", std::move(stages)},
          {"paper",
           {{"workers", kPaperWorkers},
            {"sequential_gflops", kPaperSequentialThroughput},
            {"parallel_gflops", kPaperParallelThroughput},
            {"inconsistencies", inconsistencies()}}}};
}

void print(const BenchOptions& options, std::span<const StageResult> results) {
  fmt::print("Tables 1 to 3 of the paper: medians of {} warm run{}\n", options.runs, options.runs == 1 ? "" : "s");
  for (const StageRow& row : results.front().rows)
    if (row.measured()) fmt::print("  {:<17}{}\n", row.name, row.device);
  for (size_t s = 0; s < results.size(); ++s) printStage(options, results[s], kPaperStages[s]);
  fmt::print("\nthroughput in the paper, one figure for all stages: {} Gflop/s sequential, {} parallel\n",
             kPaperSequentialThroughput, kPaperParallelThroughput);
  fmt::print("\nTimes:      {}.\nOperations: {}.\n", kMeasured, kCounted);
  fmt::print("Workers:    threads of the CPU, including the caller's; -: {}, so there is no efficiency.\n", kNoWorkers);
  fmt::print(
      "Hash:       of the meshes of a stage; the benchmark fails unless it is the same in every run and on every "
      "backend.\n");
  fmt::print("\nThe paper's figures are not a baseline, because they contradict each other:\n");
  size_t number = 0;
  for (const std::string& text : inconsistencies()) fmt::print("  {}. {}\n", ++number, text);
}

}  // namespace sgm::cli
