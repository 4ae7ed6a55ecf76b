#include "grammar/range/range_value.h"

#include <algorithm>
#include <cmath>

namespace sgm {

bool RangeValue::bounded() const {
  if (kind == ValueKind::number) return v[0].bounded();
  if (kind == ValueKind::pair) return v[0].bounded() && v[1].bounded();
  return kind != ValueKind::vector || (v[0].bounded() && v[1].bounded() && v[2].bounded());
}

void PlaceRange::move(const IntervalVector& by) {
  const IntervalVector step = turned ? anyDirection(by) : by;
  for (size_t i = 0; i < 3; ++i) offset[i] = offset[i] + step[i] * scale;
}

bool hasPieces(const RangeValue& value) {
  return value.kind == ValueKind::number && value.v[0].bounded() && dividingPoint(value.v[0]) > value.v[0].lo &&
         dividingPoint(value.v[0]) < value.v[0].hi;
}

double dividingPoint(Interval range) {
  return range.lo > 0 ? std::sqrt(range.lo) * std::sqrt(range.hi) : range.lo + (range.hi - range.lo) / 2;
}

IntervalVector anyDirection(const IntervalVector& v) {
  double sum = 0;
  for (const Interval& part : v) sum += part.magnitude() * part.magnitude();
  const double length = std::sqrt(sum) * (1 + 1e-12);
  const Interval ball{-length, length};
  return {ball, ball, ball};
}

}  // namespace sgm
