#pragma once
// Places and directions between whole units, in double precision.

#include "mesh/least_squares.h"

namespace sgm {

using Vec3 = Vector3;

inline Vec3 scaled(const Vec3& a, double by) { return {a[0] * by, a[1] * by, a[2] * by}; }

}  // namespace sgm
