// The part of the report about table 4 of the paper: represents each system in the table by a grammar, and checks each
// YES of the table by a measurement.

#include <fmt/core.h>

#include <optional>

#include "region/topology.h"
#include "tools/classify/build.h"
#include "tools/cli/classify/master_key.h"
#include "tools/cli/measure/commands.h"
#include "tools/paper/command_line.h"
#include "tools/paper/parts.h"
#include "tools/paper/report_context.h"
#include "tools/paper/table4.h"
#include "tools/support/measured_mesh.h"
#include "tools/support/render_options.h"

namespace sgm::cli {
namespace {

/// The result of our measurement for one criterion of table 4.
struct Finding {
  enum class Said { yes, no, none } said = Said::none;
  std::string what;
  std::string command;  ///< command line that repeats the measurement; empty: none
};
using Findings = std::array<Finding, kCriteria>;

Finding finding(bool holds, std::string what, std::string command) {
  return {holds ? Finding::Said::yes : Finding::Said::no, std::move(what), std::move(command)};
}

bool saysYes(const char* printed) { return std::string_view(printed).starts_with("YES"); }

WorldOptions optionsFor(const ReportContext& report_context, const ComparedSystem& system) {
  WorldOptions options = report_context.on(system.grammar);
  options.region = system.region;
  options.cell = report_context.pick(system.cell, system.quick_cell);
  return options;
}

size_t trianglesOf(const WorldMesh& mesh) { return mesh.indices.size() / 3; }

/// Tests whether another value of a parameter changes the mesh. set: assignment NAME=VALUE.
Result<Finding> changedBy(const ReportContext& report_context, const WorldOptions& options, const Region& base,
                          const char* set) {
  WorldOptions changed = options;
  changed.sets.emplace_back(set);
  const Result<Region> region = report_context.mesh(changed);
  if (!region) return region.error();
  const bool another = region->meshed.hash != base.meshed.hash;
  return finding(another,
                 fmt::format("{}: {} triangles become {}, with {} hash", set, trianglesOf(base.meshed.mesh),
                             trianglesOf(region->meshed.mesh), another ? "another" : "the same"),
                 commandOf("mesh", changed));
}

Result<Finding> classified(const ReportContext& report_context, const asset::TriangleMesh& mesh,
                           const WorldOptions& options, const char* expected) {
  const measure::MasterKey key = masters::defaultKey();
  const masters::MasterSet set = masters::builtInMasters();
  const Result<measure::Histogram> histogram =
      measure::innerHistogram({mesh.points, mesh.triangles}, key.settings(), report_context.jobs());
  if (!histogram) return histogram.error();
  const Result<measure::Classification> said =
      measure::classify(histogram->shares, key, set.of(key), *set.limitsOf(key));
  if (!said) return said.error();
  return finding(said->verdict == expected, fmt::format("classified as {}", said->verdict),
                 commandOf("classify", options));
}

Result<Findings> findingsOf(const ReportContext& report_context, const ComparedSystem& system) {
  Findings found;
  const WorldOptions options = optionsFor(report_context, system);
  const Result<Region> region = report_context.mesh(options, true);
  if (!region) return region.error();
  const WorldMesh& mesh = region->meshed.mesh;
  const asset::TriangleMesh triangles = cli::trianglesOf(*region);
  measure::MeshSettings settings;
  settings.self_intersections = false;
  const Result<measure::MeshMeasures> measured =
      measure::measureMesh({triangles.points, triangles.triangles}, settings, report_context.jobs());
  if (!measured) return measured.error();

  constexpr std::array<const char*, 3> kClasses = {"cloud", "building", "cave"};
  for (const Criterion kind : {kClouds, kArchitecture, kCaves}) {
    if (!saysYes(system.printed[kind])) {
      found[kind].what = "this grammar makes no such models";
      continue;
    }
    WorldOptions looked_at = options;
    std::optional<Region> excerpt;
    if (const Excerpt& of = system.excerpts[kind]; of.region != nullptr) {
      looked_at.region = of.region;
      looked_at.cell = of.cell;
      Result<Region> meshed = report_context.mesh(looked_at);
      if (!meshed) return meshed.error();
      excerpt = std::move(*meshed);
    }
    Result<Finding> verdict =
        classified(report_context, excerpt ? cli::trianglesOf(*excerpt) : triangles, looked_at, kClasses[kind]);
    if (!verdict) return verdict.error();
    found[kind] = std::move(*verdict);
  }
  WorldOptions coarse = options;
  coarse.level = 1;
  const Result<Region> far = report_context.mesh(coarse);
  if (!far) return far.error();
  found[kDetail] =
      finding(trianglesOf(far->meshed.mesh) < trianglesOf(mesh),
              fmt::format("level 0: {} triangles, level 1: {}", trianglesOf(mesh), trianglesOf(far->meshed.mesh)),
              commandOf("mesh", coarse));
  Result<Finding> control = changedBy(report_context, options, *region, system.control);
  if (!control) return control.error();
  found[kControl] = std::move(*control);
  if (system.morph != nullptr) {
    Result<Finding> morph = changedBy(report_context, options, *region, system.morph);
    if (!morph) return morph.error();
    found[kMorphing] = std::move(*morph);
  } else {
    found[kMorphing].what = "not in this grammar; any grammar can morph by a morphic rule, as in figure 8";
  }
  WorldOptions unwrapped = options;
  unwrapped.uv = true;
  const double density = region->texture->density.middle;
  found[kTexture] = finding(density >= 0.5 && density <= 2,
                            fmt::format("coordinates in tiles of 1 m, scaled by {:.2f} at the median", density),
                            commandOf("mesh", unwrapped));
  MeasureOptions judged = report_context.on<MeasureOptions>(system.grammar);
  static_cast<WorldOptions&>(judged) = options;
  judged.no_self_intersections = true;
  judged.json = true;
  found[kHidden] =
      finding(measured->nesting.nested == 0,
              fmt::format("{} closed parts in the solid of others", measured->nesting.nested), commandOf(judged));
  found[kOverlapping] =
      finding(measured->welded_points == 0,
              fmt::format("{} of {} vertices at the position of another", measured->welded_points, measured->points),
              commandOf(judged));
  const Topology topology = topologyOf(mesh, region->meshed.extent);
  const char* closed = isCut(*region) ? "watertight except at the border" : "watertight";
  found[kHoles] = finding(topology.watertight, topology.watertight ? closed : topology.leak, commandOf(judged));
  return found;
}

const char* signOf(const Finding& finding) {
  switch (finding.said) {
    case Finding::Said::yes:
      return "yes";
    case Finding::Said::no:
      return "no";
    case Finding::Said::none:
      return "–";
  }
  return "";
}

/// The section of the page about one system: its picture, the reasons, the measurements, and the commands.
Markup cardOf(const ComparedSystem& system, const Findings& found, const Markup& picture) {
  std::vector<std::vector<std::string>> rows{{"", "paper", "ours", "measured"}};
  Markup commands;
  for (size_t c = 0; c < kCriteria; ++c) {
    rows.push_back({kCriterionNames[c], system.printed[c], signOf(found[c]), found[c].what});
    if (found[c].said == Finding::Said::none || found[c].command.empty()) continue;
    commands += text(fmt::format("# {}\n{}\n", kCriterionNames[c], found[c].command));
  }
  const Markup proof = element("div", {{"class", "words"}}, table(system.grammar, rows));
  return element("h3", fmt::format("{}: {}", system.name, system.grammar)) + Markup{"\n"} + picture +
         element("p", system.without) + Markup{"\n"} + proof +
         element("details", element("summary", "Commands that repeat the measurements") +
                                element("pre", element("code", commands))) +
         Markup{"\n"};
}

Result<Markup> pictureOf(ReportContext& report_context, const ComparedSystem& system) {
  RenderOptions options = report_context.on<RenderOptions>(system.grammar);
  options.region = system.view_region;
  options.camera = system.camera;
  options.cell = report_context.pick(system.view_cell, system.quick_view_cell);
  options.seed = system.view_seed;
  if (system.view_set != nullptr) options.sets.emplace_back(system.view_set);
  options.sharp = system.sharp;
  // Use a wider field of view inside caves, to show more of them.
  options.fov = saysYes(system.printed[kCaves]) && !saysYes(system.printed[kClouds]) ? 68 : 48;
  options.size = report_context.pick("720x440", "400x250");
  const std::string file = ReportContext::grammarOf(options);
  const std::string stem = file.substr(file.find('/') + 1, file.rfind('.') - file.find('/') - 1);
  std::vector<std::string> command;
  Result<Markup> picture = report_context.picture(options, "table4-" + stem, system.alt, system.alt, command);
  if (!picture) return picture.error();
  for (const std::string& line : command)
    *picture +=
        element("details", element("summary", "Command of the picture") + element("pre", element("code", line)));
  return picture;
}

}  // namespace

ReportItems comparisonPart(ReportContext& report_context) {
  ReportItem report_item;
  report_item.id = "table-4";
  report_item.title = "Table 4. Comparison of methods";
  report_item.printed = {
      "“Table 4. Comparison of methods”: for ten methods, which geometry they make, how they are steered, and how "
      "correct "
      "their meshes are. “LOD: mesh (M), noise (SZ), Simple shapes (P)”.",
      "Its “Removing high surfaces” is read as hidden surfaces, its “Removing overlapping verticals” as vertices."};
  std::vector<std::vector<std::string>> summary{{"paper / ours"}};
  summary[0].insert(summary[0].end(), kCriterionNames.begin(), kCriterionNames.end());
  Markup cards;
  Json systems = Json::array();
  for (const ComparedSystem& system : comparedSystems()) {
    const Result<Findings> found = findingsOf(report_context, system);
    if (!found) return found.error();
    const Result<Markup> picture = pictureOf(report_context, system);
    if (!picture) return picture.error();
    cards += cardOf(system, *found, *picture);
    std::vector<std::string>& row = summary.emplace_back(std::vector<std::string>{system.name});
    Json json{{"system", system.name}, {"grammar", system.grammar}};
    for (size_t c = 0; c < kCriteria; ++c) {
      const std::string printed = system.printed[c];
      row.push_back(fmt::format("{} / {}", printed.substr(0, printed.find('(')), signOf((*found)[c])));
      json["criteria"][kCriterionNames[c]] = {{"paper", printed},
                                              {"ours", signOf((*found)[c])},
                                              {"measured", (*found)[c].what},
                                              {"command", (*found)[c].command}};
    }
    systems.push_back(std::move(json));
  }
  report_item.ours = table("What the paper says, and the measurements of our grammar of that kind", summary) + cards;
  report_item.measured =
      "Each system has its own grammar, modelled on the work that it represents. Detail is measured by meshing level "
      "1, whose cells have twice the edge; control and morphing by another value of a parameter; texture by the "
      "density of the coordinates, whose median must be half to twice the nominal one; surfaces, vertices and holes by "
      "sgm measure, as nested, welded_points, and open_edges in excess of cut_edges, since the border where the region "
      "cuts an endless world is not a hole. A dash means that nothing was measured, or that there is nothing to "
      "measure. The class of a mesh depends on its cells: if they are finer than those of the built-in reference "
      "histograms, a cave may be unknown, and a house a cloud.";
  report_item.commands = {commandOfPart(report_context.options(), "comparison")};
  report_item.numbers = {{"systems", std::move(systems)}};
  return std::vector<ReportItem>{std::move(report_item)};
}

}  // namespace sgm::cli
