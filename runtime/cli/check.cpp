// sgm check: is a grammar right?

#include <fmt/core.h>

#include <nlohmann/json.hpp>

#include "cli/commands.h"
#include "cli/source.h"

namespace sgm::cli {
namespace {

using Json = nlohmann::ordered_json;

struct CheckOptions {
  std::vector<std::string> files;
  bool json = false;
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
    if (param.doc != kNoId) json["doc"] = program.text(param.doc);
    parameters.push_back(std::move(json));
  }
  Json layers = Json::array();
  for (const Layer& layer : program.layers) {
    const auto metres = [](int32_t units) { return static_cast<double>(units) / kUnitsPerMetre; };
    layers.push_back({{"name", program.text(layer.name)},
                      {"cell", {metres(layer.cell.x), metres(layer.cell.y), metres(layer.cell.z)}},
                      {"reach", metres(layer.reach)}});
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

Exit check(const CheckOptions& options) {
  Exit status = Exit::done;
  Json all = Json::array();
  for (const std::string& file : options.files) {
    const Result<CompileResult> compiled = compileFile(file);
    if (!compiled) {
      status = complain(compiled.error());
      if (options.json) all.push_back({{"file", file}, {"ok", false}, {"error", compiled.error().message}});
      continue;
    }
    const bool ok = compiled->program != nullptr;
    if (!ok && status == Exit::done) status = Exit::input;
    if (options.json) {
      Json json{{"file", file}, {"ok", ok}, {"diagnostics", Json::array()}};
      for (const Diagnostic& d : compiled->diagnostics) json["diagnostics"].push_back(toJson(d));
      if (ok) json.update(describe(*compiled->program));
      all.push_back(std::move(json));
    } else {
      fmt::print(stderr, "{}", renderDiagnostics(*compiled));
      if (!ok) {
        fmt::print("{}: {}\n", file, countDiagnostics(compiled->diagnostics));
      } else if (compiled->diagnostics.empty()) {
        fmt::print("{}: ok\n", file);
      } else {
        fmt::print("{}: ok, {}\n", file, countDiagnostics(compiled->diagnostics));
      }
    }
  }
  if (options.json) fmt::print("{}\n", Json{{"ok", status == Exit::done}, {"files", std::move(all)}}.dump(2));
  return status;
}

}  // namespace

Command addCheck(CLI::App& root) {
  CLI::App* app = root.add_subcommand("check", "Check grammars and say what is wrong, with line and column");
  const auto options = std::make_shared<CheckOptions>();
  app->add_option("FILE", options->files, "Grammars, .sgm files")->required();
  app->add_flag("--json", options->json, "Print messages, parameters and layers as JSON on standard output");
  app->footer("Example:\n  sgm check samples/grammars/cave.sgm");
  return [options] { return check(*options); };
}

}  // namespace sgm::cli
