#include "base/math.h"

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

// Every step below is one correctly rounded IEEE double operation, so the source alone determines the bits of the
// results. Coefficients are rounded Taylor coefficients: the reduced arguments are so small that a minimax polynomial
// would save only one or two terms.

namespace sgm {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

// pi/2 and ln 2, each as a sum of parts (Cody and Waite's argument reduction). The leading parts have only 33 (pi/2) or
// 32 (ln 2) bits, so that their product with the whole number n of the reduction is exact.
constexpr double kHalfPi1 = 0x1.921fb544p+0;
constexpr double kHalfPi2 = 0x1.0b4611a6p-34;
constexpr double kHalfPi3 = 0x1.3198a2e037073p-69;
constexpr double kTwoOverPi = 0x1.45f306dc9c883p-1;
constexpr double kPiLow = 0x1.1a62633145c07p-53;
constexpr double kLn2High = 0x1.62e42feep-1, kLn2Low = 0x1.a39ef35793c76p-33;
constexpr double kInverseLn2 = 0x1.71547652b82fep+0;

/// Evaluates the sum of c[i] x^i by Horner's rule.
template <size_t N>
double polynomial(const std::array<double, N>& c, double x) {
  double sum = c[N - 1];
  for (size_t i = N - 1; i-- > 0;) sum = sum * x + c[i];
  return sum;
}

constexpr std::array<double, 9> kSinTerms{-1.0 / 6,
                                          1.0 / 120,
                                          -1.0 / 5040,
                                          1.0 / 362880,
                                          -1.0 / 39916800,
                                          1.0 / 6227020800.0,
                                          -1.0 / 1307674368000.0,
                                          1.0 / 355687428096000.0,
                                          -1.0 / 121645100408832000.0};
constexpr std::array<double, 8> kCosTerms{1.0 / 24,
                                          -1.0 / 720,
                                          1.0 / 40320,
                                          -1.0 / 3628800,
                                          1.0 / 479001600,
                                          -1.0 / 87178291200.0,
                                          1.0 / 20922789888000.0,
                                          -1.0 / 6402373705728000.0};

/// The reduced argument of x: x = quarter * pi/2 + value + tail, where |value| is at most slightly above pi/4.
struct Reduced {
  int64_t quarter;
  double value, tail;
};

Reduced reduceAngle(double x) {
  const double n = detFloor(x * kTwoOverPi + 0.5);
  const double high = x - n * kHalfPi1;
  const double middle = n * kHalfPi2;
  const double value = high - middle;
  // The rounding error of `high - middle`, minus the product of n and the last part of pi/2.
  const double tail = ((high - value) - middle) - n * kHalfPi3;
  return {static_cast<int64_t>(n), value, tail};
}

double sinReduced(const Reduced& r) {
  const double square = r.value * r.value;
  const double cube = square * r.value;
  return r.value + (cube * polynomial(kSinTerms, square) + r.tail * (1.0 - 0.5 * square));
}

double cosReduced(const Reduced& r) {
  const double square = r.value * r.value;
  const double half = 0.5 * square;
  const double main = 1.0 - half;
  const double lost = (1.0 - main) - half;
  return main + (lost + (square * square * polynomial(kCosTerms, square) - r.value * r.tail));
}

double sinQuarter(const Reduced& r, int64_t quarter) {
  switch (quarter & 3) {
    case 0:
      return sinReduced(r);
    case 1:
      return cosReduced(r);
    case 2:
      return -sinReduced(r);
    default:
      return -cosReduced(r);
  }
}

constexpr double kMaxAngle = 1e6;

// atan(i / 8)
constexpr std::array<double, 9> kAtanEighths{0.0,
                                             0.12435499454676143503,
                                             0.24497866312686415417,
                                             0.35877067027057222040,
                                             0.46364760900080611621,
                                             0.55859931534356243597,
                                             0.64350110879328438680,
                                             0.71882999962162450542,
                                             0.78539816339744830962};
// The parts of atan(i / 8) that the doubles in kAtanEighths cannot represent.
constexpr std::array<double, 9> kAtanEighthsLow{0,
                                                -3.1253241424539383e-18,
                                                1.0698755618734451e-17,
                                                -2.4623815582638635e-17,
                                                2.2698777452961687e-17,
                                                -5.4556305485916264e-18,
                                                1.5834785051444286e-17,
                                                -2.1478388444456983e-17,
                                                3.061616997868383e-17};
constexpr std::array<double, 7> kAtanTerms{-1.0 / 3, 1.0 / 5, -1.0 / 7, 1.0 / 9, -1.0 / 11, 1.0 / 13, -1.0 / 15};

/// Computes atan(numerator / denominator). Requires 0 <= numerator <= denominator and denominator > 0. Quotients below
/// 3/32 use the series alone: the sum of a tabulated value and the series would lose digits by cancellation.
double atanUnit(double numerator, double denominator) {
  const double quotient = numerator / denominator;
  const int index = static_cast<int>(quotient * 8.0 + 0.5);
  if (quotient < 0.09375)
    return quotient + quotient * (quotient * quotient * polynomial(kAtanTerms, quotient * quotient));
  const double centre = index * 0.125;
  const double z = (quotient - centre) / (1.0 + quotient * centre);
  const size_t i = static_cast<size_t>(index);
  return kAtanEighths[i] + (z + (z * (z * z * polynomial(kAtanTerms, z * z)) + kAtanEighthsLow[i]));
}

constexpr std::array<double, 12> kExpTerms{1.0 / 2,       1.0 / 6,        1.0 / 24,        1.0 / 120,
                                           1.0 / 720,     1.0 / 5040,     1.0 / 40320,     1.0 / 362880,
                                           1.0 / 3628800, 1.0 / 39916800, 1.0 / 479001600, 1.0 / 6227020800.0};

double powerOfTwo(int64_t n) { return std::bit_cast<double>(static_cast<uint64_t>(n + 1023) << 52); }

/// Computes exp(x + tail), where |tail| is small compared with 1.
double expWithTail(double x, double tail) {
  if (x > 709.8) return kInfinity;
  if (x < -745.2) return 0.0;
  const double n = detFloor(x * kInverseLn2 + 0.5);
  const double high = x - n * kLn2High;
  const double low = n * kLn2Low - tail;
  const double r = high - low;
  const double lost = (high - r) - low;
  const double value = 1.0 + (r + (lost + r * r * polynomial(kExpTerms, r)));
  // Multiply by 2^k as two factors, so that neither factor overflows unless the result does, and a subnormal result is
  // rounded only once.
  const int64_t k = static_cast<int64_t>(n), half = k / 2;
  return value * powerOfTwo(half) * powerOfTwo(k - half);
}

/// A positive, finite x as x = (1 + f) * 2^exponent, with 1 + f in [sqrt(1/2), sqrt(2)).
struct Split {
  double f;
  double exponent;
};

Split splitFloat(double x) {
  int64_t exponent = 0;
  if (x < 0x1p-1022) {
    x *= 0x1p54;
    exponent = -54;
  }
  uint64_t bits = std::bit_cast<uint64_t>(x);
  exponent += static_cast<int64_t>(bits >> 52) - 1023;
  bits = (bits & 0xFFFFFFFFFFFFFu) | (uint64_t{1023} << 52);
  double m = std::bit_cast<double>(bits);
  if (m > 0x1.6a09e667f3bcdp+0) {
    m *= 0.5;
    ++exponent;
  }
  return {m - 1.0, static_cast<double>(exponent)};
}

// Coefficients 2/3, 2/5, ... of the series log((1 + s) / (1 - s)) = 2s + s (2/3 s^2 + 2/5 s^4 + ...).
constexpr std::array<double, 11> kLogTerms{2.0 / 3,  2.0 / 5,  2.0 / 7,  2.0 / 9,  2.0 / 11, 2.0 / 13,
                                           2.0 / 15, 2.0 / 17, 2.0 / 19, 2.0 / 21, 2.0 / 23};

struct DoubleDouble {
  double high, low;
};

DoubleDouble fastTwoSum(double a, double b) {  // |a| >= |b|
  const double sum = a + b;
  return {sum, b - (sum - a)};
}

DoubleDouble twoSum(double a, double b) {
  const double sum = a + b;
  const double part = sum - a;
  return {sum, (a - (sum - part)) + (b - part)};
}

/// Computes a * b as product plus rounding error (Dekker's exact product). It splits both factors into halves, because
/// the arithmetic contract forbids fused multiply-add.
DoubleDouble twoProduct(double a, double b) {
  const double product = a * b;
  const double split_a = 134217729.0 * a, split_b = 134217729.0 * b;
  const double a_high = split_a - (split_a - a), a_low = a - a_high;
  const double b_high = split_b - (split_b - b), b_low = b - b_high;
  return {product, ((a_high * b_high - product) + a_high * b_low + a_low * b_high) + a_low * b_low};
}

/// Computes log x with about 12 bits more than a double has: detPow multiplies the logarithm, and thus also its error,
/// by the exponent.
DoubleDouble logExtended(double x) {
  const Split split = splitFloat(x);
  const DoubleDouble denominator = fastTwoSum(2.0, split.f);
  const double s = split.f / denominator.high;
  const DoubleDouble product = twoProduct(s, denominator.high);
  const double s_low = (((split.f - product.high) - product.low) - s * denominator.low) / denominator.high;
  const double square = s * s;
  const double series = s * (square * polynomial(kLogTerms, square)) + 2.0 * s_low;
  const DoubleDouble mantissa = twoSum(2.0 * s, series);
  const DoubleDouble main = twoSum(split.exponent * kLn2High, mantissa.high);
  const double rest = main.low + (mantissa.low + split.exponent * kLn2Low);
  return fastTwoSum(main.high, rest);
}

}  // namespace

