// Tests that the elementary functions of shaders/common/real.h differ from long double by at most the stated errors.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <random>

#include "catch.h"

namespace {

using std::memcpy;

#include "common/common.h"

// Number of floats from 0.5 up to 2: every mantissa with two successive exponents. These are all cases of a function
// that for other exponents only scales its result.
constexpr uint32_t kMantissas = 1u << 24;

float atStep(uint32_t step) { return uniformFloat(0x3F000000u + step); }

struct Worst {
  long double error = 0;
  float at = 0, second = 0;
  void add(long double e, float x, float y = 0) {
    if (std::isnan(e) || e > error) error = e, at = x, second = y;
  }
};

long double relative(float got, long double want) {
  return std::fabs(static_cast<long double>(got) - want) / std::fabs(want);
}

float anyMagnitude(std::mt19937& random, int lowest, int highest) {
  const auto exponent = static_cast<int>(random() % static_cast<uint32_t>(highest - lowest)) + lowest;
  return std::ldexp(atStep(random() % (kMantissas / 2)), exponent + 1);
}

}  // namespace

TEST_CASE("square root and reciprocals stay within their stated errors over every mantissa") {
  Worst rsqrt, root, recip;
  for (uint32_t step = 0; step < kMantissas; step += 3) {
    const float x = atStep(step);
    const auto exact = static_cast<long double>(x);
    rsqrt.add(relative(rsqrtReal(x), 1 / std::sqrt(exact)), x);
    root.add(relative(sqrtReal(x), std::sqrt(exact)), x);
    recip.add(relative(recipReal(x), 1 / exact), x);
  }
  const uint32_t seed = 20271;
  CAPTURE(seed);
  std::mt19937 random(seed);
  for (int i = 0; i < 200000; ++i) {
    const float x = anyMagnitude(random, -126, 127), y = anyMagnitude(random, -120, 120);
    rsqrt.add(relative(rsqrtReal(x), 1 / std::sqrt(static_cast<long double>(x))), x);
    root.add(relative(sqrtReal(x), std::sqrt(static_cast<long double>(x))), x);
    recip.add(relative(recipReal(y), 1 / static_cast<long double>(y)), y);
  }
  CAPTURE(rsqrt.at, root.at, recip.at);
  CHECK(static_cast<double>(rsqrt.error) < 3e-7);
  CHECK(static_cast<double>(root.error) < 4e-7);
  CHECK(static_cast<double>(recip.error) < 2e-7);
  CHECK(sqrtReal(0.0f) == 0.0f);
  CHECK(std::isfinite(rsqrtReal(0.0f)));
}

TEST_CASE("powers and logarithms stay within their stated errors") {
  const uint32_t seed = 20272;
  CAPTURE(seed);
  std::mt19937 random(seed);
  Worst exponential, logarithm, power;
  const auto check_log = [&](float x) {
    const long double exact = std::log2(static_cast<long double>(x));
    const long double error = std::fabs(static_cast<long double>(log2Real(x)) - exact);
    logarithm.add(error / std::fmax(1.0L, std::fabs(exact)), x);
  };
  for (uint32_t step = 0; step < kMantissas; step += 7) check_log(atStep(step));
  for (int i = 0; i < 400000; ++i) {
    const float x = std::uniform_real_distribution<float>(-126.0f, 126.0f)(random);
    exponential.add(relative(exp2Real(x), std::exp2(static_cast<long double>(x))), x);
    check_log(anyMagnitude(random, -126, 127));
    const float a = i % 2 ? std::uniform_real_distribution<float>(0.0f, 1.0f)(random) : anyMagnitude(random, -40, 0);
    const float n = std::uniform_real_distribution<float>(1.0f, 20.0f)(random);
    const long double exact = std::pow(static_cast<long double>(a), static_cast<long double>(n));
    power.add(std::fabs(static_cast<long double>(powReal(a, n)) - exact), a, n);
  }
  for (int whole = -126; whole <= 126; ++whole) {
    CHECK(exp2Real(static_cast<float>(whole)) == std::ldexp(1.0f, whole));
    const float halfway = static_cast<float>(whole) + 0.5f;
    if (whole < 126)
      exponential.add(relative(exp2Real(halfway), std::exp2(static_cast<long double>(halfway))), halfway);
  }
  CAPTURE(exponential.at, logarithm.at, power.at, power.second);
  CHECK(static_cast<double>(exponential.error) < 3e-7);
  CHECK(static_cast<double>(logarithm.error) < 4e-7);
  CHECK(static_cast<double>(power.error) < 1e-5);
  CHECK(powReal(1.0f, 20.0f) == 1.0f);
  CHECK(powReal(0.0f, 1.0f) < 1.2e-38f);
  CHECK(std::fabs(log2Real(0.0f) + 127.0f) < 1.0f);
}

