#pragma once
// Compares a region's mesh with its field: the errors of its normals and vertices.

#include "base/jobs.h"
#include "base/result.h"
#include "mesh/weld.h"
#include "world/world_field.h"

namespace sgm {

/// Angles between normals and the field's gradient, degrees.
struct NormalAngles {
  uint64_t count = 0;
  uint64_t inward = 0;  ///< n . grad f <= 0: pointing into the solid
  double median = 0, p99 = 0, greatest = 0;

  double outward() const {  ///< the share of normals pointing outwards
    return count > 0 ? 1 - static_cast<double>(inward) / static_cast<double>(count) : 1;
  }
};

/// The field is the reference in double precision (field/reference.h), and its gradient uses central differences over
/// `step`: neither shares a line with the code that makes the mesh.
struct FieldAgreement {
  int32_t step = 0;  ///< units, to each side
  uint64_t vertices = 0;
  /// Vertices without a right normal: in a crease the gradient turns by more than a quarter of its length within a step
  /// (bent), on a plateau there is no gradient (flat). They are in neither of the angle statistics.
  uint64_t bent = 0, flat = 0;
  uint64_t bent_inward = 0;  ///< bent vertices whose own normal points inward
  NormalAngles normals;      ///< of the vertices
  NormalAngles faces;        ///< of the triangles, at each of their corners
  /// |f| at the vertices, units: their error if the field is a distance.
  double residual_mean = 0, residual_p99 = 0, residual_max = 0;
  std::array<double, 3> farthest{};  ///< place of residual_max, metres from the mesh's origin
  /// |f| / |grad f|, units: the error to first order, whatever the steepness of the field. For vertices with an angle.
  double offset_mean = 0, offset_p99 = 0, offset_max = 0;
};

/// mesh: of one level of the world, by any backend, without edits. The same bits for any number of threads. Errors:
/// those of WorldField::compile.
Result<FieldAgreement> fieldAgreement(const WorldField& world, JobSystem& jobs, const WorldMesh& mesh, int level);

}  // namespace sgm