double detFloor(double x) {
  if (!(std::fabs(x) < 0x1p52)) return x;
  const double whole = static_cast<double>(static_cast<int64_t>(x));
  if (whole == x) return x;
  return whole > x ? whole - 1.0 : whole;
}

double detSin(double x) {
  if (!(std::fabs(x) <= kMaxAngle)) return kNan;
  const Reduced r = reduceAngle(x);
  return sinQuarter(r, r.quarter);
}

double detCos(double x) {
  if (!(std::fabs(x) <= kMaxAngle)) return kNan;
  const Reduced r = reduceAngle(x);
  return sinQuarter(r, r.quarter + 1);
}

double detAtan2(double y, double x) {
  if (std::isnan(x) || std::isnan(y)) return kNan;
  double ax = std::fabs(x), ay = std::fabs(y);
  if (std::isinf(ax) && std::isinf(ay)) ax = ay = 1.0;
  const bool steep = ay > ax;
  double angle = 0.0;
  if (steep) {
    angle = kPi / 2 - (atanUnit(ax, ay) - kPiLow / 2);
  } else if (ax > 0.0) {
    angle = atanUnit(ay, ax);
  }
  if (std::signbit(x)) angle = kPi - (angle - kPiLow);
  return std::signbit(y) ? -angle : angle;
}

