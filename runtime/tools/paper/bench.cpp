// `sgm bench paper`: measures the stages of the paper's tables on every backend.

#include <fmt/core.h>

#include <algorithm>

#include "tools/paper/backend_runs.h"
#include "tools/paper/bench_report.h"
#include "tools/paper/commands.h"
#include "tools/support/console.h"
#include "tools/support/options.h"

namespace sgm::cli {
namespace {

Result<int32_t> cellOf(const BenchOptions& options, const StageModel& model) {
  WorldOptions cell;
  cell.cell = options.cell.value_or(static_cast<double>(model.edge) / static_cast<double>(options.cells));
  return cellUnits(cell);
}

Result<StageResult> measure(const BenchOptions& options, const StageModel& model, int32_t cell,
                            std::span<const BackendRun> backend_runs) {
  const auto measured =
      static_cast<uint64_t>(std::count_if(backend_runs.begin(), backend_runs.end(), [](const BackendRun& backend_run) {
        return backend_run.backend != nullptr;
      }));
  ProgressBar bar(fmt::format("measuring the {}", model.name));
  uint64_t done = 0;
  return measureStage(model, cell, options.runs, backend_runs,
                      [&] { bar.show(++done, measured * (options.runs + 1)); });
}

}  // namespace

Exit benchPaper(const BenchOptions& options) {
  std::vector<StageResult> results;
  for (const StageModel& model : stageModels()) {
    const Result<int32_t> cell = cellOf(options, model);
    if (!cell) return reportError(cell.error());
    // Open the devices again for each stage, so that a stage is measured as in a process of its own. Otherwise, a
    // software device would slow down later stages: it specializes its code for every kind of instruction that it has
    // met so far.
    const Result<std::vector<BackendRun>> backend_runs = makeBackendRuns(options.backends, options.threads);
    if (!backend_runs) return reportError(backend_runs.error());
    Result<StageResult> result = measure(options, model, *cell, *backend_runs);
    if (!result) return reportError(result.error());
    results.push_back(std::move(*result));
  }
  if (options.json) {
    fmt::print("{}\n", toJson(options, results).text());
  } else {
    print(options, results);
  }
  // If a requested backend is missing, the output has a row for it, and the exit status is an error, as in other
  // commands.
  Exit status = Exit::done;
  for (const StageRow& row : results.back().rows) {
    if (!row.measured() && !options.backends.empty())
      status = reportError(Exit::backend, fmt::format("{}: {}", row.name, row.reason));
  }
  return status;
}

}  // namespace sgm::cli
