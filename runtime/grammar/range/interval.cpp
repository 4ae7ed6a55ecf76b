#include "grammar/range/interval.h"

#include <algorithm>
#include <cmath>

#include "base/math.h"

namespace sgm {

namespace {

/// Widens an interval by some units in the last place, which exceeds the rounding error of one operation. Small whole
/// numbers, as in guards and counts, are exact and stay unchanged.
Interval outwards(double lo, double hi) {
  auto whole = [](double v) { return v == std::floor(v) && std::fabs(v) < 1e9; };
  if (std::isnan(lo)) lo = -kInfinity;
  if (std::isnan(hi)) hi = kInfinity;
  if (!whole(lo)) lo -= std::fabs(lo) * 1e-15;
  if (!whole(hi)) hi += std::fabs(hi) * 1e-15;
  return {lo, hi};
}

}  // namespace

Interval Interval::everything() { return {-kInfinity, kInfinity}; }
bool Interval::bounded() const { return std::isfinite(lo) && std::isfinite(hi); }
double Interval::magnitude() const { return std::max(std::fabs(lo), std::fabs(hi)); }
double Interval::mignitude() const { return lo <= 0 && hi >= 0 ? 0 : std::min(std::fabs(lo), std::fabs(hi)); }

Interval operator+(Interval a, Interval b) {
  if (a.exact() && b.exact()) return Interval::exactly(a.lo + b.lo);
  return outwards(a.lo + b.lo, a.hi + b.hi);
}
Interval operator-(Interval a) { return {-a.hi, -a.lo}; }
Interval operator-(Interval a, Interval b) { return a + -b; }

Interval operator*(Interval a, Interval b) {
  if (a.exact() && b.exact()) return Interval::exactly(boundProduct(a.lo, b.lo));
  const double c[4] = {boundProduct(a.lo, b.lo), boundProduct(a.lo, b.hi), boundProduct(a.hi, b.lo),
                       boundProduct(a.hi, b.hi)};
  return outwards(*std::min_element(c, c + 4), *std::max_element(c, c + 4));
}

Interval operator/(Interval a, Interval b) {
  if (b.lo <= 0 && b.hi >= 0) return Interval::everything();
  if (a.exact() && b.exact()) return Interval::exactly(a.lo / b.lo);
  const double c[4] = {a.lo / b.lo, a.lo / b.hi, a.hi / b.lo, a.hi / b.hi};
  if (std::any_of(c, c + 4, [](double v) { return std::isnan(v); })) return Interval::everything();
  return outwards(*std::min_element(c, c + 4), *std::max_element(c, c + 4));
}

Interval hull(Interval a, Interval b) { return {std::min(a.lo, b.lo), std::max(a.hi, b.hi)}; }
Interval minimum(Interval a, Interval b) { return {std::min(a.lo, b.lo), std::min(a.hi, b.hi)}; }
Interval maximum(Interval a, Interval b) { return {std::max(a.lo, b.lo), std::max(a.hi, b.hi)}; }
Interval atLeastZero(Interval a) { return {std::max(0.0, a.lo), std::max(0.0, a.hi)}; }
Interval positivePart(Interval a) { return {std::max(a.lo, 0.0), std::max(a.hi, 0.0)}; }
Interval absolute(Interval a) { return {a.mignitude(), a.magnitude()}; }
Interval floorOf(Interval a) { return {std::floor(a.lo), std::floor(a.hi)}; }

Interval squareRoot(Interval a) { return outwards(std::sqrt(std::max(a.lo, 0.0)), std::sqrt(std::max(a.hi, 0.0))); }

Interval cosine(Interval a) {
  if (!a.bounded() || a.magnitude() > 1e5 || a.hi - a.lo >= 2 * kPi) return {-1, 1};
  const double c = detCos(a.lo), d = detCos(a.hi);
  constexpr double kSlack = 1e-9;
  double lo = std::min(c, d) - kSlack, hi = std::max(c, d) + kSlack;
  // The cosine has an extreme value at each multiple of pi in the range.
  for (double k = std::ceil((a.lo - kSlack) / kPi); k * kPi <= a.hi + kSlack; k += 1)
    (std::fmod(std::fabs(k), 2.0) == 0 ? hi : lo) = std::fmod(std::fabs(k), 2.0) == 0 ? 1 : -1;
  return {std::max(lo, -1.0), std::min(hi, 1.0)};
}

Interval sine(Interval a) { return cosine(a - Interval::exactly(kPi / 2)); }

Interval power(Interval a, Interval b) {
  if (!a.bounded() || !b.bounded() || a.lo < 0) return Interval::everything();
  const double c[4] = {detPow(a.lo, b.lo), detPow(a.lo, b.hi), detPow(a.hi, b.lo), detPow(a.hi, b.hi)};
  if (std::any_of(c, c + 4, [](double v) { return !std::isfinite(v); })) return Interval::everything();
  const double lo = *std::min_element(c, c + 4), hi = *std::max_element(c, c + 4);
  return {std::max(0.0, lo * (1 - 1e-12)), hi * (1 + 1e-12)};
}

Interval smoothStep(Interval low, Interval high, Interval x) {
  // If the step's edges are equal or not known exactly, or if x is unbounded, return the full range 0..1.
  if (!low.exact() || !high.exact() || low.lo == high.lo || !x.bounded()) return {0, 1};
  auto at = [&](double v) {
    const double t = std::clamp((v - low.lo) / (high.lo - low.lo), 0.0, 1.0);
    return t * t * (3 - 2 * t);
  };
  const Interval out = hull(Interval::exactly(at(x.lo)), Interval::exactly(at(x.hi)));
  return {std::max(0.0, out.lo - 1e-9), std::min(1.0, out.hi + 1e-9)};
}

}  // namespace sgm