double detExp(double x) {
  if (std::isnan(x)) return kNan;
  return expWithTail(x, 0.0);
}

double detLog(double x) {
  if (std::isnan(x) || x < 0.0) return kNan;
  if (x == 0.0) return -kInfinity;
  if (std::isinf(x)) return kInfinity;
  const Split split = splitFloat(x);
  const double f = split.f;
  const double s = f / (2.0 + f);
  const double square = s * s;
  const double half = 0.5 * f * f;
  const double series = square * polynomial(kLogTerms, square);
  return split.exponent * kLn2High - ((half - (s * (half + series) + split.exponent * kLn2Low)) - f);
}

double detPow(double x, double y) {
  if (y == 0.0 || x == 1.0) return 1.0;
  if (std::isnan(x) || std::isnan(y) || x < 0.0) return kNan;
  if (x == 0.0) return y > 0.0 ? 0.0 : kInfinity;
  if (std::isinf(x)) return y > 0.0 ? kInfinity : 0.0;
  if (std::isinf(y)) return (x > 1.0) == (y > 0.0) ? kInfinity : 0.0;
  const DoubleDouble logarithm = logExtended(x);
  const double estimate = y * logarithm.high;
  if (!(std::fabs(estimate) < 800.0)) return estimate > 0.0 ? kInfinity : 0.0;
  const DoubleDouble product = twoProduct(y, logarithm.high);
  return expWithTail(product.high, product.low + y * logarithm.low);
}

}  // namespace sgm
