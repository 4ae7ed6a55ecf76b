#pragma once
// The placement of a scope during derivation: double precision, in metres from an integer base, so that a cell 2,000 km
// from the origin computes the same numbers as one at the origin.

#include <array>

#include "base/fixed.h"
#include "derive/shape.h"

namespace sgm {

/// A position in metres, or a direction, in double precision.
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
Vec3 normalised(Vec3 a);  ///< returns the unit vector in this direction; a zero vector stays zero
/// Returns the unit vector perpendicular to `tangent` (of length 1) that is closest to `wanted`.
Vec3 across(Vec3 tangent, Vec3 wanted);

/// Converts metres to units, rounded to nearest, saturating at the ends of the world. NaN gives 0.
int32_t toUnits(double metres);

/// A transform from local coordinates to the world: world = base + offset + scale * (axes * local). The axes are
/// orthonormal; with a mirror their determinant is -1. The scale is uniform and positive, since a non-uniform scale
/// would shear rotated content.
struct Placement {
  Int3 base;    ///< low corner of the cell being derived, units
  Vec3 offset;  ///< origin of the local coordinates, in metres relative to base
  std::array<double, 9> axes{1, 0, 0, 0, 1, 0, 0, 0, 1};  ///< row-major matrix whose columns are the local axes
  double scale = 1;

  /// converts a local direction to the world: rotates and mirrors, but does not scale
  Vec3 direction(Vec3 local) const;
  Vec3 toCell(Vec3 local) const;   ///< converts a local position to metres relative to base
  Vec3 fromCell(Vec3 cell) const;  ///< inverse of toCell()
  Int3 snap(Vec3 local) const;     ///< converts a local position to world units, rounded to nearest

  Placement moved(Vec3 local) const;
  /// Returns the placement rotated right-handed by `angle` radians (at most 1e6) about `axis`, which may have any
  /// length. Quarter turns about a coordinate axis are exact. A zero axis changes nothing.
  Placement turned(Vec3 axis, double angle) const;
  Placement scaled(double factor) const;
  Placement mirrored(int axis) const;

  /// Returns the frame of a shape centred at `local`. The centre is rounded to units. The rows of the frame's matrix
  /// are computed in double precision and rounded to float.
  Frame frame(Vec3 local = {}) const;
};

}  // namespace sgm
