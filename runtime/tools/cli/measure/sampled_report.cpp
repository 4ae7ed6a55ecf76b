#include "tools/cli/measure/sampled_report.h"

#include <fmt/core.h>

#include <algorithm>
#include <string_view>
#include <vector>

#include "chunk/surface_shapes.h"
#include "measure/area_volume.h"
#include "measure/world_triangles.h"

namespace sgm::cli {
namespace {

std::string lineOf(std::string_view name, const std::string& what) { return fmt::format("  {:<11}{}\n", name, what); }

Json anglesJson(const NormalAngles& a) {
  return {{"count", a.count},   {"inward", a.inward}, {"outward", a.outward()},
          {"median", a.median}, {"p99", a.p99},       {"max", a.greatest}};
}

std::string anglesText(const NormalAngles& a, std::string_view of_what) {
  return fmt::format(
      "{} of {} {} inward; {:.3g} degrees from the gradient at the median, {:.3g} at the 99th percentile, {:.3g} at "
      "most",
      a.inward, a.count, of_what, a.median, a.p99, a.greatest);
}

Json oneSidedJson(const measure::OneSided& d, measure::Point origin) {
  const measure::Point at = d.farthest + origin;
  return {{"at_least", d.at_least}, {"at_most", d.at_most}, {"mean", d.mean},
          {"rms", d.rms},           {"samples", d.samples}, {"farthest", {at.x, at.y, at.z}}};
}

/// Lower and upper bounds of the Hausdorff distance, and the one-sided distances in both directions.
Json distanceJson(const measure::Hausdorff& d, measure::Point origin) {
  return {{"at_least", d.atLeast()},
          {"at_most", d.atMost()},
          {"there", oneSidedJson(d.there, origin)},
          {"back", oneSidedJson(d.back, origin)}};
}

std::string oneSidedText(const measure::OneSided& d, measure::Point origin) {
  const measure::Point at = d.farthest + origin;
  return fmt::format("{:.4g} to {:.4g}, mean {:.4g}, farthest at {:.8g},{:.8g},{:.8g}", d.at_least, d.at_most, d.mean,
                     at.x, at.y, at.z);
}

Json texelJson(const measure::TexelDensities& d, double resolution) {
  return {{"resolution", resolution},
          {"triangles", d.triangles},
          {"without_area", d.without_area},
          {"unmapped", d.unmapped},
          {"min", d.least},
          {"p5", d.p5},
          {"median", d.median},
          {"p95", d.p95},
          {"max", d.most},
          {"ratio", d.ratio()}};
}

std::string texelText(const measure::TexelDensities& d, double resolution) {
  if (d.triangles == 0) return "none: no triangle has an area both in space and in the texture";
  std::string text = fmt::format(
      "{:.4g} per unit of length at the median, {:.4g} to {:.4g} on nine tenths of the area, {:.4g} to {:.4g} in all, "
      "a ratio of {:.3g}, for a texture of {:.6g}",
      d.median, d.p5, d.p95, d.least, d.most, d.ratio(), resolution);
  if (d.unmapped > 0) text += fmt::format("; {} triangles have no area in the texture", d.unmapped);
  return text;
}

}  // namespace

Section fieldSection(const FieldAgreement& found, int32_t cell, Int3 origin) {
  const double in_metres = metres(1), in_cells = 1.0 / cell;
  std::array<double, 3> at = found.farthest;
  for (int axis = 0; axis < 3; ++axis) at[static_cast<size_t>(axis)] += metres(origin[axis]);
  Section section;
  section.json = {{"step", metres(found.step)},
                  {"vertices", found.vertices},
                  {"in_creases", found.bent},
                  {"in_creases_inward", found.bent_inward},
                  {"in_plateaus", found.flat},
                  {"normals", anglesJson(found.normals)},
                  {"faces", anglesJson(found.faces)},
                  {"residual",
                   {{"max", found.residual_max * in_metres},
                    {"p99", found.residual_p99 * in_metres},
                    {"mean", found.residual_mean * in_metres},
                    {"max_cells", found.residual_max * in_cells},
                    {"p99_cells", found.residual_p99 * in_cells},
                    {"mean_cells", found.residual_mean * in_cells},
                    {"farthest", {at[0], at[1], at[2]}}}},
                  {"offset",
                   {{"max", found.offset_max * in_metres},
                    {"p99", found.offset_p99 * in_metres},
                    {"mean", found.offset_mean * in_metres},
                    {"max_cells", found.offset_max * in_cells},
                    {"p99_cells", found.offset_p99 * in_cells},
                    {"mean_cells", found.offset_mean * in_cells}}}};
  section.text = lineOf("normals", anglesText(found.normals, "vertices")) +
                 lineOf("faces", anglesText(found.faces, "triangles' corners"));
  if (found.bent + found.flat > 0) {
    section.text += lineOf(
        "creases", fmt::format("hold {} of {} vertices ({} with an inward normal), plateaus {}: left out of the angles",
                               found.bent, found.vertices, found.bent_inward, found.flat));
  }
  section.text += lineOf(
      "residual", fmt::format("|f| {:.4g} m at most ({:.3g} cells, at {:.6g},{:.6g},{:.6g}), {:.4g} m at the 99th "
                              "percentile, {:.4g} m on average",
                              found.residual_max * in_metres, found.residual_max * in_cells, at[0], at[1], at[2],
                              found.residual_p99 * in_metres, found.residual_mean * in_metres));
  section.text +=
      lineOf("", fmt::format("over the gradient's length {:.4g} m at most ({:.3g} cells), {:.4g} m, {:.4g} m",
                             found.offset_max * in_metres, found.offset_max * in_cells, found.offset_p99 * in_metres,
                             found.offset_mean * in_metres));
  return section;
}

Section levelSection(const LevelDistance& found, int fine, int32_t coarse_cell, Int3 origin) {
  const double cell = metres(coarse_cell), bound = kLevelBound * cell;
  Section section;
  section.json = {{"level", fine},
                  {"coarse_level", fine + 1},
                  {"coarse_cell", cell},
                  {"bound", bound},
                  {"vanished", !found.distance.has_value()},
                  {"triangles", {found.fine_triangles, found.coarse_triangles}},
                  {"left_out", {found.fine_left_out, found.coarse_left_out}}};
  const std::string pair = fmt::format("{} and {}: ", fine, fine + 1);
  if (!found.distance) {
    section.text = lineOf("levels", pair + fmt::format("one has a surface here and the other has none: detail is "
                                                       "declared for one level only, or is thinner than a cell of {} m",
                                                       cell));
    return section;
  }
  const measure::Hausdorff& d = *found.distance;
  const measure::Point from{metres(origin.x), metres(origin.y), metres(origin.z)};
  section.json.update(distanceJson(d, from));
  section.json.update({{"at_least_cells", d.atLeast() / cell},
                       {"at_most_cells", d.atMost() / cell},
                       {"beyond_bound", d.atLeast() > bound}});
  if (found.fine_triangles + found.coarse_triangles == 0) {
    const bool empty = found.fine_left_out + found.coarse_left_out == 0;
    section.text = lineOf("levels", pair + (empty ? "neither has a surface here"
                                                  : "all triangles are at the region's cut: choose a larger region"));
    return section;
  }
  section.text = lineOf(
      "levels",
      pair + fmt::format(
                 "{:.4g} to {:.4g} m apart, {:.3g} to {:.3g} cells of {} m{}", d.atLeast(), d.atMost(),
                 d.atLeast() / cell, d.atMost() / cell, cell,
                 d.atLeast() > bound
                     ? fmt::format(": more than {:.3g}, the bound for a field without detail by level", kLevelBound)
                     : ""));
  section.text += lineOf("", "to the coarse one " + oneSidedText(d.there, from));
  section.text += lineOf("", "to the fine one " + oneSidedText(d.back, from));
  if (found.fine_left_out + found.coarse_left_out > 0) {
    section.text += lineOf("", fmt::format("{} of {} and {} of {} triangles left out, at the region's cut or beyond",
                                           found.fine_left_out, found.fine_triangles + found.fine_left_out,
                                           found.coarse_left_out, found.coarse_triangles + found.coarse_left_out));
  }
  return section;
}

Section distanceSection(const measure::Hausdorff& found, const std::string& with, size_t triangles,
                        measure::Point origin) {
  Section section;
  section.json = distanceJson(found, origin);
  section.json.update({{"file", with}, {"triangles", triangles}});
  section.text =
      lineOf("distance", fmt::format("{:.6g} to {:.6g} between this and {}", found.atLeast(), found.atMost(), with)) +
      lineOf("", "from this " + oneSidedText(found.there, origin)) +
      lineOf("", "from the other " + oneSidedText(found.back, origin));
  return section;
}

Section drawingSection(const DrawingCost& found) {
  Section section;
  section.json = {{"triangles", found.triangles},
                  {"vertex_cache", kVertexCache},
                  {"acmr", found.acmr},
                  {"atvr", found.atvr},
                  {"overdraw", found.overdraw}};
  section.text =
      lineOf("drawing", found.triangles == 0
                            ? "no triangle that could be drawn"
                            : fmt::format("{:.3f} vertices per triangle (ACMR), each {:.3f} times (ATVR), with "
                                          "a cache of {}; each pixel {:.3f} times (overdraw)",
                                          found.acmr, found.atvr, kVertexCache, found.overdraw));
  return section;
}

Section texelSection(const asset::TriangleMesh& mesh, double resolution) {
  if (mesh.coordinates.empty()) return {nullptr, lineOf("texels", "none: the file has no texture coordinates")};
  const auto& corners = mesh.coordinates.corners.empty() ? mesh.triangles : mesh.coordinates.corners;
  const measure::TexelDensities found =
      measure::texelDensities({mesh.points, mesh.triangles}, mesh.coordinates.values, corners, resolution);
  return {texelJson(found, resolution), lineOf("texels", texelText(found, resolution))};
}

Section texelSection(const Region& region, double resolution) {
  const Unwrapped& unwrapped = region.texture->unwrapped;
  const asset::TriangleMesh mesh = measure::trianglesOf(region.meshed.mesh);
  std::vector<std::array<float, 2>> coordinates;
  coordinates.reserve(unwrapped.wedges.size());
  for (const Wedge& wedge : unwrapped.wedges) coordinates.push_back({wedge.u, wedge.v});
  // Exclude triangles without a UV chart: they have triplanar coordinates, whose texel density is constant.
  std::vector<measure::Triangle> charted, corners;
  double area = 0, by_planes = 0;
  for (size_t i = 0; i < mesh.triangles.size(); ++i) {
    const measure::Triangle& t = mesh.triangles[i];
    const measure::Triangle wedges{unwrapped.corners[3 * i], unwrapped.corners[3 * i + 1],
                                   unwrapped.corners[3 * i + 2]};
    const double its = length(measure::crossOf(mesh.points[t[0]], mesh.points[t[1]], mesh.points[t[2]]));
    area += its;
    if (unwrapped.wedges[wedges[0]].plane_shares != std::array<uint8_t, 3>{}) {
      by_planes += its;
    } else {
      charted.push_back(t);
      corners.push_back(wedges);
    }
  }
  const measure::TexelDensities found =
      measure::texelDensities({mesh.points, charted}, coordinates, corners, resolution);
  const double share = area > 0 ? by_planes / area : 0;
  Section section;
  section.json = texelJson(found, resolution);
  section.json["triplanar_share"] = share;
  section.json["triplanar_density"] = resolution / metres(kTile);
  if (found.triangles > 0 || share == 0) section.text = lineOf("texels", texelText(found, resolution));
  if (share > 0) {
    section.text += lineOf(section.text.empty() ? "texels" : "",
                           fmt::format("{:.4g} everywhere on the {:.1f} % of the area with triplanar texturing",
                                       resolution / metres(kTile), 100 * share));
  }
  return section;
}

}  // namespace sgm::cli
