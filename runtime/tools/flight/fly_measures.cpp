#include "tools/flight/fly_measures.h"

#include <fmt/core.h>

#include <cmath>

#include "measure/chunk_measures.h"

namespace sgm::cli {
namespace {

std::string nameOf(size_t kind) { return measure::defectName(static_cast<measure::Defect>(kind)); }

/// The JSON key of a kind of defect: "non-manifold edges" becomes "nonmanifold_edges".
std::string keyOf(size_t kind) {
  std::string key;
  for (const char c : nameOf(kind)) {
    if (c != '-') key += c == ' ' ? '_' : c;
  }
  return key;
}

double shareOf(const sgm_world_measures& measures) {
  return measures.meshing_seconds > 0 ? measures.measuring_seconds / measures.meshing_seconds : 0;
}

Json toJson(const sgm_chunk_sums& sums) {
  Json defects;
  for (size_t kind = 0; kind < measure::kDefects; ++kind) defects[keyOf(kind)] = sums.defects[kind];
  return {{"bodies", sums.bodies},
          {"seams", sums.seams},
          {"triangles", sums.triangles},
          {"bytes", sums.bytes},
          {"sliver_triangles", sums.sliver_triangles},
          {"against_normals", sums.against_normals},
          {"border_edges", sums.border_edges},
          {"compared", sums.compared},
          {"defects", defects},
          {"area", sums.area},
          {"area_vector", Json{sums.area_vector[0], sums.area_vector[1], sums.area_vector[2]}},
          {"flux", sums.flux}};
}

}  // namespace

Json toJson(const sgm_world_measures& measures) {
  return {{"drawn", toJson(measures.drawn)},
          {"made", toJson(measures.made)},
          {"measuring_seconds", measures.measuring_seconds},
          {"meshing_seconds", measures.meshing_seconds},
          {"share_of_meshing", shareOf(measures)}};
}

void print(const sgm_world_measures& measures) {
  const sgm_chunk_sums &made = measures.made, &drawn = measures.drawn;
  fmt::print("  measures  {} bodies and {} seams, {} triangles: {}; {} slivers\n", made.bodies, made.seams,
             made.triangles, defectOf(measures).value_or("no defects"), made.sliver_triangles);
  fmt::print("            drawn at the end: {:.1f} m2 around {:.1f} m3 of {}\n", drawn.area, std::fabs(drawn.flux),
             drawn.flux < 0 ? "void" : "solid");
  fmt::print("            took {:.0f} ms, {:.1f} % of the {:.0f} ms of meshing\n", 1e3 * measures.measuring_seconds,
             100 * shareOf(measures), 1e3 * measures.meshing_seconds);
}

std::optional<std::string> defectOf(const sgm_world_measures& measures) {
  std::string found;
  for (size_t kind = 0; kind < measure::kDefects; ++kind) {
    const uint64_t count = measures.made.defects[kind];
    if (count > 0) found += fmt::format("{}{} {}", found.empty() ? "chunks with " : ", ", count, nameOf(kind));
  }
  if (found.empty()) return {};
  return found;
}

}  // namespace sgm::cli
