#include "grammar/reach/layer_proof.h"

#include <algorithm>

#include "base/math.h"
#include "grammar/reach/layer_report.h"
#include "grammar/reach/reach_rules.h"

namespace sgm::reach {

namespace {

constexpr double kFarthest = 1e6;  ///< maximum extent in metres of a finite domain without a declared box

/// Computes the extent of the layer's start rule. If possible, divides the range of one of the grammar's parameters
/// into pieces, and returns the union of the extents for these pieces.
Extent boundOverParameters(uint32_t index, ReachContext& context) {
  RangeEvaluator& values = context.values;
  const Extent whole = boundStart(index, context);
  const std::vector<bool> used = values.usedParameters();
  for (uint32_t p = 0; p < used.size() && !context.budget.isCutShort(); ++p) {
    if (!used[p]) continue;
    RangeValue value = RangeValue::number(values.parameter(p));
    const auto bound = [&] {
      values.parameter(p) = value.v[0];
      return boundStart(index, context);
    };
    const std::optional<Extent> pieces = context.pieces.divide(value, whole, bound, context.budget);
    values.parameter(p) = value.v[0];
    if (pieces) return *pieces;
  }
  return whole;
}

}  // namespace

bool isFinite(const Program& program, const Layer& layer) {
  return !program.domain.infinite && layer.cell_expr == kNoId;
}

double cellEdge(const Layer& layer) { return std::max({layer.cell[0], layer.cell[1], layer.cell[2]}) * kUnit; }

void setCell(const Layer& layer, ReachContext& context) {
  IntervalVector edges;
  for (int axis = 0; axis < 3; ++axis) edges[static_cast<size_t>(axis)] = Interval::exactly(layer.cell[axis] * kUnit);
  const bool finite = isFinite(context.program, layer);
  // In a finite domain without a declared box, the shapes determine the box, so the scope is unbounded.
  if (finite && context.program.domain.box.empty()) edges.fill({0, kInfinity});
  context.cell = {edges, layer.cell_expr == kNoId, finite};
  context.values.setCell(edges, finite);
}

Excess measureExcess(const Program& program, const Layer& layer, const Extent& extent) {
  Excess over;
  const bool finite = isFinite(program, layer);
  for (int axis = 0; axis < 3 && !extent.empty; ++axis) {
    const size_t i = static_cast<size_t>(axis);
    if (!program.domain.axes[i] && program.domain.infinite) continue;
    double low = -layer.reach * kUnit, high = layer.cell[axis] * kUnit + layer.reach * kUnit;
    if (finite) low = program.domain.box.lo[axis] * kUnit, high = program.domain.box.hi[axis] * kUnit;
    over.may = std::max({over.may, low - extent.at.may[i].lo, extent.at.may[i].hi - high});
    over.sure = std::max({over.sure, low - extent.sure_lo[i], extent.sure_hi[i] - high});
  }
  return over;
}

bool isEnough(const Layer& layer, const Extent& extent, const ReachContext& context) {
  if (context.budget.isCutShort()) return false;
  if (isFinite(context.program, layer) && context.program.domain.box.empty())
    return extent.empty || extent.size() <= kFarthest;
  return measureExcess(context.program, layer, extent).may <= 0;
}

Extent boundStart(uint32_t index, ReachContext& context) {
  context.rules.clear();
  context.values.observation() = {};
  context.overrides.start(index);
  RangeFrame frame;
  frame.scope = context.cell.edges;
  return boundCall(context.program.layers[index].start, CallSite::start, frame, context);
}

Extent proveStart(uint32_t index, ReachContext& context) {
  const Layer& layer = context.program.layers[index];
  StepBudget& budget = context.budget;
  const uint32_t before = budget.left();
  Extent extent = boundStart(index, context);
  if (budget.isCutShort() && !context.pieces.dividesFewSizes()) {
    context.pieces.divideFewSizes();
    budget.clearCut();
    budget.refill();
    extent = boundStart(index, context);
  }
  budget.addSpent(before);
  reportZeroDivisions(context);
  if (budget.isCutShort() || isEnough(layer, extent, context)) return extent;
  const Observation observation = context.values.observation();
  const auto attempt = [&](RangePieces::Mode mode, bool parameters) {
    if (budget.isCutShort() || isEnough(layer, extent, context)) return;
    context.pieces.setMode(mode);
    context.values.takePieces(true);
    budget.refill();
    const Extent tighter = parameters ? boundOverParameters(index, context) : boundStart(index, context);
    budget.addSpent(context.limits.bound_steps);
    // An attempt that the step budget cut short proves nothing.
    if (!budget.clearCut() && (tighter.empty || tighter.size() < extent.size())) extent = tighter;
    context.pieces.setMode(RangePieces::Mode::none);
    context.values.takePieces(false);
    context.values.observation() = observation;
    budget.refill();
  };
  if (extent.lost()) attempt(RangePieces::Mode::lost, false);
  if (extent.lost()) attempt(RangePieces::Mode::lost, true);
  if (!extent.lost()) attempt(RangePieces::Mode::all, false);
  return extent;
}

}  // namespace sgm::reach
