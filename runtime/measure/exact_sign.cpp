#include "measure/exact_sign.h"

#include <cmath>
#include <cstddef>
#include <limits>

namespace sgm::measure {
namespace {

using asset::Point;

constexpr double kHalfUlp = std::numeric_limits<double>::epsilon() / 2;
constexpr double kSpaceError = (7 + 56 * kHalfUlp) * kHalfUlp;
constexpr double kPlaneError = (3 + 16 * kHalfUlp) * kHalfUlp;

/// The upper half of the digits; the rest is a double of half as many.
double upperHalf(double v) {
  const double large = 134217729 * v;
  return large - (large - v);
}

/// What rounding takes from a * b, which is itself a double (Dekker, 1971; without a fused operation).
double productError(double a, double b) {
  const double a_high = upperHalf(a), b_high = upperHalf(b), a_low = a - a_high, b_low = b - b_high;
  return a_low * b_low - (((a * b - a_high * b_high) - a_low * b_high) - a_high * b_low);
}

/// A sum of doubles that do not overlap, the smallest first: the exact value of an expression. Small ones are the rule:
/// faces that lie in one plane are asked again and again.
class Expansion {
 public:
  /// Of the largest expression here: 3 products of 2 and 16 parts, each of which has two.
  static constexpr size_t kMost = 192;

  const double* begin() const { return parts_; }
  const double* end() const { return parts_ + size_; }

  void add(double term) {
    size_t kept = 0;
    for (size_t i = 0; i < size_; ++i) {
      // What rounding takes from the sum stays behind as a part of its own.
      const double part = parts_[i], sum = term + part, taken = sum - term;
      const double rest = (term - (sum - taken)) + (part - taken);
      if (rest != 0) parts_[kept++] = rest;
      term = sum;
    }
    if (term != 0) parts_[kept++] = term;
    size_ = kept;
  }
  void addProduct(const Expansion& a, const Expansion& b, double sign) {
    for (const double x : a) {
      for (const double y : b) {
        add(sign * productError(x, y));
        add(sign * (x * y));
      }
    }
  }
  /// The largest part decides.
  int sign() const { return size_ == 0 ? 0 : parts_[size_ - 1] > 0 ? 1 : -1; }

 private:
  double parts_[kMost];
  size_t size_ = 0;
};

Expansion difference(double a, double b) {
  Expansion result;
  result.add(a);
  result.add(-b);
  return result;
}

int signOf(double v) { return v > 0 ? 1 : v < 0 ? -1 : 0; }
int exactOrientation(Point a, Point b, Point c, Point d) {
  Expansion u[3], v[3], w[3];
  for (int axis = 0; axis < 3; ++axis) {
    u[axis] = difference(a[axis], d[axis]);
    v[axis] = difference(b[axis], d[axis]);
    w[axis] = difference(c[axis], d[axis]);
  }
  Expansion determinant;
  for (int axis = 0; axis < 3; ++axis) {
    const int y = (axis + 1) % 3, z = (axis + 2) % 3;
    Expansion minor;
    minor.addProduct(v[y], w[z], 1);
    minor.addProduct(v[z], w[y], -1);
    determinant.addProduct(u[axis], minor, 1);
  }
  return determinant.sign();
}

}  // namespace

int orientation(Point a, Point b, Point c, Point d) {
  const Point u = a - d, v = b - d, w = c - d;
  const double vw_x = v.y * w.z, wv_x = v.z * w.y, vw_y = v.z * w.x, wv_y = v.x * w.z, vw_z = v.x * w.y,
               wv_z = v.y * w.x;
  const double determinant = u.x * (vw_x - wv_x) + u.y * (vw_y - wv_y) + u.z * (vw_z - wv_z);
  const double size = std::fabs(u.x) * (std::fabs(vw_x) + std::fabs(wv_x)) +
                      std::fabs(u.y) * (std::fabs(vw_y) + std::fabs(wv_y)) +
                      std::fabs(u.z) * (std::fabs(vw_z) + std::fabs(wv_z));
  if (std::fabs(determinant) > kSpaceError * size) return signOf(determinant);
  return exactOrientation(a, b, c, d);
}

int orientationAlong(int drop, Point a, Point b, Point c) {
  const int x = (drop + 1) % 3, y = (drop + 2) % 3;
  const double left = (a[x] - c[x]) * (b[y] - c[y]), right = (a[y] - c[y]) * (b[x] - c[x]);
  const double determinant = left - right;
  if (std::fabs(determinant) > kPlaneError * (std::fabs(left) + std::fabs(right))) return signOf(determinant);
  Expansion exact;
  exact.addProduct(difference(a[x], c[x]), difference(b[y], c[y]), 1);
  exact.addProduct(difference(a[y], c[y]), difference(b[x], c[x]), -1);
  return exact.sign();
}

}  // namespace sgm::measure
