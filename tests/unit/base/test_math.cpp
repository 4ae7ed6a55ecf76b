#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>

#include "base/hash.h"
#include "base/math.h"
#include "catch.h"

using namespace sgm;

namespace {

constexpr int kSamples = 200000;

struct Worst {
  long double error = 0;
  double at = 0, second = 0;
  void add(long double e, double x, double y = 0) {
    if (std::isnan(e) || e > error) error = e, at = x, second = y;
  }
};

long double extended(double x) { return static_cast<long double>(x); }

long double relative(double got, long double want) {
  if (want == 0) return got == 0 ? 0 : 1;
  return std::fabs(extended(got) - want) / std::fabs(want);
}

}  // namespace

TEST_CASE("sine and cosine stay within the stated absolute error") {
  const uint32_t seed = 20261;
  CAPTURE(seed);
  std::mt19937_64 random(seed);
  Worst sine, cosine, unit;
  for (int i = 0; i < kSamples; ++i) {
    const double reach = i % 3 == 0 ? 4.0 : i % 3 == 1 ? 1000.0 : 1e6;
    const double x = std::uniform_real_distribution<double>(-reach, reach)(random);
    const long double allowed = 4e-16L + 1e-16L * std::fabs(extended(x));
    sine.add(std::fabs(extended(detSin(x)) - std::sin(extended(x))) / allowed, x);
    cosine.add(std::fabs(extended(detCos(x)) - std::cos(extended(x))) / allowed, x);
    unit.add(extended(std::fabs(detSin(x) * detSin(x) + detCos(x) * detCos(x) - 1)), x);
  }
  CAPTURE(sine.at, cosine.at, unit.at);
  CHECK(static_cast<double>(sine.error) < 1.0);
  CHECK(static_cast<double>(cosine.error) < 1.0);
  CHECK(static_cast<double>(unit.error) < 1e-15);
  CHECK(detSin(0.0) == 0.0);
  CHECK(detCos(0.0) == 1.0);
  CHECK(std::isnan(detSin(std::numeric_limits<double>::infinity())));
  CHECK(std::isnan(detCos(2e6)));
}

TEST_CASE("arc tangent stays within the stated relative error in every quadrant") {
  const uint32_t seed = 20262;
  CAPTURE(seed);
  std::mt19937_64 random(seed);
  Worst worst;
  for (int i = 0; i < kSamples; ++i) {
    std::uniform_real_distribution<double> wide(-1.0, 1.0), power(-30.0, 30.0);
    const double y = wide(random) * std::exp2(i % 2 ? power(random) : 0.0);
    const double x = wide(random);
    worst.add(relative(detAtan2(y, x), std::atan2(extended(y), extended(x))), y, x);
  }
  CAPTURE(worst.at, worst.second);
  CHECK(static_cast<double>(worst.error) < 4e-16);
  CHECK(detAtan2(0.0, 1.0) == 0.0);
  CHECK(detAtan2(0.0, 0.0) == 0.0);
  CHECK(detAtan2(1.0, 0.0) == std::acos(0.0));
  CHECK(detAtan2(0.0, -1.0) == 2 * std::acos(0.0));
  CHECK(detAtan2(-0.0, -1.0) == -2 * std::acos(0.0));
}

TEST_CASE("exponential and logarithm stay within the stated relative error") {
  const uint32_t seed = 20263;
  CAPTURE(seed);
  std::mt19937_64 random(seed);
  Worst exponential, logarithm;
  for (int i = 0; i < kSamples; ++i) {
    const double reach = i % 2 ? 2.0 : 700.0;
    const double x = std::uniform_real_distribution<double>(-reach, reach)(random);
    exponential.add(relative(detExp(x), std::exp(extended(x))), x);
    const double near_one = 1.0 + std::uniform_real_distribution<double>(-0.4, 0.4)(random);
    const double y = i % 2 ? near_one : std::exp2(std::uniform_real_distribution<double>(-1070, 1020)(random));
    logarithm.add(relative(detLog(y), std::log(extended(y))), y);
  }
  // The smallest positive double is 4.94e-324. Rounding changes a subnormal number by up to half of that; the bound is
  // twice as large.
  Worst subnormal;
  for (int i = 0; i < kSamples; ++i) {
    const double x = std::uniform_real_distribution<double>(-750.0, -708.4)(random);
    subnormal.add(std::fabs(extended(detExp(x)) - std::exp(extended(x))), x);
  }
  CAPTURE(exponential.at, logarithm.at, subnormal.at);
  CHECK(subnormal.error < extended(std::numeric_limits<double>::denorm_min()));
  CHECK(static_cast<double>(exponential.error) < 4e-16);
  CHECK(static_cast<double>(logarithm.error) < 4e-16);
  CHECK(detExp(0.0) == 1.0);
  CHECK(detExp(-1000.0) == 0.0);
  CHECK(std::isinf(detExp(1000.0)));
  CHECK(detLog(1.0) == 0.0);
  CHECK(detLog(0.0) == -std::numeric_limits<double>::infinity());
  CHECK(std::isnan(detLog(-1.0)));
}

TEST_CASE("powers stay within the stated relative error") {
  const uint32_t seed = 20264;
  CAPTURE(seed);
  std::mt19937_64 random(seed);
  Worst worst;
  for (int i = 0; i < kSamples; ++i) {
    const double x = std::exp2(std::uniform_real_distribution<double>(-20, 20)(random));
    const double y = std::uniform_real_distribution<double>(-7, 7)(random);
    worst.add(relative(detPow(x, y), std::pow(extended(x), extended(y))), x, y);
  }
  CAPTURE(worst.at, worst.second);
  CHECK(static_cast<double>(worst.error) < 1e-14);
  CHECK(detPow(0.0, 2.0) == 0.0);
  CHECK(detPow(0.0, 0.0) == 1.0);
  CHECK(detPow(2.0, 10.0) == 1024.0);
  CHECK(detPow(3.0, 4.0) == 81.0);
  CHECK(std::isnan(detPow(-1.0, 0.5)));
}

TEST_CASE("floor is exact") {
  for (double x : {0.0, 0.5, -0.5, 1.0, -1.0, 1e15 + 0.5, -1e15 - 0.5, 1e300, -1e300, 4503599627370495.5}) {
    CAPTURE(x);
    CHECK(detFloor(x) == std::floor(x));
  }
}

TEST_CASE("every compiler and optimisation level gives the same bits") {
  uint64_t hash = 0;
  for (uint64_t i = 0; i < 20000; ++i) {
    const double a = PathKey{7}.unit(i), b = PathKey{11}.unit(i);
    for (double v : {detSin((a - 0.5) * 2e3), detCos((b - 0.5) * 2e6), detAtan2(a - 0.5, b - 0.5),
                     detExp((a - 0.5) * 100), detLog(a + b * 1e-9), detPow(a * 10, b * 8 - 4), detFloor(a * 1e6)}) {
      hash = hashCombine(hash, std::bit_cast<uint64_t>(v));
    }
  }
  CHECK(hash == 0xf2f6b12f0a456f60u);
}
