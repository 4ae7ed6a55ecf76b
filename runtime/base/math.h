#pragma once
// Deterministic mathematics for host code that feeds derived data: every compiler and C library gives the same bits.
// The functions use IEEE double + - * / alone (contraction is off in every target). The relative error is at most 4e-16
// unless a function states another bound; angles are in radians.

#include <limits>

namespace sgm {

inline constexpr double kInfinity = std::numeric_limits<double>::infinity();
inline constexpr double kPi = 0x1.921fb54442d18p+1;

/// Returns the product of two bounds, where 0 times infinity is 0: an infinite bound means that no bound is known.
inline double boundProduct(double a, double b) { return a == 0 || b == 0 ? 0.0 : a * b; }

double detSin(double x);  ///< requires |x| <= 1e6; absolute error below 4e-16 + 1e-16 |x|
double detCos(double x);  ///< range and error as for detSin
double detAtan2(double y, double x);
double detExp(double x);  ///< relative error 4e-16; for x < -708.4, where results are subnormal, absolute error 5e-324
double detLog(double x);  ///< log x for x > 0; -infinity for x = 0; NaN for x < 0
double detPow(double x, double y);  ///< requires x >= 0; relative error below 1e-14 if |y log x| < 100
double detFloor(double x);          ///< exact

}  // namespace sgm
