// sgm bench paper: the stages of the paper's tables on every backend.

#include <fmt/core.h>

#include <algorithm>

#include "cli/bench_report.h"
#include "cli/commands.h"
#include "cli/region.h"

namespace sgm::cli {
namespace {

/// named: the user has asked for it. A software device is not measured by itself, as `auto` does not choose it.
Result<Contender> makeContender(const std::string& name, const std::string& backend, bool named, unsigned threads) {
  Contender contender;
  contender.name = name;
  Result<std::unique_ptr<JobSystem>> jobs = makeThreadPool(threads);
  if (!jobs) return jobs.error();
  WorldOptions options;
  options.backend = backend;
  Result<std::unique_ptr<Backend>> made = backendOf(options, **jobs);
  if (!made) {
    if (made.error().code != Code::unsupported) return made.error();
    contender.reason = made.error().message;
    return contender;
  }
  const BackendCapabilities& capabilities = (*made)->capabilities();
  if (capabilities.software && !named) {
    contender.reason = fmt::format("{} is software, which is measured only when asked for: --backend {}",
                                   capabilities.device, backend);
    return contender;
  }
  contender.device = capabilities.device;
  if (capabilities.kind == BackendKind::cpu) contender.workers = capabilities.concurrency;
  contender.jobs = std::move(*jobs);
  contender.backend = std::move(*made);
  return contender;
}

/// The sequential one, and one a backend; all of these where none is named.
Result<std::vector<Contender>> makeContenders(const BenchOptions& options) {
  std::vector<Contender> contenders;
  Result<Contender> sequential = makeContender("sequential", "cpu", true, 1);
  if (!sequential) return sequential.error();
  contenders.push_back(std::move(*sequential));
  for (const char* backend : {"cpu", "vulkan", "cuda"}) {
    const bool named = std::find(options.backends.begin(), options.backends.end(), backend) != options.backends.end();
    if (!named && !options.backends.empty()) continue;
    Result<Contender> made = makeContender(backend, backend, named, options.threads);
    if (!made) return made.error();
    contenders.push_back(std::move(*made));
  }
  return contenders;
}

Result<int32_t> cellOf(const BenchOptions& options, const StageModel& model) {
  WorldOptions cell;
  cell.cell = options.cell.value_or(static_cast<double>(model.edge) / static_cast<double>(options.cells));
  return cellUnits(cell);
}

Result<StageResult> measure(const BenchOptions& options, const StageModel& model, int32_t cell,
                            std::span<const Contender> contenders) {
  const auto measured = static_cast<uint64_t>(std::count_if(
      contenders.begin(), contenders.end(), [](const Contender& contender) { return contender.backend != nullptr; }));
  ProgressBar bar(fmt::format("measuring the {}", model.name));
  uint64_t done = 0;
  return measureStage(model, cell, options.runs, contenders, [&] { bar.show(++done, measured * (options.runs + 1)); });
}

}  // namespace

Exit benchPaper(const BenchOptions& options) {
  std::vector<StageResult> results;
  for (const StageModel& model : stageModels()) {
    const Result<int32_t> cell = cellOf(options, model);
    if (!cell) return complain(cell.error());
    // Devices of its own, as in a process that generates this stage alone: software is made ready for the kinds of
    // instruction that it has met so far, and each costs it time whether it is there or not.
    const Result<std::vector<Contender>> contenders = makeContenders(options);
    if (!contenders) return complain(contenders.error());
    Result<StageResult> result = measure(options, model, *cell, *contenders);
    if (!result) return complain(result.error());
    results.push_back(std::move(*result));
  }
  if (options.json) {
    fmt::print("{}\n", toJson(options, results).text());
  } else {
    print(options, results);
  }
  // What was asked for by name and is not here has its row, and is an error as it is for the other commands.
  Exit status = Exit::done;
  for (const StageRow& row : results.back().rows) {
    if (!row.measured() && !options.backends.empty())
      status = complain(Exit::backend, fmt::format("{}: {}", row.name, row.reason));
  }
  return status;
}

}  // namespace sgm::cli
