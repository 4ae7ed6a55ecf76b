#pragma once
// Mathematics for host code that feeds derived data: the same bits from every compiler and C library. Uses IEEE double
// + - * / alone (contraction is off in every target). The largest relative error is 4e-16 unless a function states
// another; arguments are in radians.

#include <limits>

namespace sgm {

inline constexpr double kInfinity = std::numeric_limits<double>::infinity();
inline constexpr double kPi = 0x1.921fb54442d18p+1;

/// The product of two bounds, where 0 times infinity is 0: an infinite bound means that no bound is known.
inline double boundProduct(double a, double b) { return a == 0 || b == 0 ? 0.0 : a * b; }

double detSin(double x);  ///< |x| <= 1e6; absolute error under 4e-16 + 1e-16 |x|
double detCos(double x);  ///< same as detSin
double detAtan2(double y, double x);
double detExp(double x);  ///< relative error 4e-16; absolute error 5e-324 for x < -708.4, where results are subnormal
double detLog(double x);  ///< x > 0; -infinity for x = 0; NaN for x < 0
double detPow(double x, double y);  ///< x >= 0; relative error under 1e-14 if |y log x| < 100
double detFloor(double x);          ///< exact

}  // namespace sgm
