#include <algorithm>
#include <cmath>
#include <utility>

#include "base/math.h"
#include "grammar/range/argument_ranges.h"
#include "grammar/reach/reach_check.h"

namespace sgm {

namespace {

constexpr double kFarthest = 1e6;  ///< metres; upper limit for a finite domain without a box

}  // namespace

ReachCheck::ReachCheck(Program& program, const CompileLimits& limits, DiagnosticSink& sink)
    : program_(program),
      sink_(sink),
      limits_(limits),
      lossy_(sink.errorCount() > 0),
      steps_(limits.bound_steps),
      values_(program, steps_),
      active_(program.rules.size(), 0),
      counted_(program.rules.size(), false),
      derived_(program.rules.size()) {
  for (uint32_t r = 0; r < program.rules.size(); ++r)
    for (const Alternative& a : program.rules[r].alternatives) counted_[r] = counted_[r] || a.depth != kNoId;
}

void ReachCheck::run() {
  for (uint32_t l = 0; l < program_.layers.size() && !sink_.full(); ++l) layerReach(l);
  if (sink_.errorCount() == 0 && !cut_short_) idleHeads();
}

void ReachCheck::setCell(const Layer& layer) {
  IntervalVector edges;
  for (int axis = 0; axis < 3; ++axis) edges[static_cast<size_t>(axis)] = Interval::exactly(layer.cell[axis] * kUnit);
  // In a finite domain without a box the shapes' bounds determine the box, not vice versa.
  if (isFinite(layer) && program_.domain.box.empty()) edges.fill({0, kInfinity});
  centred_ = isFinite(layer);
  whole_ = layer.cell_expr == kNoId;
  values_.setCell(edges, centred_);
  cell_ = edges;
}

void ReachCheck::layerReach(uint32_t index) {
  Layer& layer = program_.layers[index];
  const bool boxed = !program_.domain.box.empty();
  setCell(layer);
  const uint32_t errors = sink_.errorCount();
  // Later attempts use other cells than the layer's, or parts of ranges.
  values_.misfits().enable(true);
  const Extent extent = provenExtent(index);
  values_.misfits().enable(false);
  reportMisfits(program_, values_.misfits().take(), sink_);
  if (sink_.full()) return;
  reportObservation(layer, values_.observation());
  // A division by 0 also has no bound; do not report that as a second error.
  if (sink_.full() || (sink_.errorCount() > errors && !isEnough(layer, extent))) return;

  for (int axis = 0; axis < 3; ++axis) {
    const Interval side = extent.empty ? Interval{1, 0} : extent.at.may[static_cast<size_t>(axis)];
    // A NaN end is no bound: min and max then return their first argument.
    const double lo = std::min(std::max(-3e9, std::floor(side.lo * kUnitsPerMetre)), 3e9);
    const double hi = std::max(std::min(3e9, std::ceil(side.hi * kUnitsPerMetre)), -3e9);
    layer.bound.lo[axis] = saturate(static_cast<int64_t>(lo));
    layer.bound.hi[axis] = saturate(static_cast<int64_t>(hi));
  }
  if (isFinite(layer) && !boxed) return finiteBox(layer, extent);
  layer.proven = isEnough(layer, extent);
  if (!layer.proven) report(index, extent);
}

ReachCheck::Excess ReachCheck::excessOf(const Layer& layer, const Extent& extent) const {
  Excess over;
  const bool finite = isFinite(layer);
  for (int axis = 0; axis < 3 && !extent.empty; ++axis) {
    const size_t i = static_cast<size_t>(axis);
    if (!program_.domain.axes[i] && program_.domain.infinite) continue;
    double low = -layer.reach * kUnit, high = layer.cell[axis] * kUnit + layer.reach * kUnit;
    if (finite) low = program_.domain.box.lo[axis] * kUnit, high = program_.domain.box.hi[axis] * kUnit;
    over.may = std::max({over.may, low - extent.at.may[i].lo, extent.at.may[i].hi - high});
    over.sure = std::max({over.sure, low - extent.sure_lo[i], extent.sure_hi[i] - high});
  }
  return over;
}

bool ReachCheck::isEnough(const Layer& layer, const Extent& extent) const {
  if (cut_short_) return false;
  if (isFinite(layer) && program_.domain.box.empty()) return extent.empty || extent.size() <= kFarthest;
  return excessOf(layer, extent).may <= 0;
}

Extent ReachCheck::provenExtent(uint32_t index) {
  const Layer& layer = program_.layers[index];
  const uint32_t before = steps_;
  Extent extent = startExtent(index);
  if (cut_short_ && !few_pieces_) {
    few_pieces_ = true;
    cut_short_ = false;
    steps_ = limits_.bound_steps;
    extent = startExtent(index);
  }
  spent_ += before - std::min(before, steps_);
  reportZeroDivisions();
  if (cut_short_ || isEnough(layer, extent)) return extent;
  const Observation observation = values_.observation();
  const auto attempt = [&](Pieces pieces, bool parameters) {
    if (cut_short_ || isEnough(layer, extent)) return;
    pieces_ = pieces;
    values_.takePieces(true);
    steps_ = limits_.bound_steps;
    const Extent tighter = parameters ? overParameters(index) : startExtent(index);
    spent_ += limits_.bound_steps - steps_;
    // A result cut short by the budget proves nothing.
    if (!std::exchange(cut_short_, false) && (tighter.empty || tighter.size() < extent.size())) extent = tighter;
    pieces_ = Pieces::none;
    values_.takePieces(false);
    values_.observation() = observation;
    steps_ = limits_.bound_steps;
  };
  if (extent.lost()) attempt(Pieces::lost, false);
  if (extent.lost()) attempt(Pieces::lost, true);
  if (!extent.lost()) attempt(Pieces::all, false);
  return extent;
}

Extent ReachCheck::startExtent(uint32_t index) {
  known_.clear();
  scaled_.clear();
  placed_.clear();
  values_.observation() = {};
  startOverrides(index);
  RangeFrame frame;
  frame.scope = cell_;
  return callExtent(program_.layers[index].start, frame, Call::start);
}

void ReachCheck::finiteBox(Layer& layer, const Extent& extent) {
  if (!isEnough(layer, extent)) return report(static_cast<uint32_t>(&layer - program_.layers.data()), extent);
  IntBox box;
  for (int axis = 0; axis < 3; ++axis) {
    const Interval side = extent.empty ? Interval{-1, 1} : extent.at.may[static_cast<size_t>(axis)];
    // The box is centred, like a written one.
    const double half = std::max(std::fabs(side.lo), std::fabs(side.hi)) + 1;
    box.hi[axis] = static_cast<int32_t>(std::ceil(half * kUnitsPerMetre));
    box.lo[axis] = -box.hi[axis];
    layer.cell[axis] = 2 * box.hi[axis];
  }
  program_.domain.box = box;
  layer.proven = true;
}

void checkReach(Program& program, const CompileLimits& limits, DiagnosticSink& sink) {
  ReachCheck(program, limits, sink).run();
}

}  // namespace sgm
