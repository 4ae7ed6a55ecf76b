#include "tools/cli/measure/measure_report.h"

#include <fmt/core.h>

#include <algorithm>
#include <string_view>

namespace sgm::cli {
namespace {

using measure::MeshMeasures;
using measure::Point;
using measure::Shell;

constexpr size_t kMaxShells = 16;

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
  for (size_t i = 0; i < std::min(shells.size(), kMaxShells); ++i) {
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

std::vector<std::string> problemsOf(const MeshMeasures& m, Point origin) {
  using measure::DefectKind;
  std::vector<std::string> problems;
  const auto say = [&](uint64_t count, std::string_view one, std::string_view several,
                       std::optional<DefectKind> kind = {}) {
    if (count == 0) return;
    problems.push_back(many(count, one, several));
    const auto first = std::ranges::find_if(m.places, [&](const auto& place) { return place.kind == kind; });
    if (first == m.places.end()) return;
    const Point at = first->at + origin;
    problems.back() += fmt::format("{}at {:.6g},{:.6g},{:.6g}", count == 1 ? ", " : ", the first ", at.x, at.y, at.z);
  };
  const MeshReport& i = m.identity;
  say(m.non_finite, "triangle has a corner that is not finite, or beyond 1e37",
      "triangles have corners that are not finite, or beyond 1e37");
  say(i.open_edges - m.cut_edges, "open edge (with one triangle): there is a hole",
      "open edges (with one triangle): there are holes", DefectKind::open_edge);
  say(i.unmatched_edges - i.open_edges, "misoriented edge: its triangles face different sides",
      "misoriented edges: their triangles face different sides", DefectKind::turned_edge);
  say(i.non_manifold_edges, "non-manifold edge: it has three triangles or more",
      "non-manifold edges: they have three triangles or more", DefectKind::nonmanifold_edge);
  say(i.pinched_vertices, "non-manifold vertex: it joins several parts",
      "non-manifold vertices: they join several parts", DefectKind::pinched_vertex);
  say(i.duplicate_triangles, "duplicate triangle", "duplicate triangles", DefectKind::duplicate);
  say(i.degenerate_triangles, "triangle has two corners in one place", "triangles have two corners in one place",
      DefectKind::degenerate);
  say(m.flat_triangles, "triangle has no area: its corners lie on a line",
      "triangles have no area: their corners lie on lines", DefectKind::flat);
  say(m.nesting.inside_out, "closed part is inside out", "closed parts are inside out", DefectKind::inside_out);
  say(m.nesting.nested, "closed part lies in the solid of another, or cuts it",
      "closed parts lie in the solid of others, or cut it", DefectKind::nested);
  if (m.self_intersections) {
    say(m.self_intersections->folded, "folded pair of triangles: they overlap at a common edge",
        "folded pairs of triangles: they overlap at a common edge", DefectKind::folded);
    say(m.self_intersections->cuts(), "pair of triangles intersects or touches",
        "pairs of triangles intersect or touch", DefectKind::self_intersection);
  }
  return problems;
}

std::vector<std::string> unknownsOf(const MeshMeasures& m) {
  std::vector<std::string> unknowns;
  if (m.self_intersections && !m.self_intersections->complete) {
    unknowns.push_back("too many triangles lie close together to test all pairs: more of them may intersect");
  }
  if (m.nesting.not_judged > 0) {
    unknowns.push_back(many(m.nesting.not_judged, "closed part has", "closed parts have") +
                       " too many triangles above to decide what they lie in");
  }
  return unknowns;
}

Json toJson(const MeshMeasures& m, Point origin) {
  const MeshReport& i = m.identity;
  Json places = Json::array();
  for (const measure::DefectPlace& place : m.places) {
    places.push_back(
        {{"kind", measure::nameOf(place.kind)}, {"triangle", place.triangle}, {"at", pointJson(place.at + origin)}});
  }
  Json json = {{"valid", m.valid()},
               {"valid_but_for_cut", m.validButForCut()},
               {"watertight", m.watertight()},
               {"complete", m.complete()},
               {"problems", problemsOf(m, origin)},
               {"places", places},
               {"unknowns", unknownsOf(m)},
               {"triangles", m.triangles},
               {"points", m.points},
               {"welded_points", m.welded_points},
               {"unused_points", m.unused_points},
               {"non_finite", m.non_finite},
               {"first_non_finite", orNull(m.first_non_finite)},
               {"area", m.sums.area},
               {"volume", m.sums.volume},
               {"volume_counts_once", !m.overlaps()},
               {"area_vector", pointJson(m.sums.area_vector)},
               {"bounds", {pointJson(m.sums.low + origin), pointJson(m.sums.high + origin)}},
               {"objects", m.parts.objects},
               {"shells", m.parts.shells.size()},
               {"euler", m.euler()},
               {"genus", orNull(m.genus())},
               {"edges", i.edges},
               {"vertices", i.vertices},
               {"open_edges", i.open_edges},
               {"cut_edges", m.cut_edges},
               {"turned_edges", i.unmatched_edges - i.open_edges},
               {"nonmanifold_edges", i.non_manifold_edges},
               {"nonmanifold_vertices", i.pinched_vertices},
               {"degenerate", i.degenerate_triangles},
               {"flat", m.flat_triangles},
               {"duplicates", i.duplicate_triangles},
               {"slivers", m.slivers},
               {"inside_out", m.nesting.inside_out},
               {"cavities", m.nesting.cavities},
               {"nested", m.nesting.nested},
               {"not_judged", m.nesting.not_judged}};
  if (m.self_intersections) {
    json["folded"] = m.self_intersections->folded;
    json["self_intersections"] = m.self_intersections->cuts();
    json["self_intersections_complete"] = m.self_intersections->complete;
    Json examples = Json::array();
    for (const auto& [a, b] : m.self_intersections->examples) examples.push_back({a, b});
    json["self_intersection_examples"] = examples;
  } else {
    json["folded"] = nullptr;
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

Json reportJson(Json known, const std::string& file, const MeshMeasures& measures, Point origin) {
  known["file"] = file;
  known["origin"] = pointJson(origin);
  known.update(toJson(measures, origin));
  return known;
}

namespace {

std::string volumeText(const MeshMeasures& m, std::string_view unit) {
  const std::string volume = fmt::format("{:.9g}{}", m.sums.volume, unit.empty() ? "" : fmt::format("{}3", unit));
  if (m.identity.unmatched_edges > 0 || m.non_finite > 0) {
    const bool cut_alone = m.cut_edges > 0 && m.cut_edges == m.identity.unmatched_edges && m.non_finite == 0;
    return volume + fmt::format(", which means little: the surface is {}", cut_alone ? "cut" : "not closed");
  }
  return volume + (m.overlaps() ? " (divergence theorem), which counts overlaps of parts several times"
                                : " (divergence theorem)");
}

std::string verdictText(const MeshMeasures& m) {
  if (!problemsOf(m).empty()) return "not the surface of a solid:";
  if (!unknownsOf(m).empty()) return "unknown:";
  if (m.triangles == 0) return "empty: there are no triangles";
  const std::string_view unless = m.self_intersections ? "" : ", unless it intersects itself, which was not tested";
  if (m.cut_edges > 0) {
    return fmt::format("closed except at the region's border, which cuts it along {}{}",
                       many(m.cut_edges, "edge", "edges"), unless);
  }
  return fmt::format("{}the closed surface of a solid{}", m.self_intersections ? "valid: " : "", unless);
}

}  // namespace

std::string textOf(const MeshMeasures& m, Point origin, std::string_view unit) {
  std::string text;
  const auto line = [&](std::string_view name, const std::string& what) {
    text += fmt::format("  {:<11}{}\n", name, what);
  };
  const Point size = m.sums.high - m.sums.low;
  const Point low = m.sums.low + origin;
  line("size", fmt::format("{:.6g} x {:.6g} x {:.6g}{}, from {:.8g},{:.8g},{:.8g}", size.x, size.y, size.z, unit, low.x,
                           low.y, low.z));
  line("area",
       fmt::format("{:.9g}{} (the paper's equation 7)", m.sums.area, unit.empty() ? "" : fmt::format("{}2", unit)));
  line("volume", volumeText(m, unit));
  if (m.cubes) {
    const measure::CubeVolumes& c = *m.cubes;
    line("cubes", fmt::format("{:.9g} by all corners, {:.9g} by any, {:.9g} by centres (equation 8, edge {:.6g})",
                              c.volumeOf(c.all), c.volumeOf(c.any), c.volumeOf(c.centre), c.edge));
  }
  line("parts", fmt::format("{} (the paper's section 7.3), {}, Euler characteristic {}, genus {}",
                            many(m.parts.objects, "object", "objects"), many(m.parts.shells.size(), "shell", "shells"),
                            m.euler(), m.genus() ? std::to_string(*m.genus()) : "not defined"));
  line("dihedral",
       fmt::format("{:.1f} % of the edges flat, {:.1f} % convex, {:.1f} % concave, by normals averaged at points",
                   100 * m.histogram.flat, 100 * m.histogram.convex, 100 * m.histogram.concave));
  if (m.slivers > 0) line("slivers", fmt::format("{} (quality below {})", m.slivers, measure::kSliver));
  line("verdict", verdictText(m));
  for (const auto& lines : {problemsOf(m, origin), unknownsOf(m)})
    for (const std::string& what : lines) text += fmt::format("               {}\n", what);
  return text;
}

}  // namespace sgm::cli
