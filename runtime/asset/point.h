#pragma once
// Points and directions of assets, in metres and double precision. The functions use + - * / and sqrt alone, so every
// machine computes the same bits.

#include <cmath>

namespace sgm::asset {

struct Point {
  double x = 0, y = 0, z = 0;

  double operator[](int axis) const { return axis == 0 ? x : axis == 1 ? y : z; }
  double& operator[](int axis) { return axis == 0 ? x : axis == 1 ? y : z; }

  friend bool operator==(const Point&, const Point&) = default;
  friend Point operator+(Point a, Point b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
  friend Point operator-(Point a, Point b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
  friend Point operator*(double s, Point a) { return {s * a.x, s * a.y, s * a.z}; }
};

inline double dot(Point a, Point b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Point cross(Point a, Point b) { return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x}; }
inline double length(Point a) { return std::sqrt(dot(a, a)); }
/// Returns the vector scaled to length 1; the zero vector stays 0.
inline Point normalised(Point a) {
  const double size = length(a);
  return size > 0 ? (1.0 / size) * a : Point{};
}

/// An oriented plane: the solid lies behind it, where the signed distance is negative.
struct Plane {
  Point normal;
  double offset = 0;

  double distance(Point p) const { return dot(normal, p) - offset; }
  Plane turned() const { return {-1.0 * normal, -offset}; }
};

}  // namespace sgm::asset
