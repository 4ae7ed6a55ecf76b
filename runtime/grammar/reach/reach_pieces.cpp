// A tighter proof where intervals alone lose too much: they forget that a value which is used twice is the same both
// times, so that `r / (0.3*r)` and a displacement by a part of what it displaces look worse than they are. Over short
// pieces of the range of such a value little is lost; all pieces together are all of it.

#include <algorithm>
#include <cmath>

#include "grammar/reach/reach_check.h"

namespace sgm {

namespace {

constexpr int kDeepest = 8;       ///< cuts of one range in two
constexpr int kAlways = 3;        ///< cuts of each range where a bound is there and too far
constexpr double kNarrow = 1.02;  ///< of the ends of a range that is not worth another cut

bool isNarrow(Interval range) { return range.lo > 0 && range.hi <= kNarrow * range.lo; }

}  // namespace

/// The extent over all of a range in pieces. False if some piece has no bound, however short it is.
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
  const double middle = middleOf(range);
  bool good = true;
  for (const Interval half : {Interval{range.lo, middle}, Interval{middle, range.hi}}) {
    value.v[0] = half;
    good = good && cut(value, depth + 1, extent, out, first);
  }
  value.v[0] = range;
  return good;
}

/// The extent for all that the values may be, each of them in pieces if that helps.
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
    // How far it reaches for certain is said of all of the range, as without pieces.
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

/// The same for a parameter of the grammar, whose uses stand anywhere.
Extent ReachCheck::overParameters(uint32_t layer) {
  Extent whole = startExtent(layer);
  const std::vector<bool> asked = values_.askedParameters();
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
