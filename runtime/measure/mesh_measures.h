#pragma once
// All measures of one triangle mesh.

#include <optional>
#include <string>

#include "measure/area_volume.h"
#include "measure/cube_volume.h"
#include "measure/defect_places.h"
#include "measure/histogram.h"
#include "measure/nesting.h"
#include "measure/self_intersection.h"
#include "measure/shells.h"
#include "mesh/check.h"

namespace sgm::measure {

struct MeshSettings {
  double weld = 0;  ///< tolerance of weldPoints(), in the mesh's unit
  HistogramSettings histogram;
  bool self_intersections = true;
  /// The maximum number of search steps per triangle. If a mesh needs more, because many triangles lie close together
  /// or stacked, MeshMeasures::complete() is false.
  uint64_t steps_a_triangle = 5000;
  std::optional<double> cubes;  ///< edge of the cubes for cubeVolumes(); nullopt: cubes are not counted
  std::optional<Cut> cut;       ///< the cutting box, if the mesh was cut from a larger one
  MeasureProgress progress;     ///< receives the progress of the search for self-intersections, the longest step
};

struct MeshMeasures {
  size_t points = 0, triangles = 0;  ///< numbers in the given mesh, before welding
  size_t unused_points = 0;          ///< points that no triangle uses
  size_t welded_points = 0;          ///< points merged into others
  /// triangles with a corner that is NaN or beyond kFarthest; excluded from everything below
  size_t non_finite = 0;
  std::optional<uint32_t> first_non_finite;

  /// Topology of the welded mesh, by vertex indices. mesh/triangle_faults.h defines degenerate, flat, folded and cut.
  MeshReport identity;
  size_t flat_triangles = 0;
  size_t slivers = 0;  ///< triangles of quality below kSliver, including those without area
  AreaVolume sums;
  Shells parts;
  Nesting nesting;
  std::optional<SelfIntersections> self_intersections;
  Histogram histogram;
  std::optional<CubeVolumes> cubes;
  uint64_t cut_edges = 0;           ///< number of open edges in a face of the cutting box (MeshSettings::cut)
  std::vector<DefectPlace> places;  ///< examples of defects, by kind

  size_t withoutArea() const { return identity.degenerate_triangles + flat_triangles; }
  int64_t euler() const;                  ///< Euler characteristic, summed over shells
  std::optional<uint64_t> genus() const;  ///< genus, summed over shells; nullopt if the genus of a shell is undefined
  /// True if every edge has two triangles that use it in opposite directions, every vertex has one fan, and no triangle
  /// occurs twice or has a repeated corner. Also true for a mesh without triangles.
  bool watertight() const { return identity.closed() && non_finite == 0; }
  /// True if the mesh is the surface of a solid. Then it is watertight and faces outward; no shell lies in the solid of
  /// another shell, except cavities; no triangle is without area; no two triangles intersect (if this test was
  /// requested); and everything was completely examined. Also true for a mesh without triangles.
  bool valid() const;
  /// True if the mesh is valid, or if its only defects are open edges in the faces of the cutting box.
  bool validButForCut() const;
  /// True if the volume counts some parts several times or with the wrong sign, because shells are nested, face inward
  /// or intersect.
  bool overlaps() const {
    return nesting.nested > 0 || nesting.inside_out > 0 || (self_intersections && self_intersections->pairs > 0);
  }
  /// True if everything that was requested was examined. If false, valid() may be false only for that reason.
  bool complete() const;
};

/// The quality of a triangle, 4 sqrt(3) area / (sum of the squared edges), below which it is a sliver. Equilateral
/// triangles have 1.
inline constexpr double kSliver = 0.05;

/// Measures a mesh. Its normals are not used: the histogram uses smoothNormals() of the welded mesh, which exist for
/// any file. Precondition: that of Triangles. Pure; the same for any number of threads. Reported numbers of triangles
/// are those of `mesh`, even if some triangles are excluded. Memory: about 200 bytes per triangle of a closed mesh, 500
/// if each triangle is isolated. Errors: limit for more than 2^32 / 3 triangles or 2^32 points; those of histogramOf
/// and cubeVolumes.
Result<MeshMeasures> measureMesh(const Triangles& mesh, const MeshSettings& settings, JobSystem& jobs);

}  // namespace sgm::measure
