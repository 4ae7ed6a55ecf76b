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
  /// Steps per triangle for geometry that lies close together or stacked: if a mesh needs more,
  /// MeshMeasures::complete() is false.
  uint64_t steps_a_triangle = 5000;
  std::optional<double> cubes;  ///< the edge of the cubes to count; nullopt: none are counted
  std::optional<Cut> cut;       ///< set if the mesh was cut from a larger one
  MeasureProgress progress;     ///< of the search for self-intersections, the longest step
};

struct MeshMeasures {
  size_t points = 0, triangles = 0;  ///< as given
  size_t unused_points = 0;          ///< that no triangle uses
  size_t welded_points = 0;          ///< merged into others
  size_t non_finite = 0;             ///< triangles with a corner beyond kFarthest or NaN: excluded from all below
  std::optional<uint32_t> first_non_finite;

  /// Of the welded mesh, by vertices. mesh/triangle_faults.h defines degenerate, flat, folded and cut.
  MeshReport identity;
  size_t flat_triangles = 0;
  size_t slivers = 0;  ///< of quality below kSliver, including those without area
  AreaVolume sums;
  Shells parts;
  Nesting nesting;
  std::optional<SelfIntersections> self_intersections;
  Histogram histogram;
  std::optional<CubeVolumes> cubes;
  uint64_t cut_edges = 0;           ///< of identity.open_edges: those in MeshSettings::cut
  std::vector<DefectPlace> places;  ///< defects, by kind

  size_t withoutArea() const { return identity.degenerate_triangles + flat_triangles; }
  int64_t euler() const;                  ///< summed over shells
  std::optional<uint64_t> genus() const;  ///< also summed; nullopt if a shell has none
  /// Every edge has two triangles that use it in opposite directions, every vertex has one fan, and no triangle occurs
  /// twice or has a repeated corner. True for a mesh without triangles.
  bool watertight() const { return identity.closed() && non_finite == 0; }
  /// A solid's surface: watertight, facing outward, covered once, without triangles that have no area or intersect (if
  /// that was requested), and completely examined. True for a mesh without triangles.
  bool valid() const;
  /// The same for a cut mesh: every open edge lies in the cut, and there is no other defect. True if valid().
  bool validButForCut() const;
  /// True if the volume counts some parts several times, or with the wrong sign.
  bool overlaps() const {
    return nesting.nested > 0 || nesting.inside_out > 0 || (self_intersections && self_intersections->pairs > 0);
  }
  /// True if everything requested was examined: otherwise valid() may be false only for that reason.
  bool complete() const;
};

/// 4 sqrt(3) area / (sum of the squared edges): 1 for equal edges.
inline constexpr double kSliver = 0.05;

/// The normals of `mesh` are not used: the histogram's are smoothNormals() of the welded mesh, which exist for any
/// file. Precondition: that of Triangles. Pure; the same for any number of threads. Triangles keep their numbers, even
/// if some are excluded. Memory: about 200 bytes per triangle of a closed mesh, 500 if each is isolated. Errors: limit
/// for more than 2^32 / 3 triangles or 2^32 points; those of histogramOf and cubeVolumes.
Result<MeshMeasures> measureMesh(const Triangles& mesh, const MeshSettings& settings, JobSystem& jobs);

}  // namespace sgm::measure
