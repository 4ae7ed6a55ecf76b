#pragma once
// Places and directions between whole units, in double precision.

#include <array>

namespace sgm {

using Vec3 = std::array<double, 3>;

inline double dot(const Vec3& a, const Vec3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
inline Vec3 scaled(const Vec3& a, double by) { return {a[0] * by, a[1] * by, a[2] * by}; }

}  // namespace sgm
