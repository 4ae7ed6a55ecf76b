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
  // A step is a 256th of a cell; all sums of steps are exact in a double, but those of chunks that are full to the
  // brim.
  const double step = static_cast<double>(grid.cell) / (kSubcell * kUnitsPerMetre), square = step * step;
  sums.area += areaOf(part, grid.cell);
  double about_origin = 0;
  for (size_t axis = 0; axis < 3; ++axis) {
    const double cross = static_cast<double>(part.cross[axis]) * square;
    sums.area_vector[axis] += cross / 2;
    about_origin += static_cast<double>(grid.origin[static_cast<int>(axis)]) / kUnitsPerMetre * cross;
  }
  sums.flux += (static_cast<double>(part.six_volumes) * square * step + about_origin) / 6;
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
      return "turned edges";
    case Defect::nonmanifold_edge:
      return "non-manifold edges";
    case Defect::pinched_vertex:
      return "pinched vertices";
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
