#include "vectors.h"

#include <cmath>

namespace sgm_godot {

Transform Transform::after(const Transform& first) const {
  Transform result;
  for (int i = 0; i < 3; ++i) {
    const Vector3& r = rows[i];
    result.rows[i] = first.rows[0] * r.x + first.rows[1] * r.y + first.rows[2] * r.z;
  }
  result.origin = apply(first.origin);
  return result;
}

Vector3 Transform::turn(Vector3 v) const {
  const auto dot = [&](const Vector3& r) { return r.x * v.x + r.y * v.y + r.z * v.z; };
  return {dot(rows[0]), dot(rows[1]), dot(rows[2])};
}

Vector3 Transform::apply(Vector3 v) const { return turn(v) + origin; }

Transform Transform::inverse() const {
  const Vector3 a = column(0), b = column(1), c = column(2);
  const auto cross = [](Vector3 u, Vector3 v) {
    return Vector3{u.y * v.z - u.z * v.y, u.z * v.x - u.x * v.z, u.x * v.y - u.y * v.x};
  };
  const Vector3 bc = cross(b, c), ca = cross(c, a), ab = cross(a, b);
  const float determinant = a.x * bc.x + a.y * bc.y + a.z * bc.z;
  Transform result;
  if (determinant == 0 || !std::isfinite(determinant)) return result;
  const float s = 1 / determinant;
  result.rows[0] = bc * s;
  result.rows[1] = ca * s;
  result.rows[2] = ab * s;
  result.origin = result.turn(origin) * -1.0f;
  return result;
}

}  // namespace sgm_godot
