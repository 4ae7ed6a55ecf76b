#pragma once
// Closed intervals of doubles for the proof of reach. Every operation rounds outwards, so results contain all exact
// values.

#include <array>

namespace sgm {

struct Interval {
  double lo = 0, hi = 0;

  static Interval exactly(double v) { return {v, v}; }
  static Interval everything();
  bool exact() const { return lo == hi; }
  bool holds(double v) const { return lo <= v && v <= hi; }
  bool bounded() const;
  double magnitude() const;  ///< the largest absolute value in the interval
  double mignitude() const;  ///< the smallest absolute value in the interval
  friend bool operator==(const Interval&, const Interval&) = default;
  friend bool operator<(const Interval& a, const Interval& b) { return a.lo != b.lo ? a.lo < b.lo : a.hi < b.hi; }
};

Interval operator+(Interval a, Interval b);
Interval operator-(Interval a, Interval b);
Interval operator-(Interval a);
Interval operator*(Interval a, Interval b);
Interval operator/(Interval a, Interval b);  ///< all numbers if b contains 0
Interval hull(Interval a, Interval b);
Interval minimum(Interval a, Interval b);
Interval maximum(Interval a, Interval b);
Interval atLeastZero(Interval a);   ///< the maximum of a and 0; an end that is NaN becomes 0
Interval positivePart(Interval a);  ///< the maximum of a and 0; an end that is NaN stays NaN
Interval absolute(Interval a);
Interval squareRoot(Interval a);  ///< the square root of a; negative values of `a` are ignored
Interval floorOf(Interval a);
Interval sine(Interval a);
Interval cosine(Interval a);
Interval power(Interval a, Interval b);  ///< a to the power of b; negative values of `a` are ignored
Interval smoothStep(Interval low, Interval high, Interval x);

using IntervalVector = std::array<Interval, 3>;

}  // namespace sgm
