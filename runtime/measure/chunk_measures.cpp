#include "measure/chunk_measures.h"

#include <algorithm>

namespace sgm::measure {
namespace {

void addPart(const PartMeasures& part, const ChunkGrid& grid, SurfaceSums& sums) {
  sums.triangles += part.triangles;
  sums.bytes += part.vertices * sizeof(Vertex) + part.triangles * 3 * sizeof(uint32_t);
  sums.slivers += part.slivers;
  sums.against_gradient += part.against_gradient;
  for (size_t kind = 0; kind < kDefects; ++kind) sums.defects[kind] += part.defects[kind];
  const double step = static_cast<double>(grid.cell) / (kSubcell * kUnitsPerMetre);
  sums.area += areaOf(part, grid.cell);
  std::array<double, 3> origin{};
  for (size_t axis = 0; axis < 3; ++axis) {
    sums.area_vector[axis] += static_cast<double>(part.cross[axis]) * (step * step) / 2;
    origin[axis] = metres(grid.origin[static_cast<int>(axis)]);
  }
  sums.flux += fluxOf(part, grid.cell, origin);
}

}  // namespace

const char* defectName(Defect defect) {
  switch (defect) {
    case Defect::index:
      return "indices out of range";
    case Defect::outside:
      return "vertices outside";
    case Defect::misplaced:
      return "misplaced vertices";
    case Defect::unlike_samples:
      return "edges unlike the samples";
    case Defect::degenerate:
      return "degenerate triangles";
    case Defect::flat:
      return "flat triangles";
    case Defect::duplicate:
      return "duplicate triangles";
    case Defect::open_edge:
      return "open edges";
    case Defect::turned_edge:
      return "misoriented edges";
    case Defect::nonmanifold_edge:
      return "non-manifold edges";
    case Defect::pinched_vertex:
      return "non-manifold vertices";
    case Defect::folded:
      return "folded triangles";
    case Defect::self_intersection:
      return "self intersections";
  }
  return "";
}

void SurfaceSums::add(const ChunkMeasures& chunk, const ChunkGrid& grid, bool body, uint8_t seam_faces) {
  if (body) {
    bodies += chunk.parts[0].triangles != 0;
    for (const uint32_t edges : chunk.topology.border_edges) border_edges += edges;
    compared += chunk.topology.compared;
    addPart(chunk.parts[0], grid, *this);
  }
  for (size_t face = 0; face < 6; ++face) {
    if (!(seam_faces >> face & 1)) continue;
    seams += chunk.parts[1 + face].triangles != 0;
    addPart(chunk.parts[1 + face], grid, *this);
  }
}

void SurfaceSums::add(const SurfaceSums& other) {
  bodies += other.bodies;
  seams += other.seams;
  triangles += other.triangles;
  bytes += other.bytes;
  slivers += other.slivers;
  against_gradient += other.against_gradient;
  border_edges += other.border_edges;
  compared += other.compared;
  for (size_t kind = 0; kind < kDefects; ++kind) defects[kind] += other.defects[kind];
  area += other.area;
  for (size_t axis = 0; axis < 3; ++axis) area_vector[axis] += other.area_vector[axis];
  flux += other.flux;
}

bool SurfaceSums::sound() const {
  return std::all_of(defects.begin(), defects.end(), [](uint64_t count) { return count == 0; });
}

}  // namespace sgm::measure
