// `sgm classify`: classifies a mesh as a cave, a cloud, a building, or unknown.

#include <fmt/core.h>

#include "region/places.h"
#include "tools/classify/base.h"
#include "tools/cli/classify/classification.h"
#include "tools/cli/classify/commands.h"
#include "tools/cli/classify/master_key.h"
#include "tools/support/console.h"
#include "tools/support/measured_mesh.h"

namespace sgm::cli {
namespace {

/// Classifies a mesh, and returns the text to print.
Result<std::string> reportOf(const asset::TriangleMesh& mesh, const ClassifyOptions& options,
                             const masters::OpenedBase& base, double density, Json json) {
  const Result<std::unique_ptr<JobSystem>> jobs = makeThreadPool(options.threads);
  if (!jobs) return jobs.error();
  const Result<Classified> classified = classifyTriangles(mesh, options.mode, density, base, **jobs);
  if (!classified) return classified.error();
  if (!options.json) return textOf(*classified, options.file);
  json.update(toJson(*classified));
  return json.text() + "\n";
}

Exit printOrReportError(const Result<std::string>& text) {
  if (!text) return reportError(text.error());
  fmt::print("{}", *text);
  return Exit::done;
}

/// Classifies a mesh file, and returns the text to print.
Result<std::string> classifyFile(const ClassifyOptions& options) {
  // Open the database of reference histograms before reading untrusted input.
  const Result<masters::OpenedBase> base = mastersOf(options.masters);
  if (!base) return base.error();
  const Result<asset::TriangleMesh> mesh = readMeshFile(options.file);
  if (!mesh) return mesh.error();
  return reportOf(*mesh, options, *base, options.density.value_or(0), {{"file", options.file}, {"notes", mesh->notes}});
}

Exit classifyGrammar(const ClassifyOptions& options) {
  const Result<masters::OpenedBase> base = mastersOf(options.masters);
  if (!base) return reportError(base.error());
  RegionPlan plan;
  plan.choose = [](const WorldField& world) { return blockRegion(*world.settings().program, 1); };
  const RegionResult made = meshRegion(options, plan);
  if (!made.region) return made.status;
  Json json = toJson(options, *made.region);
  json["file"] = options.file;
  return printOrReportError(
      reportOf(trianglesOf(*made.region), options, *base, 1 / metres(made.region->cell), std::move(json)));
}

}  // namespace

Result<masters::OpenedBase> mastersOf(const std::string& file) {
  if (file.empty()) {
    Result<masters::OpenedBase> base = masters::openBase(masters::defaultBase());
    if (base && !base->notice.empty()) fmt::print(stderr, "sgm: warning: {}\n", base->notice);
    return base;
  }
  // Unlike the default database, a file that the user names is never renamed, even if it is damaged.
  masters::ReadBase read = masters::readBase(file);
  if (read.damage == masters::Damage::none) return masters::OpenedBase{std::move(*read.set), file, {}};
  const bool io = read.damage == masters::Damage::io;
  return Error{
      io ? Code::io : Code::bad_input,
      io ? fmt::format("cannot read {}: {}", file, read.what)
         : fmt::format("{} is not a database of reference histograms: {}; make one with sgm masters build --out FILE",
                       file, read.what)};
}

Exit classifyMesh(const ClassifyOptions& options) {
  if (options.sandbox.sandboxed) return answerFromSandbox(options.sandbox, [&] { return classifyFile(options); });
  return isGrammarFile(options.file) ? classifyGrammar(options) : printOrReportError(askSandbox(options.sandbox));
}

}  // namespace sgm::cli
