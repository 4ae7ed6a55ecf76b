#include <algorithm>

#include "api/barrier.h"
#include "api/mesh.h"
#include "api/world.h"

using namespace sgm::api;

namespace {

using sgm::measure::Defect;
using sgm::measure::SurfaceSums;

constexpr bool isDefect(sgm_defect ours, Defect theirs) { return static_cast<int>(ours) == static_cast<int>(theirs); }
static_assert(isDefect(SGM_DEFECT_INDEX, Defect::index) && isDefect(SGM_DEFECT_OUTSIDE, Defect::outside) &&
              isDefect(SGM_DEFECT_MISPLACED, Defect::misplaced) &&
              isDefect(SGM_DEFECT_SAMPLES, Defect::unlike_samples) &&
              isDefect(SGM_DEFECT_DEGENERATE, Defect::degenerate) && isDefect(SGM_DEFECT_FLAT, Defect::flat) &&
              isDefect(SGM_DEFECT_DUPLICATE, Defect::duplicate) && isDefect(SGM_DEFECT_OPEN_EDGE, Defect::open_edge) &&
              isDefect(SGM_DEFECT_TURNED_EDGE, Defect::turned_edge) &&
              isDefect(SGM_DEFECT_NONMANIFOLD_EDGE, Defect::nonmanifold_edge) &&
              isDefect(SGM_DEFECT_PINCHED_VERTEX, Defect::pinched_vertex) &&
              isDefect(SGM_DEFECT_FOLDED, Defect::folded) &&
              isDefect(SGM_DEFECT_SELF_INTERSECTION, Defect::self_intersection));

sgm_chunk_sums sumsOf(const SurfaceSums& sums) {
  sgm_chunk_sums out = SGM_CHUNK_SUMS_INIT;
  static_assert(sgm::measure::kDefects <= std::size(decltype(out.defects){}));
  out.bodies = sums.bodies;
  out.seams = sums.seams;
  out.triangles = sums.triangles;
  out.bytes = sums.bytes;
  out.sliver_triangles = sums.slivers;
  out.against_normals = sums.against_gradient;
  out.border_edges = sums.border_edges;
  out.compared = sums.compared;
  std::copy(sums.defects.begin(), sums.defects.end(), out.defects);
  out.area = sums.area;
  std::copy(sums.area_vector.begin(), sums.area_vector.end(), out.area_vector);
  out.flux = sums.flux;
  return out;
}

}  // namespace

sgm_result sgm_world_get_measures(const sgm_world* world, sgm_world_measures* measures, sgm_error* error) {
  return guarded(error, [&]() -> sgm_result {
    if (world == nullptr) return nullArgument(error, "world");
    if (sgm_result r = checkDesc(error, measures, "measures"); r != SGM_OK) return r;
    const std::optional<sgm::WorldMeasures> now = world->world->measures();
    if (!now) return fail(error, SGM_ERR_UNSUPPORTED, "the world was created without SGM_WORLD_MEASURE");
    measures->drawn = sumsOf(now->drawn);
    measures->made = sumsOf(now->made.sums);
    measures->measuring_seconds = now->made.measuring;
    measures->meshing_seconds = now->made.meshing;
    return SGM_OK;
  });
}

sgm_result sgm_mesh_get_measures(const sgm_mesh* mesh, uint32_t seams, sgm_mesh_measures* measures, sgm_error* error) {
  return guarded(error, [&]() -> sgm_result {
    if (mesh == nullptr) return nullArgument(error, "mesh");
    if (sgm_result r = checkDesc(error, measures, "measures"); r != SGM_OK) return r;
    if (seams >= 1u << 6)
      return fail(error, SGM_ERR_INVALID_ARGUMENT, "seams has unknown bits: pass 0 or bits (1 << sgm_face)");
    const sgm::ChunkSurface& surface = *mesh->surface;
    if (!surface.measures)
      return fail(error, SGM_ERR_UNSUPPORTED,
                  "the mesh does not belong to a world that was created with SGM_WORLD_MEASURE");
    SurfaceSums sums;
    sums.add(*surface.measures, surface.grid, true, static_cast<uint8_t>(seams));
    const sgm::measure::BodyTopology& topology = surface.measures->topology;
    measures->sums = sumsOf(sums);
    measures->vertices = topology.vertices;
    measures->edges = topology.edges;
    measures->euler = topology.euler();
    std::copy(topology.border_edges.begin(), topology.border_edges.end(), measures->border_edges);
    return SGM_OK;
  });
}
