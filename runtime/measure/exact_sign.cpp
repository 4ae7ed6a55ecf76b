#include "measure/exact_sign.h"

#include <cmath>
#include <limits>
#include <vector>

namespace sgm::measure {
namespace {

using asset::Point;

constexpr double kHalfUlp = std::numeric_limits<double>::epsilon() / 2;
constexpr double kSpaceError = (7 + 56 * kHalfUlp) * kHalfUlp;
constexpr double kPlaneError = (3 + 16 * kHalfUlp) * kHalfUlp;

/// A sum of doubles that do not overlap, the smallest first: the exact value of an expression.
using Expansion = std::vector<double>;

/// a + b, and what rounding took from it.
void twoSum(double a, double b, double& sum, double& error) {
  sum = a + b;
  const double bb = sum - a;
  error = (a - (sum - bb)) + (b - bb);
}

/// The upper half of the digits; the rest is a double of half as many.
double upperHalf(double v) {
  const double large = 134217729 * v;
  return large - (large - v);
}

/// a * b, and what rounding took from it, which is itself a double (Dekker, 1971; without a fused operation).
void twoProduct(double a, double b, double& product, double& error) {
  product = a * b;
  const double a_high = upperHalf(a), b_high = upperHalf(b), a_low = a - a_high, b_low = b - b_high;
  error = a_low * b_low - (((product - a_high * b_high) - a_low * b_high) - a_high * b_low);
}

void add(Expansion& sum, double term) {
  Expansion grown;
  grown.reserve(sum.size() + 1);
  for (const double part : sum) {
    double rest = 0;
    twoSum(term, part, term, rest);
    if (rest != 0) grown.push_back(rest);
  }
  if (term != 0) grown.push_back(term);
  sum = std::move(grown);
}

Expansion difference(double a, double b) {
  Expansion result;
  add(result, a);
  add(result, -b);
  return result;
}

Expansion product(const Expansion& a, const Expansion& b) {
  Expansion result;
  for (const double x : a) {
    for (const double y : b) {
      double high = 0, error = 0;
      twoProduct(x, y, high, error);
      add(result, error);
      add(result, high);
    }
  }
  return result;
}

void addProduct(Expansion& sum, const Expansion& a, const Expansion& b, double sign) {
  for (const double part : product(a, b)) add(sum, sign * part);
}

int signOf(double v) { return v > 0 ? 1 : v < 0 ? -1 : 0; }
/// The largest part decides.
int signOf(const Expansion& e) { return e.empty() ? 0 : signOf(e.back()); }

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
    Expansion minor = product(v[y], w[z]);
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
  return exactOrientation(a, b, c, d);
}

int orientationAlong(int drop, Point a, Point b, Point c) {
  const int x = (drop + 1) % 3, y = (drop + 2) % 3;
  const double left = (a[x] - c[x]) * (b[y] - c[y]), right = (a[y] - c[y]) * (b[x] - c[x]);
  const double determinant = left - right;
  if (std::fabs(determinant) > kPlaneError * (std::fabs(left) + std::fabs(right))) return signOf(determinant);
  Expansion exact = product(difference(a[x], c[x]), difference(b[y], c[y]));
  addProduct(exact, difference(a[y], c[y]), difference(b[x], c[x]), -1);
  return signOf(exact);
}

}  // namespace sgm::measure
