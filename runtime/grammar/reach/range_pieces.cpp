#include "grammar/reach/range_pieces.h"

namespace sgm::reach {

namespace {

constexpr int kDeepest = 8;       ///< maximum number of halvings of a range
constexpr int kAlways = 3;        ///< number of halvings in Mode::all; only pieces without a bound are halved further
constexpr double kNarrow = 1.02;  ///< a range whose ends have at most this ratio is not divided further

bool isNarrow(Interval range) { return range.lo > 0 && range.hi <= kNarrow * range.lo; }

}  // namespace

/// Adds the extents of the pieces to `out`. Returns false if some piece has no bound, or if the budget is used up.
bool RangePieces::divide(RangeValue& value, int depth, const std::function<Extent()>& extent, const StepBudget& budget,
                         std::optional<Extent>& out) const {
  const Interval range = value.v[0];
  const bool short_enough = mode_ == Mode::lost ? depth > 0 : depth >= kAlways;
  if (short_enough || !hasPieces(value)) {
    const Extent e = extent();
    if (budget.isCutShort()) return false;
    if (!e.lost()) {
      addAlternative(out, e);
      return true;
    }
    if (depth >= kDeepest || !hasPieces(value) || isNarrow(range)) return false;
  }
  const double middle = dividingPoint(range);
  bool good = true;
  for (const Interval half : {Interval{range.lo, middle}, Interval{middle, range.hi}}) {
    value.v[0] = half;
    good = good && divide(value, depth + 1, extent, budget, out);
  }
  value.v[0] = range;
  return good;
}

std::optional<Extent> RangePieces::divide(RangeValue& value, const Extent& whole, const std::function<Extent()>& extent,
                                          const StepBudget& budget) const {
  std::optional<Extent> pieces;
  if (!hasPieces(value) || !divide(value, 0, extent, budget, pieces)) return std::nullopt;
  pieces->sure_lo = whole.sure_lo;
  pieces->sure_hi = whole.sure_hi;
  return pieces;
}

Extent RangePieces::boundOver(const std::vector<RangeValue*>& values, const std::function<Extent()>& extent,
                              const StepBudget& budget) const {
  Extent whole = extent();
  if (budget.isCutShort() || whole.empty || (mode_ == Mode::lost && !whole.lost())) return whole;
  for (RangeValue* value : values) {
    const std::optional<Extent> pieces = divide(*value, whole, extent, budget);
    if (budget.isCutShort()) return whole;
    if (!pieces) continue;
    if (mode_ == Mode::lost) return *pieces;
    if (pieces->size() < whole.size()) whole = *pieces;
  }
  return whole;
}

}  // namespace sgm::reach
