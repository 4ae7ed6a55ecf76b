#pragma once
// How a region's mesh follows the field that it is made of: what its normals and its vertices are off by.

#include "base/jobs.h"
#include "base/result.h"
#include "mesh/weld.h"
#include "world/world_field.h"

namespace sgm {

/// Angles between normals and the field's gradient, degrees.
struct NormalAngles {
  uint64_t count = 0;
  uint64_t inward = 0;  ///< n . grad f <= 0: into the solid
  double median = 0, p99 = 0, greatest = 0;

  double outward() const {  ///< their share
    return count > 0 ? 1 - static_cast<double>(inward) / static_cast<double>(count) : 1;
  }
};

/// The field is the reference in double precision (field/reference.h), and its gradient that one's central differences
/// over `step`: neither has a line in common with what makes the mesh.
struct FieldAgreement {
  int32_t step = 0;  ///< units, to each side
  uint64_t vertices = 0;
  /// Vertices of which the gradient turns by more than a quarter of its length within a step, in a crease, or of which
  /// there is none, in a plateau: no normal is the right one. They are in neither of the angles.
  uint64_t bent = 0, flat = 0;
  uint64_t bent_inward = 0;  ///< of the bent ones, by their own normals
  NormalAngles normals;      ///< that the vertices have
  NormalAngles faces;        ///< of the triangles, at each of their corners
  /// |f| at the vertices, units: how far off they are where the field is a distance.
  double residual_mean = 0, residual_p99 = 0, residual_max = 0;
  std::array<double, 3> farthest{};  ///< where that is, metres from the mesh's origin
  /// |f| / |grad f|, units: how far off they are, to first order, whatever the field is steep. Of those with an angle.
  double offset_mean = 0, offset_p99 = 0, offset_max = 0;
};

/// mesh: of one level of the world, by whatever backend, without edits. The same bits for any number of threads.
/// Errors: those of WorldField::compile.
Result<FieldAgreement> fieldAgreement(const WorldField& world, JobSystem& jobs, const WorldMesh& mesh, int level);

}  // namespace sgm
