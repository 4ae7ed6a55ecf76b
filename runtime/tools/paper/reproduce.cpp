// `sgm paper`: makes all parts of the report.

#include <fmt/core.h>

#include <algorithm>

#include "sgm/sgm.h"
#include "tools/paper/bundle.h"
#include "tools/paper/commands.h"
#include "tools/paper/folder.h"
#include "tools/paper/parts.h"
#include "tools/paper/report_context.h"
#include "tools/paper/report_page.h"
#include "tools/support/console.h"
#include "tools/support/ending_signals.h"
#include "tools/support/options.h"

namespace sgm::cli {
namespace {

/// Sort key of a report item: figures by number first, then tables by number.
std::pair<bool, int> orderOf(const ReportItem& report_item) {
  return {report_item.id.starts_with("table"), std::stoi(report_item.id.substr(report_item.id.find('-') + 1))};
}

std::vector<Part> wantedParts(const PaperOptions& options) {
  std::vector<Part> parts;
  for (const Part& part : kParts)
    if (options.only.empty() || std::ranges::find(options.only, part.name) != options.only.end()) parts.push_back(part);
  return parts;
}

Result<std::vector<ReportItem>> makeReportItems(const PaperOptions& options, ReportContext& report_context) {
  std::vector<ReportItem> all;
  const std::vector<Part> parts = wantedParts(options);
  for (size_t i = 0; i < parts.size(); ++i) {
    report_context.begin(fmt::format("[{}/{}] {}", i + 1, parts.size(), parts[i].name));
    Result<std::vector<ReportItem>> made = parts[i].make(report_context);
    if (!made) return made.error();
    std::ranges::move(*made, std::back_inserter(all));
  }
  std::ranges::sort(all, {}, orderOf);
  return all;
}

/// The name of the device on which the report is meshed. Error if the requested backend is missing.
Result<std::string> meshingDevice(const PaperOptions& options, JobSystem& jobs) {
  WorldOptions world;
  world.backend = options.backend;
  const Result<std::unique_ptr<Backend>> backend = backendOf(world, jobs);
  if (!backend) return backend.error();
  const BackendCapabilities& capabilities = (*backend)->capabilities();
  return fmt::format("{} on {}", backendName(capabilities.kind), capabilities.device);
}

Json numbersOf(const ReportFacts& facts, const std::vector<ReportItem>& report_items) {
  Json json{{"quick", facts.quick}};
  for (const auto& [name, what] : facts.machine) json["machine"][name] = what;
  for (const ReportItem& report_item : report_items) json["exhibits"][report_item.id] = report_item.numbers;
  return json;
}

}  // namespace

std::vector<std::string> paperParts() {
  std::vector<std::string> names;
  for (const Part& part : kParts) names.emplace_back(part.name);
  return names;
}

Exit reproducePaper(const PaperOptions& options) {
  const Stopwatch watch;
  // Check the output folder first, since making the report takes minutes.
  if (const Result<void> writable = checkReportFolder(options.out, &ending_signals); !writable)
    return reportError(writable.error());
  const Result<std::unique_ptr<JobSystem>> jobs = makeThreadPool(options.threads);
  if (!jobs) return reportError(jobs.error());
  const Result<std::string> device = meshingDevice(options, **jobs);
  if (!device) return reportError(device.error());
  std::optional<Renderer> renderer;
  if (!options.no_pictures) {
    Result<Renderer> made = Renderer::create();
    if (!made) {
      return reportError(exitOf(made.error().code),
                         fmt::format("{}; or use --no-pictures for a report without pictures", made.error().message));
    }
    renderer.emplace(std::move(*made));
  }

  ReportContext report_context(options, **jobs, renderer ? &*renderer : nullptr);
  const Result<std::vector<ReportItem>> report_items = makeReportItems(options, report_context);
  if (!report_items) return reportError(report_items.error());

  ReportFacts facts;
  facts.quick = options.quick;
  facts.pictures = !options.no_pictures;
  facts.whole = options.only.empty();
  facts.machine = {{"Program", fmt::format("sgm {}", sgm_version_string())},
                   {"Meshed by", *device},
                   {"Threads", fmt::format("{}", (*jobs)->concurrency())},
                   {"Drawn by", renderer ? renderer->info().name : "nothing"},
                   {"Seed", fmt::format("{}", options.seed)}};
  std::vector<FolderFile> files = report_context.pictures();
  for (const BundledFile& file : bundledFiles())
    files.push_back({fmt::format("grammars/{}", file.path), std::string(file.bytes)});
  files.push_back({kReportPage, reportPage(facts, *report_items)});
  if (const Result<void> written = writeReportFolder(options.out, std::move(files), &ending_signals); !written)
    return reportError(written.error());
  if (options.json) {
    fmt::print("{}\n", numbersOf(facts, *report_items).text());
  } else {
    fmt::print("{}: {} figures and tables, {} pictures, {:.0f} s\n",
               (std::filesystem::path(options.out) / kReportPage).string(), report_items->size(),
               report_context.pictures().size(), watch.seconds());
  }
  return Exit::done;
}

}  // namespace sgm::cli
