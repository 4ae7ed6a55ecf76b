#include "tools/cli/classify/classification.h"

#include <fmt/core.h>

#include <algorithm>

#include "tools/cli/classify/master_key.h"

namespace sgm::cli {
namespace {

using measure::ClassDistance;
using measure::Master;
using measure::MasterKey;

/// Returns the set's key for a histogram mode and a mesh. density: the mesh's grid cells per metre; 0 if unknown.
Result<MasterKey> keyFor(const std::string& mode, const masters::MasterSet& set, double density) {
  std::string there;
  for (const measure::MasterLimits& limits : set.limits) {
    const MasterKey& key = limits.key;
    const bool ours = key.version == measure::kMasterVersion;
    there +=
        fmt::format("{}{}{}", there.empty() ? "" : "; ", textOf(key),
                    ours ? "" : fmt::format(" (of version {}: build them again with sgm masters build)", key.version));
    if (!ours) continue;
    if (measure::nameOf(key.mode) != mode) continue;
    if (key.density == 0 || key.density == density) return key;
  }
  if (mode != measure::nameOf(measure::HistogramMode::curvature) && density == 0) {
    return Error{Code::invalid_argument,
                 "mode " + mode + " depends on the density: give the cells per metre of the mesh with --ld"};
  }
  return Error{
      Code::invalid_argument,
      fmt::format("there are no reference histograms for mode {} at {:.6g} cells per metre; there are some for: {}",
                  mode, density, there)};
}

}  // namespace

Result<Classified> classifyTriangles(const asset::TriangleMesh& mesh, const std::string& mode, double density,
                                     const masters::OpenedBase& base, JobSystem& jobs) {
  const Result<MasterKey> key = keyFor(mode, base.set, density);
  if (!key) return key.error();
  Result<measure::Histogram> histogram = measure::innerHistogram({mesh.points, mesh.triangles}, key->settings(), jobs);
  if (!histogram) return histogram.error();
  const measure::MasterLimits& limits = *base.set.limitsOf(*key);
  const std::vector<Master> masters = base.set.of(*key);
  Result<measure::Classification> said = measure::classify(histogram->shares, *key, masters, limits);
  if (!said) return said.error();
  Classified classified{std::move(*said), limits, std::move(*histogram), base.from, {}};
  for (const ClassDistance& of : classified.said.classes) {
    const auto is_nearest = [&of](const Master& m) { return m.class_name == of.class_name && m.name == of.nearest; };
    const auto found = std::ranges::find_if(masters, is_nearest);
    if (found != masters.end()) classified.nearest.push_back(*found);
  }
  return classified;
}

Json toJson(const Classified& classified) {
  const measure::Classification& said = classified.said;
  Json classes = Json::array();
  for (const ClassDistance& of : said.classes) {
    classes.push_back({{"class", of.class_name}, {"mse", of.mse}, {"emd", of.emd}, {"nearest", of.nearest}});
  }
  return {{"class", said.verdict},
          {"reason", said.reason.empty() ? Json(nullptr) : Json(said.reason)},
          {"margin", said.margin},
          {"second_opinion", said.second_opinion},
          {"classes", classes},
          {"limits", {{"mse", classified.limits.mse}, {"emd", classified.limits.emd}}},
          {"key", toJson(classified.limits.key)},
          {"masters", classified.from},
          {"shares", classified.histogram.shares},
          {"edges", classified.histogram.edges},
          {"left_out", classified.histogram.left_out}};
}

std::string textOf(const Classified& classified, const std::string& what) {
  const measure::Classification& said = classified.said;
  std::string text = said.reason.empty()
                         ? fmt::format("{}: {}, by a margin of {:.2f}\n", what, said.verdict, said.margin)
                         : fmt::format("{}: {}: {}\n", what, said.verdict, said.reason);
  text += fmt::format("  {:<12}{:>10}{:>9}  nearest reference\n", "class", "MSE", "EMD");
  for (const ClassDistance& of : said.classes) {
    text += fmt::format("  {:<12}{:>10.6f}{:>9.4f}  {}\n", of.class_name, of.mse, of.emd, of.nearest);
  }
  text += fmt::format("  by the earth mover's distance: {}\n", said.second_opinion);
  return text + fmt::format("  reference histograms: {}, for {}\n", classified.from, textOf(classified.limits.key));
}

}  // namespace sgm::cli
