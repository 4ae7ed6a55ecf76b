// sgm classify: whether a mesh is a cave, a cloud, a building, or none of these.

#include <fmt/core.h>

#include "cli/commands.h"
#include "cli/limited_process.h"
#include "cli/master_key.h"
#include "cli/measured_mesh.h"
#include "masters/base.h"
#include "metrics/places.h"

namespace sgm::cli {
namespace {

using measure::ClassDistance;
using measure::Classification;
using measure::MasterKey;

/// The key that masters have for the mode that is asked for; density: cells per metre of the mesh, 0 where it is not
/// known.
Result<MasterKey> keyFor(const ClassifyOptions& options, const masters::MasterSet& set, double density) {
  std::string there;
  for (const measure::MasterLimits& limits : set.limits) {
    const MasterKey& key = limits.key;
    there += fmt::format("{}{}", there.empty() ? "" : "; ", textOf(key));
    if (measure::nameOf(key.mode) != options.mode) continue;
    if (key.density == 0 || key.density == density) return key;
  }
  if (options.mode != measure::nameOf(measure::HistogramMode::curvature) && density == 0) {
    return Error{
        Code::invalid_argument,
        "mode " + options.mode + " depends on the density: say with --ld how many cells per metre the mesh has"};
  }
  return Error{Code::invalid_argument,
               fmt::format("there are no masters for mode {} at {:.6g} cells per metre, but for: {}", options.mode,
                           density, there)};
}

std::string lines(const Classification& said, const MasterKey& key, const std::string& what, const std::string& from) {
  std::string text = said.reason.empty()
                         ? fmt::format("{}: {}, by a margin of {:.2f}\n", what, said.verdict, said.margin)
                         : fmt::format("{}: {}: {}\n", what, said.verdict, said.reason);
  text += fmt::format("  {:<12}{:>10}{:>9}  nearest master\n", "class", "MSE", "EMD");
  for (const ClassDistance& of : said.classes) {
    text += fmt::format("  {:<12}{:>10.6f}{:>9.4f}  {}\n", of.class_name, of.mse, of.emd, of.nearest);
  }
  text += fmt::format("  the earth mover's distance says {}\n", said.second_opinion);
  return text + fmt::format("  masters: {}, for {}\n", from, textOf(key));
}

Json jsonOf(const Classification& said, const MasterKey& key, const measure::MasterLimits& limits,
            const measure::Histogram& histogram, const std::string& from) {
  Json classes = Json::array();
  for (const ClassDistance& of : said.classes) {
    classes.push_back({{"class", of.class_name}, {"mse", of.mse}, {"emd", of.emd}, {"nearest", of.nearest}});
  }
  return {{"class", said.verdict},
          {"reason", said.reason.empty() ? Json(nullptr) : Json(said.reason)},
          {"margin", said.margin},
          {"second_opinion", said.second_opinion},
          {"classes", classes},
          {"limits", {{"mse", limits.mse}, {"emd", limits.emd}}},
          {"key", toJson(key)},
          {"masters", from},
          {"shares", histogram.shares},
          {"edges", histogram.edges},
          {"left_out", histogram.left_out}};
}

/// What is printed of a mesh.
Result<std::string> classified(const asset::TriangleMesh& mesh, const ClassifyOptions& options,
                               const masters::OpenedBase& base, double density, Json json) {
  const Result<MasterKey> key = keyFor(options, base.set, density);
  if (!key) return key.error();
  const Result<std::unique_ptr<JobSystem>> jobs = makeThreadPool(options.threads);
  if (!jobs) return jobs.error();
  const Result<measure::Histogram> histogram =
      measure::innerHistogram({mesh.points, mesh.triangles}, key->settings(), **jobs);
  if (!histogram) return histogram.error();
  const measure::MasterLimits& limits = *base.set.limitsOf(*key);
  const Result<Classification> said = measure::classify(histogram->shares, *key, base.set.of(*key), limits);
  if (!said) return said.error();
  if (!options.json) return lines(*said, *key, options.file, base.from);
  json.update(jsonOf(*said, *key, limits, *histogram, base.from));
  return json.text() + "\n";
}

Exit printOrComplain(const Result<std::string>& text) {
  if (!text) return complain(text.error());
  fmt::print("{}", *text);
  return Exit::done;
}

Exit classifyGrammar(const ClassifyOptions& options, const masters::OpenedBase& base) {
  RegionPlan plan;
  plan.choose = [](const WorldField& world) { return blockRegion(*world.settings().program, 1); };
  const RegionResult made = meshRegion(options, plan);
  if (!made.region) return made.status;
  Json json = toJson(options, *made.region);
  json["file"] = options.file;
  return printOrComplain(
      classified(trianglesOf(*made.region), options, base, 1 / metres(made.region->cell), std::move(json)));
}

}  // namespace

Result<masters::OpenedBase> mastersOf(const std::string& file) {
  if (file.empty()) {
    Result<masters::OpenedBase> base = masters::openBase(masters::defaultBase());
    if (base && !base->notice.empty()) fmt::print(stderr, "sgm: warning: {}\n", base->notice);
    return base;
  }
  // A file that is named may be anything: it is not moved out of its place.
  masters::ReadBase read = masters::readBase(file);
  if (read.damage == masters::Damage::none) return masters::OpenedBase{std::move(*read.set), file, {}};
  const bool io = read.damage == masters::Damage::io;
  return Error{
      io ? Code::io : Code::bad_input,
      io ? fmt::format("cannot read {}: {}", file, read.what)
         : fmt::format("{} is no base of masters: {}; sgm masters build --out FILE makes one", file, read.what)};
}

Exit classifyMesh(const ClassifyOptions& options) {
  const bool grammar = isGrammarFile(options.file);
  const Result<asset::MeshFileKind> kind =
      grammar ? asset::MeshFileKind{} : asset::meshFileKind(std::string_view(options.file));
  if (!kind) return complain(Exit::usage, kind.error().message + "; or a grammar, .sgm");
  const Result<masters::OpenedBase> base = mastersOf(options.masters);
  if (!base) return complain(base.error());
  if (grammar) return classifyGrammar(options, *base);
  ProcessLimits limits;
  limits.memory = options.memory << 20;
  limits.seconds = options.seconds;
  return printOrComplain(runLimited(
      [&]() -> Result<std::string> {
        const Result<asset::TriangleMesh> mesh = readMeshFile(options.file, *kind);
        if (!mesh) return mesh.error();
        return classified(*mesh, options, *base, options.density.value_or(0), {{"file", options.file}});
      },
      limits));
}

}  // namespace sgm::cli
