#pragma once
// The point nearest to a set of planes: the minimiser of dual contouring's quadratic error function (Ju et al. 2002),
// by Jacobi's eigenvalue iteration. Doubles with + - * / sqrt alone: the same bits everywhere.

#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

namespace sgm {

using Vector3 = std::array<double, 3>;

inline double dot(const Vector3& a, const Vector3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
inline Vector3 minus(const Vector3& a, const Vector3& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
inline Vector3 cross(const Vector3& a, const Vector3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// Planes normal . (x - start) = distance, summed up.
struct PlaneSum {
  std::array<Vector3, 3> squares{};  ///< of the normals: their outer products
  Vector3 right{};                   ///< normals times distances

  void add(const Vector3& normal, double distance) {
    for (size_t i = 0; i < 3; ++i) {
      for (size_t j = 0; j < 3; ++j) squares[i][j] += normal[i] * normal[j];
      right[i] += normal[i] * distance;
    }
  }
};

/// The step from the sum's start to the nearest point, along the `rank` directions that the planes tell most of and in
/// no direction that they tell less than 1/1000 of the first about.
inline Vector3 stepToPlanes(const PlaneSum& planes, size_t rank) {
  std::array<Vector3, 3> a = planes.squares, axes{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  constexpr int kSweeps = 8;  // the iteration converges quadratically: five are enough for doubles
  for (int sweep = 0; sweep < kSweeps; ++sweep) {
    for (const auto& [p, q] : {std::pair<size_t, size_t>{0, 1}, {0, 2}, {1, 2}}) {
      if (a[p][q] == 0) continue;
      const double ratio = (a[q][q] - a[p][p]) / (2 * a[p][q]);
      const double tangent = (ratio < 0 ? -1 : 1) / (std::fabs(ratio) + std::sqrt(ratio * ratio + 1));
      const double cosine = 1 / std::sqrt(tangent * tangent + 1), sine = tangent * cosine;
      for (size_t k = 0; k < 3; ++k) {
        const double kp = a[k][p], kq = a[k][q];
        a[k][p] = cosine * kp - sine * kq;
        a[k][q] = sine * kp + cosine * kq;
      }
      for (size_t k = 0; k < 3; ++k) {
        const double pk = a[p][k], qk = a[q][k];
        a[p][k] = cosine * pk - sine * qk;
        a[q][k] = sine * pk + cosine * qk;
        const double x = axes[p][k], y = axes[q][k];
        axes[p][k] = cosine * x - sine * y;
        axes[q][k] = sine * x + cosine * y;
      }
      a[p][q] = a[q][p] = 0;
    }
  }
  std::array<size_t, 3> order{0, 1, 2};
  for (const auto& [i, j] : {std::pair<size_t, size_t>{0, 1}, {1, 2}, {0, 1}}) {
    if (a[order[i]][order[i]] < a[order[j]][order[j]]) std::swap(order[i], order[j]);
  }
  constexpr double kTold = 1e-3;
  const double largest = a[order[0]][order[0]];
  Vector3 step{};
  for (size_t i = 0; i < rank; ++i) {
    const double value = a[order[i]][order[i]];
    if (!(value > kTold * largest)) break;
    const Vector3& axis = axes[order[i]];
    const double along = dot(axis, planes.right) / value;
    for (size_t k = 0; k < 3; ++k) step[k] += along * axis[k];
  }
  return step;
}

}  // namespace sgm
