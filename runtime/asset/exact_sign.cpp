#include "asset/exact_sign.h"

#include <cmath>
#include <limits>

namespace sgm::asset {
namespace {

constexpr double kHalfUlp = std::numeric_limits<double>::epsilon() / 2;
constexpr double kSpaceError = (7 + 56 * kHalfUlp) * kHalfUlp;
constexpr double kPlaneError = (3 + 16 * kHalfUlp) * kHalfUlp;

/// An exact value, represented as the sum of non-overlapping doubles, the smallest first. It lives on the stack, since
/// allocation would be slow: on flat ground almost every pair of neighbouring triangles needs such values.
template <size_t kMost>
struct Expansion {
  double parts[kMost];
  size_t size = 0;
};

/// Computes a + b and its rounding error.
void twoSum(double a, double b, double& sum, double& error) {
  sum = a + b;
  const double bb = sum - a;
  error = (a - (sum - bb)) + (b - bb);
}

/// Returns the upper half of the mantissa's bits, so that the remainder is also a double with half as many bits.
double upperHalf(double v) {
  const double large = 134217729 * v;
  return large - (large - v);
}

/// Computes a * b and its rounding error, which is representable as a double (Dekker, 1971; without fused
/// multiply-add).
void twoProduct(double a, double b, double& product, double& error) {
  product = a * b;
  const double a_high = upperHalf(a), b_high = upperHalf(b), a_low = a - a_high, b_low = b - b_high;
  error = a_low * b_low - (((product - a_high * b_high) - a_low * b_high) - a_high * b_low);
}

template <size_t kMost>
void add(Expansion<kMost>& sum, double term) {
  size_t kept = 0;
  for (size_t i = 0; i < sum.size; ++i) {
    double rest = 0;
    twoSum(term, sum.parts[i], term, rest);
    if (rest != 0) sum.parts[kept++] = rest;
  }
  if (term != 0) sum.parts[kept++] = term;
  sum.size = kept;
}

Expansion<2> difference(double a, double b) {
  Expansion<2> result;
  add(result, a);
  add(result, -b);
  return result;
}

/// Adds the product sign * a * b to `sum`, exactly.
template <size_t kMost, size_t kA, size_t kB>
void addProduct(Expansion<kMost>& sum, const Expansion<kA>& a, const Expansion<kB>& b, double sign) {
  for (size_t i = 0; i < a.size; ++i) {
    for (size_t j = 0; j < b.size; ++j) {
      double high = 0, error = 0;
      twoProduct(a.parts[i], b.parts[j], high, error);
      add(sum, sign * error);
      add(sum, sign * high);
    }
  }
}

int signOf(double v) { return v > 0 ? 1 : v < 0 ? -1 : 0; }
/// Returns the sign of the sum. It is the sign of the largest component, because the components do not overlap.
template <size_t kMost>
int signOf(const Expansion<kMost>& e) {
  return e.size == 0 ? 0 : signOf(e.parts[e.size - 1]);
}

int exactOrientation(Point a, Point b, Point c, Point d) {
  Expansion<2> u[3], v[3], w[3];
  for (int axis = 0; axis < 3; ++axis) {
    u[axis] = difference(a[axis], d[axis]);
    v[axis] = difference(b[axis], d[axis]);
    w[axis] = difference(c[axis], d[axis]);
  }
  // Capacity 192: each product of two components adds at most two components.
  Expansion<192> determinant;
  for (int axis = 0; axis < 3; ++axis) {
    const int y = (axis + 1) % 3, z = (axis + 2) % 3;
    Expansion<16> minor;
    addProduct(minor, v[y], w[z], 1);
    addProduct(minor, v[z], w[y], -1);
    addProduct(determinant, u[axis], minor, 1);
  }
  return signOf(determinant);
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
  if (size == 0) return 0;  // all terms of the determinant are 0, as for planes perpendicular to an axis
  return exactOrientation(a, b, c, d);
}

int orientationAlong(int drop, Point a, Point b, Point c) {
  const int x = (drop + 1) % 3, y = (drop + 2) % 3;
  const double left = (a[x] - c[x]) * (b[y] - c[y]), right = (a[y] - c[y]) * (b[x] - c[x]);
  const double determinant = left - right;
  if (std::fabs(determinant) > kPlaneError * (std::fabs(left) + std::fabs(right))) return signOf(determinant);
  if (left == 0 && right == 0) return 0;
  Expansion<16> exact;
  addProduct(exact, difference(a[x], c[x]), difference(b[y], c[y]), 1);
  addProduct(exact, difference(a[y], c[y]), difference(b[x], c[x]), -1);
  return signOf(exact);
}

}  // namespace sgm::asset
