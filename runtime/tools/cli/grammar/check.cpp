// `sgm check`: checks grammars, and, with --expect, whether their worlds satisfy their expectations.

#include <fmt/core.h>

#include <algorithm>
#include <optional>

#include "base/json.h"
#include "tools/cli/grammar/commands.h"
#include "tools/cli/grammar/expectations.h"
#include "tools/support/console.h"
#include "tools/support/region.h"
#include "tools/support/source.h"

namespace sgm::cli {
namespace {

constexpr size_t kMaxSeeds = 10;  ///< maximum number of seeds that a message names

/// Resources for `sgm check --expect`, shared by all checked files.
struct ReportContext {
  std::unique_ptr<JobSystem> jobs;
  std::unique_ptr<Backend> backend;
};

Json toJson(const Diagnostic& d) {
  Json json{{"severity", d.severity == Severity::error ? "error" : "warning"},
            {"code", d.code},
            {"file", d.file},
            {"line", d.line},
            {"column", d.column},
            {"end_column", d.end_column},
            {"message", d.message}};
  if (!d.hint.empty()) json["hint"] = d.hint;
  if (!d.notes.empty()) json["notes"] = d.notes;
  return json;
}

Json describe(const Program& program) {
  Json parameters = Json::array();
  for (const Param& param : program.params) {
    Json json{{"name", program.text(param.name)}, {"default", param.value}, {"dimension", dimName(param.dim)}};
    if (param.has_range) json["range"] = {param.low, param.high};
    if (param.whole) json["whole"] = true;
    if (param.animated) json["animated"] = true;
    if (param.doc != kNoId) json["doc"] = program.text(param.doc);
    parameters.push_back(std::move(json));
  }
  Json layers = Json::array();
  for (const Layer& layer : program.layers) {
    layers.push_back(
        {{"name", program.text(layer.name)}, {"cell", metresJson(layer.cell)}, {"reach", metres(layer.reach)}});
  }
  Json materials = Json::array(), tags = Json::array();
  for (size_t i = 1; i < program.materials.size(); ++i) materials.push_back(program.materials[i].c_str());
  for (size_t i = 1; i < program.tags.size(); ++i) tags.push_back(program.tags[i].c_str());
  return {{"hash", fmt::format("{:016x}", program.hash)},
          {"rules", program.rules.size()},
          {"parameters", std::move(parameters)},
          {"layers", std::move(layers)},
          {"materials", std::move(materials)},
          {"tags", std::move(tags)}};
}

/// Texts such as "2 statements fail" or "fails with seeds 2, 7, of 10 from 0 on".
std::string failureText(const ExpectationSummary& summary, const CheckOptions& options) {
  if (options.seeds == 1)
    return summary.failed == 1 ? "1 statement fails" : fmt::format("{} statements fail", summary.failed);
  std::string text = summary.bad_seeds.size() == 1 ? "fails with seed " : "fails with seeds ";
  for (size_t i = 0; i < std::min(kMaxSeeds, summary.bad_seeds.size()); ++i)
    text += fmt::format("{}{}", i == 0 ? "" : ", ", summary.bad_seeds[i]);
  if (summary.bad_seeds.size() > kMaxSeeds) text += fmt::format(" and {} more", summary.bad_seeds.size() - kMaxSeeds);
  return text + fmt::format(", of {} from {} on", options.seeds, options.seed);
}

/// Texts such as "ok", "ok, 2 warnings" or "ok, its 2 expectations hold with 10 seeds".
std::string successText(const CheckResult& checked, const ExpectationSummary* summary, uint64_t seeds) {
  std::string text = checked.library ? "ok, a library without a start" : "ok";
  const std::vector<Diagnostic>& said = checked.compiled.diagnostics;
  if (!said.empty()) text += ", " + countDiagnostics(said);
  if (summary == nullptr) return text;
  if (summary->expectations == 0) return text + ", no expectation";
  text += summary->expectations == 1 ? ", its expectation holds"
                                     : fmt::format(", its {} expectations hold", summary->expectations);
  return seeds == 1 ? text : text + fmt::format(" with {} seeds", seeds);
}

}  // namespace

Exit check(const CheckOptions& options) {
  Exit status = Exit::done;
  Json all = Json::array();
  ReportContext report_context;
  if (options.expect) {
    Result<std::unique_ptr<JobSystem>> jobs = makeThreadPool(options.threads);
    if (!jobs) return reportError(jobs.error());
    report_context.jobs = std::move(*jobs);
    Result<std::unique_ptr<Backend>> backend = backendOf(options, *report_context.jobs);
    if (!backend) return reportError(backend.error());
    report_context.backend = std::move(*backend);
  }
  for (const std::string& file : options.files) {
    const Result<CheckResult> checked = [&] {
      const ProgressBar bar("checking");
      return checkFileOnDisk(file);
    }();
    if (!checked) {
      status = std::max(status, reportError(checked.error()));
      if (options.json)
        all.push_back(
            {{"file", file}, {"ok", false}, {"diagnostics", Json::array()}, {"error", checked.error().message}});
      continue;
    }
    const CompileResult* const compiled = &checked->compiled;
    const bool ok = compiled->program != nullptr;
    if (!ok) status = std::max(status, Exit::input);
    if (!options.json) fmt::print(stderr, "{}", renderDiagnostics(*compiled));
    std::optional<ExpectationSummary> summary;
    if (ok && options.expect && !checked->library)
      summary = sayExpectations(*compiled, options, options.seeds, *report_context.backend, *report_context.jobs);
    const bool holds = !summary || summary->status == Exit::done;
    if (!holds) status = std::max(status, summary->status);
    if (options.json) {
      Json json{{"file", file}, {"ok", ok && holds}, {"diagnostics", Json::array()}};
      for (const Diagnostic& d : compiled->diagnostics) json["diagnostics"].push_back(toJson(d));
      if (ok) json.update(describe(*compiled->program));
      if (ok) json["library"] = checked->library;
      if (summary) json["expectations"] = std::move(summary->statements);
      all.push_back(std::move(json));
    } else if (!ok) {
      fmt::print("{}: {}\n", file, countDiagnostics(compiled->diagnostics));
    } else if (holds) {
      fmt::print("{}: {}\n", file, successText(*checked, summary ? &*summary : nullptr, options.seeds));
    } else if (summary->failed > 0) {
      fmt::print("{}: {}\n", file, failureText(*summary, options));
    }
  }
  if (options.json) fmt::print("{}\n", Json{{"ok", status == Exit::done}, {"files", std::move(all)}}.text());
  return status;
}

}  // namespace sgm::cli
