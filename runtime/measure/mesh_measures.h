#pragma once
// All that is measured of one triangle mesh.

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
  double weld = 0;  ///< weldPoints()'s tolerance, in the mesh's unit
  HistogramSettings histogram;
  bool self_intersections = true;
  /// For what lies close together or above each other, times the number of triangles: where a mesh needs more steps
  /// than that, MeshMeasures::complete() is false.
  uint64_t steps_a_triangle = 5000;
  std::optional<double> cubes;  ///< the edge of the cubes that are counted; nothing: none are
  std::optional<Cut> cut;       ///< where the mesh was cut from a larger one
  MeasureProgress progress;     ///< of the search for self-intersections, which takes longest
};

struct MeshMeasures {
  size_t points = 0, triangles = 0;  ///< as given
  size_t unused_points = 0;          ///< that no triangle has
  size_t welded_points = 0;          ///< that fell on others
  size_t non_finite = 0;             ///< triangles with a corner beyond kFarthest or NaN: left out of all that follows
  std::optional<uint32_t> first_non_finite;

  /// Of the welded mesh, by vertices. What degenerate, flat, folded and cut are: mesh/triangle_faults.h.
  MeshReport identity;
  size_t flat_triangles = 0;
  size_t slivers = 0;  ///< of quality below kSliver, those without area included
  AreaVolume sums;
  Shells parts;
  Nesting nesting;
  std::optional<SelfIntersections> self_intersections;
  Histogram histogram;
  std::optional<CubeVolumes> cubes;
  uint64_t cut_edges = 0;           ///< of identity.open_edges: those in MeshSettings::cut
  std::vector<DefectPlace> places;  ///< what is wrong, by kind

  size_t withoutArea() const { return identity.degenerate_triangles + flat_triangles; }
  int64_t euler() const;                  ///< summed over shells
  std::optional<uint64_t> genus() const;  ///< likewise; nothing where one has none
  /// Every edge has two triangles that go along it in opposite directions, every vertex one fan, and none is there
  /// twice or has a corner twice. True of a mesh without triangles.
  bool watertight() const { return identity.closed() && non_finite == 0; }
  /// A solid's surface: watertight, facing outward, covered once, without triangles that have no area or that cut each
  /// other (where that was asked), and all of it was looked at. True of a mesh without triangles.
  bool valid() const;
  /// The same of a mesh that was cut: every open edge lies in the cut, and nothing else is wrong. True where valid.
  bool validButForCut() const;
  /// Whether the volume counts some places several times, or not as what they are.
  bool overlaps() const {
    return nesting.nested > 0 || nesting.inside_out > 0 || (self_intersections && self_intersections->pairs > 0);
  }
  /// Whether all that was asked was looked at: `valid` may be false for want of that alone.
  bool complete() const;
};

/// 4 sqrt(3) area / (sum of the squared edges): 1 for equal edges.
inline constexpr double kSliver = 0.05;

/// normals of `mesh` are not asked: the histogram's are smoothNormals() of the welded mesh, which any file has.
/// Contract: that of Triangles. Pure; the same for any number of threads.
/// Triangles are numbered as given, whatever was left out. Memory: some 200 bytes a triangle of a closed mesh,
/// 500 where each is alone. Errors: limit for more than 2^32 / 3 triangles or 2^32 points; those of histogramOf and
/// cubeVolumes.
Result<MeshMeasures> measureMesh(const Triangles& mesh, const MeshSettings& settings, JobSystem& jobs);

}  // namespace sgm::measure
