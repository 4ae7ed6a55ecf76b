#pragma once
// The surface of a region as `sgm measure --strict` judges it, and the numbers of its defects.

#include <algorithm>
#include <fstream>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

#include "api/import.h"
#include "backend/open/open_backend.h"
#include "catch.h"
#include "chunk/mesh_chunks.h"
#include "measure/exact_sign.h"
#include "measure/mesh_measures.h"
#include "measure/triangle_pair.h"
#include "measure/weld_points.h"
#include "measure/world_triangles.h"
#include "region/region_mesh.h"

namespace sgm::test {

inline std::shared_ptr<const Program> compiled(const std::string& text, const std::filesystem::path& folder = ".") {
  api::FolderImports imports(folder);
  CompileOptions options;
  options.resolver = &imports;
  const CompileResult result = compileGrammar(text, "test.sgm", options);
  INFO(renderDiagnostics(result) << text);
  REQUIRE(result.program);
  return result.program;
}

inline WorldFieldSettings worldOf(std::shared_ptr<const Program> program, double cell, uint64_t seed) {
  WorldFieldSettings settings;
  settings.parameters = ParameterValues::defaults(*program);
  settings.program = std::move(program);
  settings.seed = seed;
  settings.finest_cell = static_cast<int32_t>(cell * kUnitsPerMetre);
  return settings;
}

/// A thread pool of two workers, and a backend.
struct ReportContext {
  std::unique_ptr<JobSystem> jobs = *makeThreadPool(2);
  std::unique_ptr<Backend> backend = *makeBackend({}, *jobs, std::pmr::get_default_resource());
};

/// Numbers of defects of a surface. Vertices are compared by position as well as by index.
struct Faults {
  size_t triangles = 0;
  size_t degenerate = 0;    ///< triangles with two corners at the same position
  size_t without_area = 0;  ///< triangles with three corners on a line
  size_t folded = 0;        ///< pairs of triangles that share an edge and lie on each other
  size_t cuts = 0;          ///< pairs of triangles that intersect, except those counted in `folded`
  size_t nonmanifold = 0;   ///< edges of three or more triangles
  /// Number of all other defects: non-manifold vertices, duplicates, holes, misoriented edges, shells with the wrong
  /// orientation.
  size_t others = 0;
  bool valid = false;  ///< the verdict of `sgm measure --strict`

  friend std::ostream& operator<<(std::ostream& out, const Faults& f) {
    return out << f.triangles << " triangles, " << f.degenerate << " degenerate, " << f.without_area
               << " without area, " << f.folded << " folded, " << f.cuts << " cuts, " << f.nonmanifold
               << " non-manifold edges, " << f.others << " others";
  }
};

/// Calls visit(a, b) for each pair of triangles whose boxes overlap.
template <class Visit>
void forPairs(const measure::Triangles& mesh, JobSystem& jobs, const Visit& visit) {
  const measure::Bvh tree(mesh, jobs);
  for (const measure::Bvh::Pair& pair : tree.parts(1)) {
    measure::Bvh::Walk walk(pair);
    tree.visitPairs(walk, uint64_t{1} << 40, visit);
  }
}

inline size_t commonCorners(const measure::Triangle& a, const measure::Triangle& b) {
  return static_cast<size_t>(
      std::count_if(a.begin(), a.end(), [&](uint32_t v) { return std::find(b.begin(), b.end(), v) != b.end(); }));
}

/// Counts defects. cut: the box from which the mesh was cut, or null. Vertices at the same position count as one.
inline Faults faultsOf(const asset::TriangleMesh& mesh, const measure::Cut* cut, JobSystem& jobs) {
  measure::MeshSettings settings;
  if (cut != nullptr) settings.cut = *cut;
  const Result<measure::MeshMeasures> measures = measure::measureMesh({mesh.points, mesh.triangles}, settings, jobs);
  REQUIRE(measures);
  const MeshReport& identity = measures->identity;
  Faults faults;
  faults.triangles = measures->triangles;
  faults.degenerate = identity.degenerate_triangles;
  faults.without_area = measures->flat_triangles;
  faults.nonmanifold = identity.non_manifold_edges;
  faults.others = identity.pinched_vertices + identity.duplicate_triangles +
                  (identity.open_edges - measures->cut_edges) + (identity.unmatched_edges - identity.open_edges) +
                  measures->nesting.inside_out + measures->nesting.nested + measures->non_finite;
  faults.valid = measures->validButForCut() && measures->triangles > 0;
  if (measures->self_intersections->pairs == 0) return faults;
  const measure::WeldedPoints welded = measure::weldPoints({mesh.points, mesh.triangles});
  forPairs({welded.points, welded.triangles}, jobs, [&](uint32_t a, uint32_t b) {
    const measure::Triangle &first = welded.triangles[a], &second = welded.triangles[b];
    if (measure::meetWrongly(welded.points, first, second)) {
      ++(commonCorners(first, second) == 2 ? faults.folded : faults.cuts);
    }
  });
  CHECK(faults.folded + faults.cuts == measures->self_intersections->pairs);
  return faults;
}

struct MeshedRegion {
  asset::TriangleMesh mesh;
  measure::Cut cut;
  uint64_t chunks = 0;
};

/// Meshes those chunks of one level that meet lo <= p < hi.
inline MeshedRegion meshedRegion(const WorldField& world, const ReportContext& shop, const IntBox& box, bool sharp) {
  const Result<RegionMesh> region = meshRegion(world, *shop.backend, *shop.jobs, box, 0, 4096, sharp);
  INFO((region ? "" : region.error().message));
  REQUIRE(region);
  MeshedRegion result{measure::trianglesOf(region->mesh), {}, region->chunks};
  for (int axis = 0; axis < 3; ++axis) {
    const int64_t origin = region->mesh.origin[axis];
    result.cut.low[axis] = static_cast<double>(region->extent.lo[axis] - origin) / kUnitsPerMetre;
    result.cut.high[axis] = static_cast<double>(region->extent.hi[axis] - origin) / kUnitsPerMetre;
  }
  return result;
}

}  // namespace sgm::test
