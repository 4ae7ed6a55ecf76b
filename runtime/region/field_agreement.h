#pragma once
// Compares a region's mesh with its field: the errors of its normals and vertices.

#include "base/jobs.h"
#include "base/result.h"
#include "mesh/weld.h"
#include "world/world_field.h"

namespace sgm {

/// Statistics of the angles between normals and gradients of the field, in degrees.
struct NormalAngles {
  uint64_t count = 0;
  uint64_t inward = 0;  ///< number of normals that point into the solid: n . grad f <= 0
  double median = 0, p99 = 0, greatest = 0;

  double outward() const {  ///< the share of normals that point outwards, 0 to 1
    return count > 0 ? 1 - static_cast<double>(inward) / static_cast<double>(count) : 1;
  }
};

/// The result of the comparison. The reference evaluator (field/reference.h) computes the field in double precision;
/// the gradient is a central difference with the distance `step`. Neither shares code with meshing, so they can show
/// the errors of the mesh.
struct FieldAgreement {
  /// step of the central differences that give the gradient: distance in units from the vertex to the samples on each
  /// side
  int32_t step = 0;
  uint64_t vertices = 0;
  /// Numbers of vertices for which no normal is correct. bent: vertices in a crease, where the gradient turns by more
  /// than a quarter of its length within a step; flat: vertices on a plateau, without a gradient. The angle statistics
  /// exclude both.
  uint64_t bent = 0, flat = 0;
  uint64_t bent_inward = 0;  ///< number of the vertices in `bent` whose normal in the mesh points into the solid
  NormalAngles normals;      ///< angles of the vertices' normals
  /// angles of the triangles' normals; each is compared with the gradients at the triangle's three corners
  NormalAngles faces;
  /// Statistics of |f| at the vertices, in units. This is their distance from the surface, if the field is a distance.
  double residual_mean = 0, residual_p99 = 0, residual_max = 0;
  /// position of the vertex with the value residual_max, in metres from the mesh's origin
  std::array<double, 3> farthest{};
  /// Statistics of |f| / |grad f|, in units. To first order, this is the distance from the surface, whether the field
  /// is steep or not. Includes only those vertices that the angle statistics include.
  double offset_mean = 0, offset_p99 = 0, offset_max = 0;
};

/// Measures a mesh. mesh: the mesh of one level of the world, by any backend, without edits. The result has the same
/// bits for any number of threads. Errors: those of WorldField::compile.
Result<FieldAgreement> fieldAgreement(const WorldField& world, JobSystem& jobs, const WorldMesh& mesh, int level);

}  // namespace sgm
