// `sgm explain`: reports which rules made the surface or solid at a place.

#include "query/explain.h"

#include <fmt/core.h>

#include <cmath>

#include "base/json.h"
#include "query/queries.h"
#include "tools/cli/grammar/commands.h"
#include "tools/support/console.h"
#include "tools/support/source.h"

namespace sgm::cli {
namespace {

constexpr double kNearSurface = 64 * kUnitsPerMetre;

/// The keyword of the grammar language for a kind of shape.
std::string_view wordFor(ShapeKind kind) {
  switch (kind) {
    case ShapeKind::sphere:
      return "sphere";
    case ShapeKind::box:
      return "box";
    case ShapeKind::cylinder:
      return "cylinder";
    case ShapeKind::truncone:
      return "truncone";
    case ShapeKind::capsule:
      return "capsule";
    case ShapeKind::torus:
      return "torus";
    case ShapeKind::ellipsoid:
      return "ellipsoid";
    case ShapeKind::superquadric:
      return "superq";
    case ShapeKind::halfspace:
      return "halfspace";
    case ShapeKind::prism:
      return "prism";
    case ShapeKind::unite:
    case ShapeKind::unite_smooth:
      return "union";
    case ShapeKind::meet:
    case ShapeKind::meet_smooth:
      return "meet";
    case ShapeKind::subtract:
    case ShapeKind::subtract_smooth:
      return "block with cuts";
    case ShapeKind::sum:
      return "sum";
    case ShapeKind::morph:
    case ShapeKind::morph_power:
      return "morph";
    case ShapeKind::displace:
      return "displace";
    case ShapeKind::warp:
      return "warp";
    case ShapeKind::voxels:
      return "ca";
  }
  return "";
}

double inMetres(double units) { return units / kUnitsPerMetre; }

std::string measureText(const ExplainedNode& node) {
  switch (node.kind) {
    case ShapeKind::unite_smooth:
    case ShapeKind::meet_smooth:
    case ShapeKind::subtract_smooth:
      return fmt::format(" smooth {:.2f} m", inMetres(node.measure));
    case ShapeKind::morph:
      return fmt::format(" at t = {:.3f}", node.measure);
    case ShapeKind::displace:
      return fmt::format(" by {:+.2f} m", inMetres(node.measure));
    case ShapeKind::warp:
      return fmt::format(" by {:.2f} m", inMetres(node.measure));
    default:
      return {};
  }
}

/// The explanation of one place, and the names that are needed to print it.
struct Answer {
  const Program& program;
  std::string_view file;
  Explanation found;

