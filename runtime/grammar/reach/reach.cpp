#include "grammar/reach/reach.h"

#include <algorithm>
#include <cmath>

#include "base/math.h"
#include "grammar/range/argument_ranges.h"
#include "grammar/reach/layer_proof.h"
#include "grammar/reach/layer_report.h"

namespace sgm {

namespace {

using reach::ReachContext;

/// Returns the extent's box in units, rounded outwards.
IntBox roundOutwards(const Extent& extent) {
  IntBox bound;
  for (int axis = 0; axis < 3; ++axis) {
    const Interval side = extent.empty ? Interval{1, 0} : extent.at.may[static_cast<size_t>(axis)];
    // A NaN end means no bound: for NaN, std::min and std::max return their first argument.
    const double lo = std::min(std::max(-3e9, std::floor(side.lo * kUnitsPerMetre)), 3e9);
    const double hi = std::max(std::min(3e9, std::ceil(side.hi * kUnitsPerMetre)), -3e9);
    bound.lo[axis] = saturate(static_cast<int64_t>(lo));
    bound.hi[axis] = saturate(static_cast<int64_t>(hi));
  }
  return bound;
}

/// Returns the box of a finite domain that declares no box. The returned box is centred on the origin, and contains the
/// extent with a margin of 1 m.
IntBox centredBox(const Extent& extent) {
  IntBox box;
  for (int axis = 0; axis < 3; ++axis) {
    const Interval side = extent.empty ? Interval{-1, 1} : extent.at.may[static_cast<size_t>(axis)];
    const double half = std::max(std::fabs(side.lo), std::fabs(side.hi)) + 1;
    box.hi[axis] = static_cast<int32_t>(std::ceil(half * kUnitsPerMetre));
    box.lo[axis] = -box.hi[axis];
  }
  return box;
}

void checkLayer(uint32_t index, ReachContext& context) {
  Program& program = context.program;
  Layer& layer = program.layers[index];
  DiagnosticSink& sink = context.sink;
  const bool boxed = !program.domain.box.empty();
  reach::setCell(layer, context);
  const uint32_t errors = sink.errorCount();
  // Arguments are compared only during this proof: later attempts use other cells, or parts of ranges.
  Misfits& misfits = context.values.misfits();
  misfits.enable(true);
  const Extent extent = reach::proveStart(index, context);
  misfits.enable(false);
  reportMisfits(program, misfits.take(), sink);
  if (sink.full()) return;
  reach::reportObservation(layer, context);
  // A division by 0, which is reported as an error, also leaves the extent without a bound. The missing bound is then
  // not reported as a second error.
  const bool enough = reach::isEnough(layer, extent, context);
  if (sink.full() || (sink.errorCount() > errors && !enough)) return;
  layer.bound = roundOutwards(extent);
  layer.proven = enough;
  if (!enough) return reach::reportLayer(index, extent, context);
  if (!reach::isFinite(program, layer) || boxed) return;
  program.domain.box = centredBox(extent);
  for (int axis = 0; axis < 3; ++axis) layer.cell[axis] = 2 * program.domain.box.hi[axis];
}

}  // namespace

void checkReach(Program& program, const CompileLimits& limits, DiagnosticSink& sink) {
  ReachContext context(program, limits, sink);
  for (uint32_t l = 0; l < program.layers.size() && !sink.full(); ++l) checkLayer(l, context);
  if (sink.errorCount() == 0 && !context.budget.isCutShort()) context.heads.warnOfIdle(program, sink);
}

}  // namespace sgm