TEST_CASE("floor, division, saturation and quantisation keep their promises at the ends of their ranges") {
  const uint32_t seed = 20273;
  CAPTURE(seed);
  std::mt19937 random(seed);
  Worst quotient;
  for (int i = 0; i < 200000; ++i) {
    const float sign = random() % 2 ? -1.0f : 1.0f;
    const float x = sign * anyMagnitude(random, -126, 30);
    REQUIRE(floorReal(x) == std::floor(x));
    const float a = sign * anyMagnitude(random, -3, 3),
                b = (random() % 2 ? -1.0f : 1.0f) * anyMagnitude(random, -120, 120);
    quotient.add(relative(divideReal(a, b), static_cast<long double>(a) / static_cast<long double>(b)), a, b);
    const auto p = static_cast<int32_t>(random()), c = static_cast<int32_t>(random());
    const int64_t exact = int64_t{p} - c;
    REQUIRE(saturatingSub(p, c) == std::min<int64_t>(std::max<int64_t>(exact, INT32_MIN), INT32_MAX));
  }
  CAPTURE(quotient.at, quotient.second);
  CHECK(static_cast<double>(quotient.error) < 4e-7);
  CHECK(divideReal(3.0f, 0.0f) == 0.0f);
  CHECK(quantise(0.4999f, 1.0f) == 0);
  CHECK(quantise(0.5f, 1.0f) == 1);
  CHECK(quantise(-0.5f, 1.0f) == 0);
  CHECK(quantise(-0.5001f, 1.0f) == -1);
  CHECK(quantise(1e30f, 1.0f) == 4194304);
  CHECK(quantise(-1e30f, 1.0f) == -4194304);
}

TEST_CASE("a place in the noise lattice is exact over every offset and period") {
  const uint32_t seed = 20274;
  CAPTURE(seed);
  std::mt19937 random(seed);
  auto check = [](int32_t offset, int32_t period) {
    const LatticePlace place = latticePlace(offset, period, static_cast<float>(1.0 / period));
    int64_t cell = int64_t{offset} / period;
    if (int64_t{offset} % period < 0) --cell;
    const int64_t rest = int64_t{offset} - cell * period;
    if (place.cell == cell && place.rest == rest) return;
    CAPTURE(offset, period, place.cell, place.rest, cell, rest);
    REQUIRE(place.cell == cell);
    REQUIRE(place.rest == rest);
  };
  for (int i = 0; i < 2'000'000; ++i) {
    const auto offset = static_cast<int32_t>(random());
    const auto period = static_cast<int32_t>(1 + (random() >> (1 + random() % 31)));
    check(offset, period);
    // Positions at the corners of the noise lattice, and next to them.
    const int64_t corner = int64_t{offset} / period * period + static_cast<int64_t>(random() % 3) - 1;
    check(static_cast<int32_t>(std::min<int64_t>(std::max<int64_t>(corner, INT32_MIN), INT32_MAX)), period);
  }
  for (int32_t period : {1, 2, 3, 7, 1000, 1024, 0x3FFFFFFF, 0x40000000, INT32_MAX - 1, INT32_MAX}) {
    for (int32_t k = 0; k < 4000; ++k) {
      check(INT32_MAX - k, period);
      check(INT32_MIN + k, period);
      check(k - 2000, period);
    }
  }
}

TEST_CASE("products, quotients and roots treat what is under 1e-30 as 0, denormals included") {
  auto of = [](float v) { return makeDual(v, v, -v, 1.0f, 0); };
  const float normal = 3.0f;
  for (int exponent = -149; exponent <= -101; ++exponent) {
    for (float sign : {1.0f, -1.0f}) {
      const float tiny = sign * std::ldexp(1.0f, exponent);
      CAPTURE(exponent, sign);
      CHECK(opDivide(of(normal), of(tiny)).v == 0.0f);
      CHECK(opDivide(of(tiny), of(normal)).v == 0.0f);
      CHECK(opMultiply(of(tiny), of(1e18f)).v == 0.0f);
      CHECK(opMultiply(of(normal), of(tiny)).v == 0.0f);
      CHECK(opSquareRoot(of(tiny)).v == 0.0f);
      CHECK(opAdd(of(tiny), of(0.0f)).v == 0.0f);
      CHECK(std::fabs(opDivide(of(normal), of(tiny)).x) <= 1e18f);
    }
  }
  CHECK(opMultiply(of(1e-16f), of(1e-15f)).v == 0.0f);
  CHECK(opMultiply(of(1e-14f), of(1e-15f)).v > 0.9e-29f);
  CHECK(opDivide(of(normal), of(2e-30f)).v == 1e18f);
  CHECK(opDivide(of(normal), of(-2e-30f)).v == -1e18f);
  CHECK(opSquareRoot(of(4e-30f)).v > 1.9e-15f);
}
