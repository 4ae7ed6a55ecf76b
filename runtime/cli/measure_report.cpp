#include "cli/measure_report.h"

#include <fmt/core.h>

#include <algorithm>
#include <string_view>

namespace sgm::cli {
namespace {

using measure::MeshMeasures;
using measure::Point;
using measure::Shell;

constexpr size_t kMostShells = 16;

Json pointJson(Point p) { return {p.x, p.y, p.z}; }

template <class T>
Json orNull(const std::optional<T>& value) {
  return value ? Json(*value) : Json(nullptr);
}

Json histogramJson(const measure::Histogram& h) {
  return {{"mode", measure::nameOf(h.settings.mode)},
          {"normals", "smooth"},
          {"bins", h.settings.bins},
          {"first_bin", h.first_bin},
          {"shares", h.shares},
          {"edges", h.edges},
          {"left_out", h.left_out},
          {"entries_index_le_0", h.below_first},
          {"flat", h.flat},
          {"convex", h.convex},
          {"concave", h.concave}};
}

Json shellsJson(const std::vector<Shell>& shells) {
  Json list = Json::array();
  for (size_t i = 0; i < std::min(shells.size(), kMostShells); ++i) {
    const Shell& s = shells[i];
    list.push_back({{"triangles", s.triangles},
                    {"area", s.area},
                    {"volume", s.closed() ? Json(s.volume) : Json(nullptr)},
                    {"euler", s.euler()},
                    {"genus", orNull(s.genus())},
                    {"borders", s.borders},
                    {"closed", s.closed()}});
  }
  return list;
}

std::string many(uint64_t count, std::string_view one, std::string_view several) {
  return fmt::format("{} {}", count, count == 1 ? one : several);
}

}  // namespace

std::vector<std::string> problemsOf(const MeshMeasures& m) {
  std::vector<std::string> problems;
  const auto say = [&](uint64_t count, std::string_view one, std::string_view several) {
    if (count > 0) problems.push_back(many(count, one, several));
  };
  const MeshReport& i = m.identity;
  say(m.non_finite, "triangle has a corner that is no number, or beyond 1e37",
      "triangles have corners that are no numbers, or beyond 1e37");
  say(i.open_edges, "edge has one triangle alone: there is a hole", "edges have one triangle alone: there are holes");
  say(i.unmatched_edges - i.open_edges, "edge has triangles that face different ways",
      "edges have triangles that face different ways");
  say(i.non_manifold_edges, "edge has three triangles or more", "edges have three triangles or more");
  say(i.pinched_vertices, "point hangs several parts together", "points hang several parts together");
  say(i.duplicate_triangles, "triangle is there twice", "triangles are there twice");
  say(m.degenerate(), "triangle has no area", "triangles have no area");
  say(m.nesting.inside_out, "closed part is inside out", "closed parts are inside out");
  say(m.nesting.nested, "closed part stands in the solid of another", "closed parts stand in the solid of others");
  if (m.self_intersections) {
    say(m.self_intersections->pairs, "pair of triangles cuts or touches each other",
        "pairs of triangles cut or touch each other");
  }
  return problems;
}

std::vector<std::string> unknownsOf(const MeshMeasures& m) {
  std::vector<std::string> unknowns;
  if (m.self_intersections && !m.self_intersections->complete) {
    unknowns.push_back("too many triangles lie close to each other to look at all pairs: more of them may cut");
  }
  if (m.nesting.not_judged > 0) {
    unknowns.push_back(many(m.nesting.not_judged, "closed part has", "closed parts have") +
                       " too much above to say what they stand in");
  }
  return unknowns;
}

Json toJson(const MeshMeasures& m) {
  const MeshReport& i = m.identity;
  Json json = {{"valid", m.valid()},
               {"watertight", m.watertight()},
               {"complete", m.complete()},
               {"problems", problemsOf(m)},
               {"unknowns", unknownsOf(m)},
               {"triangles", m.triangles},
               {"points", m.points},
               {"welded_points", m.welded_points},
               {"unused_points", m.unused_points},
               {"non_finite", m.non_finite},
               {"first_non_finite", orNull(m.first_non_finite)},
               {"area", m.sums.area},
               {"volume", m.sums.volume},
               {"area_vector", pointJson(m.sums.area_vector)},
               {"bounds", {pointJson(m.sums.low), pointJson(m.sums.high)}},
               {"objects", m.parts.objects},
               {"shells", m.parts.shells.size()},
               {"euler", m.euler()},
               {"genus", orNull(m.genus())},
               {"edges", i.edges},
               {"vertices", i.vertices},
               {"open_edges", i.open_edges},
               {"turned_edges", i.unmatched_edges - i.open_edges},
               {"nonmanifold_edges", i.non_manifold_edges},
               {"nonmanifold_vertices", i.pinched_vertices},
               {"degenerate", m.degenerate()},
               {"duplicates", i.duplicate_triangles},
               {"slivers", m.slivers},
               {"inside_out", m.nesting.inside_out},
               {"cavities", m.nesting.cavities},
               {"nested", m.nesting.nested},
               {"not_judged", m.nesting.not_judged}};
  if (m.self_intersections) {
    json["self_intersections"] = m.self_intersections->pairs;
    json["self_intersections_complete"] = m.self_intersections->complete;
    Json examples = Json::array();
    for (const auto& [a, b] : m.self_intersections->examples) examples.push_back({a, b});
    json["self_intersection_examples"] = examples;
  } else {
    json["self_intersections"] = nullptr;
  }
  json["histogram"] = histogramJson(m.histogram);
  if (m.cubes) {
    const measure::CubeVolumes& c = *m.cubes;
    json["cubes"] = {{"edge", c.edge},
                     {"all_corners", c.volumeOf(c.all)},
                     {"any_corner", c.volumeOf(c.any)},
                     {"centre", c.volumeOf(c.centre)}};
  }
  json["parts"] = shellsJson(m.parts.shells);
  return json;
}

std::string textOf(const MeshMeasures& m) {
  std::string text;
  const auto line = [&](std::string_view name, const std::string& what) {
    text += fmt::format("  {:<11}{}\n", name, what);
  };
  const Point size = m.sums.high - m.sums.low;
  line("size", fmt::format("{:.6g} x {:.6g} x {:.6g}, from {:.6g},{:.6g},{:.6g}", size.x, size.y, size.z, m.sums.low.x,
                           m.sums.low.y, m.sums.low.z));
  line("area", fmt::format("{:.9g} (equation 7)", m.sums.area));
  const bool closed = m.identity.unmatched_edges == 0 && m.non_finite == 0;
  line("volume", closed ? fmt::format("{:.9g} (divergence theorem)", m.sums.volume)
                        : fmt::format("{:.9g}, which means little: the surface is not closed", m.sums.volume));
  if (m.cubes) {
    const measure::CubeVolumes& c = *m.cubes;
    line("cubes", fmt::format("{:.9g} by all corners, {:.9g} by any, {:.9g} by centres (equation 8, edge {:.6g})",
                              c.volumeOf(c.all), c.volumeOf(c.any), c.volumeOf(c.centre), c.edge));
  }
  line("parts", fmt::format("{} (section 7.3), {}, Euler characteristic {}, genus {}",
                            many(m.parts.objects, "object", "objects"), many(m.parts.shells.size(), "shell", "shells"),
                            m.euler(), m.genus() ? std::to_string(*m.genus()) : "not defined"));
  line("bends", fmt::format("{:.1f} % of the edges flat, {:.1f} % convex, {:.1f} % concave", 100 * m.histogram.flat,
                            100 * m.histogram.convex, 100 * m.histogram.concave));
  if (m.slivers > 0) line("slivers", fmt::format("{} (quality below {})", m.slivers, measure::kSliver));
  const std::vector<std::string> problems = problemsOf(m), unknowns = unknownsOf(m);
  line("verdict", !problems.empty()   ? "not the surface of a solid:"
                  : !unknowns.empty() ? "not known:"
                  : m.triangles == 0  ? "empty: there are no triangles"
                  : !m.self_intersections
                      ? "the closed surface of a solid, unless it cuts itself, which was not looked for"
                      : "valid: the closed surface of a solid");
  for (const auto& lines : {problems, unknowns})
    for (const std::string& what : lines) text += fmt::format("               {}\n", what);
  return text;
}

}  // namespace sgm::cli
