#pragma once
// Vectors, transforms and other plain values, laid out as the engine's own in builds with single precision. The library
// refuses to be loaded into other builds.

#include <cstdint>

namespace sgm_godot {

struct Vector2 {
  float x = 0, y = 0;
};
struct Vector3 {
  float x = 0, y = 0, z = 0;
  friend Vector3 operator+(Vector3 a, Vector3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
  friend Vector3 operator-(Vector3 a, Vector3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
  friend Vector3 operator*(Vector3 a, float s) { return {a.x * s, a.y * s, a.z * s}; }
};
struct Vector3i {
  int32_t x = 0, y = 0, z = 0;
  friend bool operator==(const Vector3i&, const Vector3i&) = default;
};
struct Vector4i {
  int32_t x = 0, y = 0, z = 0, w = 0;
};
struct Quaternion {
  float x = 0, y = 0, z = 0, w = 1;
};
struct Color {
  float r = 1, g = 1, b = 1, a = 1;
  friend bool operator==(const Color&, const Color&) = default;
};
struct Aabb {
  Vector3 position, size;
};
struct Transform {
  Vector3 rows[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  Vector3 origin;
  Vector3 column(int i) const {
    return i == 0   ? Vector3{rows[0].x, rows[1].x, rows[2].x}
           : i == 1 ? Vector3{rows[0].y, rows[1].y, rows[2].y}
                    : Vector3{rows[0].z, rows[1].z, rows[2].z};
  }
  /// Returns the transform that applies `first` and then *this.
  Transform after(const Transform& first) const;
  Vector3 apply(Vector3 v) const;
  Vector3 turn(Vector3 v) const;  // rotates and scales a vector without translating it
  Transform inverse() const;      // returns the identity if the transform has no inverse
};
struct Rid {
  uint64_t id = 0;
  explicit operator bool() const { return id != 0; }
};
static_assert(sizeof(Vector3) == 12 && sizeof(Transform) == 48 && sizeof(Aabb) == 24 && sizeof(Rid) == 8);

}  // namespace sgm_godot
