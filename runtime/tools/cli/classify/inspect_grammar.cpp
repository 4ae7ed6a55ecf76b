// Meshes an uploaded grammar.

#include <fmt/core.h>

#include <charconv>
#include <string_view>

#include "grammar/compile.h"
#include "region/places.h"
#include "tools/cli/classify/commands.h"
#include "tools/cli/classify/inspect.h"
#include "tools/support/region.h"

namespace sgm::cli {
namespace {

/// Maximum number of chunks that are meshed. `sgm classify` has the same maximum if no region is given; here it also
/// applies to a given region.
constexpr uint64_t kMaxChunks = 4096;

Json diagnosticsJson(const std::vector<Diagnostic>& diagnostics) {
  Json list = Json::array();
  for (const Diagnostic& d : diagnostics) {
    Json one{{"line", d.line},
             {"column", d.column},
             {"message", d.message},
             {"severity", d.severity == Severity::error ? "error" : "warning"}};
    if (!d.hint.empty()) one["hint"] = d.hint;
    list.push_back(std::move(one));
  }
  return list;
}

InspectProblem wrongGrammar(const std::vector<Diagnostic>& diagnostics) {
  InspectProblem problem;
  size_t errors = 0;
  for (const Diagnostic& d : diagnostics) {
    if (d.severity != Severity::error || errors++ > 0) continue;
    problem.line = d.line;
    problem.column = d.column;
    problem.detail = fmt::format("line {}, column {}: {}", d.line, d.column, d.message);
    if (!d.hint.empty()) problem.detail += "; " + d.hint;
  }
  if (errors > 1) problem.detail += fmt::format(" (and {} more errors)", errors - 1);
  problem.diagnostics = diagnosticsJson(diagnostics);
  return problem;
}

/// Adapts a message about an option to the parameter of a request: "--cell: 0 is ..." becomes "cell: 0 is ...".
Error ofParameters(Error error) {
  for (size_t at = 0; (at = error.message.find("--", at)) != std::string::npos;) error.message.erase(at, 2);
  return error;
}

template <class T>
Result<T> numberOf(std::string_view name, const std::string& text, std::string_view wanted) {
  T value{};
  const char* end = text.data() + text.size();
  const auto [rest, why] = std::from_chars(text.data(), end, value);
  if (why == std::errc() && rest == end) return value;
  return Error{Code::invalid_argument, fmt::format("{}: '{}' is not {}", name, text, wanted)};
}

Result<WorldOptions> worldOptions(const InspectOptions& options) {
  WorldOptions world;
  world.file = options.name;
  world.sets = options.sets;
  world.region = options.region;
  world.backend = "cpu";
  world.max_chunks = kMaxChunks;
  if (!options.seed.empty()) {
    const Result<uint64_t> seed = numberOf<uint64_t>("seed", options.seed, "a whole number from 0 to 2^64 - 1");
    if (!seed) return seed.error();
    world.seed = *seed;
  }
  if (!options.cell.empty()) {
    const Result<double> cell = numberOf<double>("cell", options.cell, "a length in metres");
    if (!cell) return cell.error();
    world.cell = *cell;
  }
  for (const std::string& set : options.sets)
    if (set.find('=') == std::string::npos)
      return Error{Code::invalid_argument, fmt::format("set: '{}' is not NAME=VALUE", set)};
  return world;
}

}  // namespace

InspectedGrammar meshUploadedGrammar(std::span<const std::byte> text, const InspectOptions& options) {
  InspectedGrammar result;
  const auto refuse = [&](const Error& error) {
    result.problem = problemOf(ofParameters(error), options);
    return std::move(result);
  };
  const Result<WorldOptions> world = worldOptions(options);
  if (!world) return refuse(world.error());
  // No import resolver is passed, so a grammar can import only the standard library.
  const CompileResult compiled =
      compileGrammar({reinterpret_cast<const char*>(text.data()), text.size()}, options.name, CompileOptions{});
  if (!compiled.program) {
    result.problem = wrongGrammar(compiled.diagnostics);
    return result;
  }
  result.diagnostics = diagnosticsJson(compiled.diagnostics);
  RegionPlan plan;
  plan.choose = [](const WorldField& field) { return blockRegion(*field.settings().program, 1); };
  Result<Region> made = meshProgram(compiled.program, *world, plan);
  if (!made) return refuse(made.error());
  result.measures = toJson(*world, *made);
  result.region = std::move(*made);
  return result;
}

}  // namespace sgm::cli