  std::string fileOf(const Span& span) const {
    if (span.file == 0 || span.file >= program.modules.size()) return std::string(file);
    return program.modules[span.file].path.c_str();
  }
  std::string placeOf(const Span& span) const { return fmt::format("{}:{}:{}", fileOf(span), span.line, span.column); }
  std::string material() const { return program.materials[found.material].c_str(); }
  std::string tag() const { return program.tags[found.tag].c_str(); }
};

Json toJson(const Answer& answer) {
  const Explanation& found = answer.found;
  Json json{{"solid", found.solid}};
  if (found.material != 0) json["material"] = answer.material();
  if (found.tag != 0) json["tag"] = answer.tag();
  if (found.nodes.empty()) return json;
  json["layer"] = answer.program.text(answer.program.layers[found.layer].name);
  json["cell"] = Json(std::vector<int32_t>{found.cell.x, found.cell.y, found.cell.z});
  json["path"] = found.nodes[found.leaf].path;
  Json nodes = Json::array();
  for (size_t i = 0; i < found.nodes.size(); ++i) {
    const ExplainedNode& node = found.nodes[i];
    Json one{{"kind", wordFor(node.kind)},
             {"depth", node.depth},
             {"value", inMetres(node.value)},
             {"cuts", node.cuts},
             {"decides", i == found.leaf},
             {"others", node.others},
             {"path", node.path},
             {"file", answer.fileOf(node.span)},
             {"line", node.span.line},
             {"column", node.span.column}};
    if (node.kind == ShapeKind::morph)
      one["t"] = node.measure;
    else if (node.kind == ShapeKind::displace || node.kind == ShapeKind::warp)
      one["by"] = inMetres(node.measure);
    else if (!measureText(node).empty())
      one["smooth"] = inMetres(node.measure);
    nodes.push_back(std::move(one));
  }
  json["nodes"] = std::move(nodes);
  return json;
}

void printNodes(const Answer& answer) {
  const Explanation& found = answer.found;
  size_t widest = 0;
  std::vector<std::string> texts;
  for (const ExplainedNode& node : found.nodes) {
    std::string text(static_cast<size_t>(2 * node.depth), ' ');
    if (node.cuts) text += "cut ";
    text += wordFor(node.kind);
    text += measureText(node);
    if (node.others > 0) text += fmt::format(" ({} more)", node.others);
    widest = std::max(widest, text.size());
    texts.push_back(std::move(text));
  }
  for (size_t i = 0; i < texts.size(); ++i) {
    const ExplainedNode& node = found.nodes[i];
    const char* side = node.value < 0 ? "inside" : "outside";
    fmt::print("  {} {:<{}}  {:7} {:6.2f} m  {}  {}\n", i == found.leaf ? '>' : ' ', texts[i], widest, side,
               std::fabs(inMetres(node.value)), answer.placeOf(node.span), node.path);
  }
}

std::string labelText(const Answer& answer) {
  std::string text = answer.found.material != 0 ? answer.material() : "without material";
  if (answer.found.tag != 0) text += ", tag " + answer.tag();
  return text;
}

/// Explains in one line why the place is solid or void.
std::string reason(const Answer& answer) {
  const Explanation& found = answer.found;
  if (found.nodes.empty()) return "no shape is near, the domain decides";
  const std::string& path = found.nodes[found.leaf].path;
  bool cut = false;
  for (size_t i = 0; i <= found.leaf; ++i) cut = cut || found.nodes[i].cuts;
  if (found.solid) return cut ? "beside the cut by " + path : "made by " + path;
  return cut ? "cut by " + path : "outside of the nearest shape, " + path;
}

void printAnswer(const Answer& answer) {
  if (answer.found.solid)
    fmt::print("solid ({}): {}\n", labelText(answer), reason(answer));
  else
    fmt::print("open: {}\n", reason(answer));
  printNodes(answer);
}

void printSurface(const Answer& answer, const SurfacePoint& point) {
  fmt::print("nearest surface {:.2f} m away at {:.2f},{:.2f},{:.2f} m ({})", inMetres(point.distance),
             inMetres(point.position[0]), inMetres(point.position[1]), inMetres(point.position[2]), labelText(answer));
  if (!answer.found.nodes.empty()) fmt::print(": {}", answer.found.nodes[answer.found.leaf].path);
  fmt::print("\n");
  printNodes(answer);
}

}  // namespace

Exit explain(const ExplainOptions& options) {
  const std::array<double, 3> at = *readPoint(options.at);
  Int3 place;
  for (int axis = 0; axis < 3; ++axis) {
    const double units = std::floor(at[static_cast<size_t>(axis)] * kUnitsPerMetre + 0.5);
    if (!(std::fabs(units) <= 2147483647.0))
      return reportError(Exit::usage,
                         "--at: the place lies outside of the world, which ends about 2,097 km from the origin");
    place[axis] = static_cast<int32_t>(units);
  }
  const Result<int32_t> cell = cellUnits(options);
  if (!cell) return reportError(cell.error());
  const LoadedGrammar grammar = loadGrammar(options.file);
  if (grammar.program == nullptr) return grammar.status;
  Result<ParameterValues> parameters = parameterValues(*grammar.program, options.sets);
  if (!parameters) return reportError(parameters.error());
  WorldFieldSettings settings;
  settings.program = grammar.program;
  settings.parameters = std::move(*parameters);
  settings.seed = options.seed;
  settings.finest_cell = *cell;
  const WorldField world(std::move(settings), std::pmr::new_delete_resource());

  const auto answerAt = [&](Int3 p) -> Result<Answer> {
    Result<Explanation> found = sgm::explain(world, p);
    if (!found) return found.error();
    return Answer{*grammar.program, options.file, std::move(*found)};
  };
  const Result<Answer> here = answerAt(place);
  if (!here) return reportError(here.error());
  const std::array<double, 3> asked{static_cast<double>(place.x), static_cast<double>(place.y),
                                    static_cast<double>(place.z)};
  const double search = std::min(kNearSurface, static_cast<double>(farthestSurface(*cell)));
  const Result<std::optional<SurfacePoint>> surface = closestPoint(queryField(world), asked, search);
  if (!surface) return reportError(surface.error());
  std::optional<Answer> there;
  if (*surface) {
    Int3 p;
    for (int axis = 0; axis < 3; ++axis)
      p[axis] = saturate(static_cast<int64_t>(std::llround((**surface).position[static_cast<size_t>(axis)])));
    Result<Answer> answer = answerAt(p);
    if (!answer) return reportError(answer.error());
    // Rounding the place to units may move it to either side of the surface, so take the material and tag from the
    // surface itself.
    answer->found.material = (**surface).material;
    answer->found.tag = (**surface).tag;
    there.emplace(std::move(*answer));
  }
  if (options.json) {
    Json json{{"file", options.file}, {"at", metresJson(place)}, {"seed", options.seed}};
    json.update(toJson(*here));
    if (there) {
      const SurfacePoint& point = **surface;
      Json nearest{{"distance", inMetres(point.distance)},
                   {"at", Json(std::vector<double>{inMetres(point.position[0]), inMetres(point.position[1]),
                                                   inMetres(point.position[2])})},
                   {"normal", Json(std::vector<double>(point.normal.begin(), point.normal.end()))}};
      nearest.update(toJson(*there));
      json["surface"] = std::move(nearest);
    } else {
      json["surface"] = nullptr;
    }
    fmt::print("{}\n", json.text());
    return Exit::done;
  }
  fmt::print("{},{},{} m, seed {}, cells of {} m\n", metres(place.x), metres(place.y), metres(place.z), options.seed,
             metres(*cell));
  printAnswer(*here);
  if (there)
    printSurface(*there, **surface);
  else
    fmt::print("no surface within {} m\n", inMetres(search));
  return Exit::done;
}

}  // namespace sgm::cli
