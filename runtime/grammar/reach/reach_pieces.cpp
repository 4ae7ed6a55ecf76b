// A tighter proof where plain intervals lose too much: they ignore that a value used twice is the same both times, so
// that `r / (0.3*r)` and a displacement by a part of its operand look worse than they are. Over short pieces of the
// range of such a value little is lost; together the pieces cover the range.

#include <algorithm>
#include <cmath>

#include "grammar/reach/reach_check.h"

namespace sgm {

namespace {

constexpr int kDeepest = 8;       ///< halvings of a range
constexpr int kAlways = 3;        ///< halvings of each range if there is a bound, but too far out
constexpr double kNarrow = 1.02;  ///< ratio of the ends of a range that is not worth another division

bool isNarrow(Interval range) { return range.lo > 0 && range.hi <= kNarrow * range.lo; }

}  // namespace

/// The extent over all pieces of a range. Returns false if some piece has no bound, however short it is.
bool ReachCheck::cut(RangeValue& value, int depth, const std::function<Extent()>& extent, Extent& out, bool& first) {
  const Interval range = value.v[0];
  const bool short_enough = pieces_ == Pieces::lost ? depth > 0 : depth >= kAlways;
  if (short_enough || !hasPieces(value)) {
    const Extent e = extent();
    if (cut_short_) return false;
    if (!e.lost()) {
      if (first)
        out = e;
      else
        out.either(e);
      first = false;
      return true;
    }
    if (depth >= kDeepest || !hasPieces(value) || isNarrow(range)) return false;
  }
  const double middle = dividingPoint(range);
  bool good = true;
  for (const Interval half : {Interval{range.lo, middle}, Interval{middle, range.hi}}) {
    value.v[0] = half;
    good = good && cut(value, depth + 1, extent, out, first);
  }
  value.v[0] = range;
  return good;
}

/// The extent for all possible values, each in pieces if that helps.
Extent ReachCheck::overPieces(const std::vector<RangeValue*>& values, const std::function<Extent()>& extent) {
  Extent whole = extent();
  if (cut_short_ || whole.empty || (pieces_ == Pieces::lost && !whole.lost())) return whole;
  for (RangeValue* value : values) {
    if (!hasPieces(*value)) continue;
    Extent pieces = Extent::nothing();
    bool first = true;
    if (!cut(*value, 0, extent, pieces, first)) {
      if (cut_short_) return whole;
      continue;
    }
    // The certain reach applies to the whole range, as without pieces.
    pieces.sure_lo = whole.sure_lo;
    pieces.sure_hi = whole.sure_hi;
    if (pieces_ == Pieces::lost) return pieces;
    if (pieces.size() < whole.size()) whole = pieces;
  }
  return whole;
}

Extent ReachCheck::ruleInPieces(uint32_t rule, std::vector<RangeValue> args, const RangeFrame& caller, bool top) {
  std::vector<RangeValue*> values;
  for (RangeValue& arg : args) values.push_back(&arg);
  return overPieces(values, [&] { return ruleExtent(rule, args, caller, top); });
}

/// The same for a parameter of the grammar, which may be used anywhere.
Extent ReachCheck::overParameters(uint32_t layer) {
  Extent whole = startExtent(layer);
  const std::vector<bool> asked = values_.usedParameters();
  for (uint32_t p = 0; p < asked.size() && !cut_short_; ++p) {
    if (!asked[p]) continue;
    RangeValue value = RangeValue::number(values_.parameter(p));
    Extent pieces = Extent::nothing();
    bool first = true;
    const bool good = hasPieces(value) && cut(
                                              value, 0,
                                              [&] {
                                                values_.parameter(p) = value.v[0];
                                                return startExtent(layer);
                                              },
                                              pieces, first);
    values_.parameter(p) = value.v[0];
    if (!good) continue;
    pieces.sure_lo = whole.sure_lo;
    pieces.sure_hi = whole.sure_hi;
    return pieces;
  }
  return whole;
}

}  // namespace sgm
