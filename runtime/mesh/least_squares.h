#pragma once
// The point nearest to a set of planes: the minimiser of the quadratic error function of dual contouring (Ju et al.
// 2002), by Jacobi's eigenvalue iteration. Uses doubles with + - * / sqrt alone, so that all machines compute the same
// bits.

#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

#include "base/vec3.h"

namespace sgm {

/// Sums over planes normal . (x - start) = distance; they define the quadratic error function.
struct PlaneSum {
  std::array<Vector3, 3> squares{};  ///< sum of the outer products normal * normal^T over the planes
  Vector3 right{};                   ///< sum of normal * distance over the planes

  void add(const Vector3& normal, double distance) {
    for (size_t i = 0; i < 3; ++i) {
      for (size_t j = 0; j < 3; ++j) squares[i][j] += normal[i] * normal[j];
      right[i] += normal[i] * distance;
    }
  }
};

/// The eigenvectors and eigenvalues of a PlaneSum.
class PlaneAxes {
 public:
  explicit PlaneAxes(const PlaneSum& planes) : right_(planes.right) {
    std::array<Vector3, 3> a = planes.squares;
    // maximum number of sweeps, with a margin: convergence is quadratic, so five sweeps are enough for doubles
    constexpr int kSweeps = 8;
    constexpr double kSettled = 1e-30;
    const double all = a[0][0] * a[0][0] + a[1][1] * a[1][1] + a[2][2] * a[2][2];
    for (int sweep = 0; sweep < kSweeps; ++sweep) {
      const double left = a[0][1] * a[0][1] + a[0][2] * a[0][2] + a[1][2] * a[1][2];
      if (left <= kSettled * all) break;
      for (const auto& [p, q] : {std::pair<size_t, size_t>{0, 1}, {0, 2}, {1, 2}}) {
        if (a[p][q] != 0) rotate(p, q, a);
      }
    }
    for (const auto& [i, j] : {std::pair<size_t, size_t>{0, 1}, {1, 2}, {0, 1}}) {
      if (a[order_[i]][order_[i]] < a[order_[j]][order_[j]]) std::swap(order_[i], order_[j]);
    }
    for (size_t k = 0; k < 3; ++k) told_[k] = a[k][k];
  }

  /// Returns the step from `start` (of PlaneSum) to the point nearest to the planes. Moves only along the first `rank`
  /// eigenvectors in descending order of their eigenvalues, and not along one whose eigenvalue is below 1/1000 of the
  /// largest: the planes do not determine the point well in that direction.
  Vector3 step(size_t rank) const {
    constexpr double kTold = 1e-3;
    Vector3 step{};
    for (size_t i = 0; i < rank; ++i) {
      const double value = told_[order_[i]];
      if (!(value > kTold * told_[order_[0]])) break;
      const Vector3& axis = axes_[order_[i]];
      const double along = dot(axis, right_) / value;
      for (size_t k = 0; k < 3; ++k) step[k] += along * axis[k];
    }
    return step;
  }

 private:
  void rotate(size_t p, size_t q, std::array<Vector3, 3>& a) {
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
      const double x = axes_[p][k], y = axes_[q][k];
      axes_[p][k] = cosine * x - sine * y;
      axes_[q][k] = sine * x + cosine * y;
    }
    a[p][q] = a[q][p] = 0;
  }

  std::array<Vector3, 3> axes_{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  Vector3 right_, told_{};
  std::array<size_t, 3> order_{0, 1, 2};
};

/// Returns the shortest step that ends in both planes; a plane contains the steps with normal . step = distance.
/// Normals have length 1; a missing plane has normal 0. If the normals are nearly opposite, returns the step to the
/// middle between the two planes.
inline Vector3 stepToBoth(const Vector3& a, double to_a, const Vector3& b, double to_b) {
  constexpr double kFacing = 1e-3;
  const double cosine = dot(a, b), square = 1 - cosine * cosine;
  Vector3 step;
  if (1 + cosine > kFacing) {
    const double along_a = (to_a - cosine * to_b) / square, along_b = (to_b - cosine * to_a) / square;
    for (size_t k = 0; k < 3; ++k) step[k] = along_a * a[k] + along_b * b[k];
  } else {
    const double along = (to_a - to_b) / (2 * (1 - cosine));
    for (size_t k = 0; k < 3; ++k) step[k] = along * (a[k] - b[k]);
  }
  return step;
}

}  // namespace sgm
