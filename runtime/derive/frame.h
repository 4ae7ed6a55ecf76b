#pragma once
// Placement of a scope during derivation: double precision in metres from an integer base, so that a cell 2,000 km from
// the origin computes the same numbers as one at the origin.

#include <array>

#include "base/fixed.h"
#include "derive/shape.h"

namespace sgm {

/// Metres (or a direction) in double precision.
struct Vec3 {
  double x = 0, y = 0, z = 0;
  double operator[](int axis) const { return axis == 0 ? x : axis == 1 ? y : z; }
  double& operator[](int axis) { return axis == 0 ? x : axis == 1 ? y : z; }
  friend Vec3 operator+(Vec3 a, Vec3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
  friend Vec3 operator-(Vec3 a, Vec3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
  friend Vec3 operator*(double s, Vec3 a) { return {s * a.x, s * a.y, s * a.z}; }
};

double dot(Vec3 a, Vec3 b);
Vec3 cross(Vec3 a, Vec3 b);
double length(Vec3 a);
Vec3 normalised(Vec3 a);  ///< zero stays zero
/// A unit vector perpendicular to `tangent` (of length 1), as close to `wanted` as possible.
Vec3 across(Vec3 tangent, Vec3 wanted);

/// Converts metres to units, rounded to nearest, saturating at the ends of the world. NaN gives 0.
int32_t toUnits(double metres);

/// World to local and back: world = base + offset + scale * (axes * local). The axes are orthonormal columns; a mirror
/// makes their determinant -1. Scale is uniform and positive: any other would shear rotated contents.
struct Placement {
  Int3 base;                                              ///< units; low corner of the deriving cell
  Vec3 offset;                                            ///< metres from base
  std::array<double, 9> axes{1, 0, 0, 0, 1, 0, 0, 0, 1};  ///< row-major matrix whose columns are the local axes
  double scale = 1;

  Vec3 direction(Vec3 local) const;  ///< rotated (and mirrored), not scaled
  Vec3 toCell(Vec3 local) const;     ///< metres from base
  Vec3 fromCell(Vec3 cell) const;    ///< the inverse of toCell
  Int3 snap(Vec3 local) const;       ///< world units, to nearest

  Placement moved(Vec3 local) const;
  /// Rotated right-handed by `angle` radians (at most 1e6) about `axis`, which need not have length 1. Quarter turns
  /// are exact. A zero axis leaves the placement unchanged.
  Placement turned(Vec3 axis, double angle) const;
  Placement scaled(double factor) const;
  Placement mirrored(int axis) const;

  /// The frame of a shape centred at `local`: the centre is snapped to units, and the rows are rounded once to float.
  Frame frame(Vec3 local = {}) const;
};

}  // namespace sgm
