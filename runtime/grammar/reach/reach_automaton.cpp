// Bounds the extent of a cellular automaton (`ca`), which fills its layer's cell, and checks its arguments.

#include <algorithm>

#include "grammar/range/automaton_arguments.h"
#include "grammar/reach/reach_statements.h"
#include "grammar/text/codes.h"

namespace sgm::reach {

Extent boundAutomaton(const ExprNode& n, const RangeFrame& frame, ReachContext& context) {
  if (context.cell.whole) {
    context.sink.error(n.span, codes::kWrongUse, "`ca` fills the cells of a layer, and this start has no cells",
                       "put it into a layer: `layer caves cell 32m reach 1m { start ...; }`");
    return Extent::nothing();
  }
  context.values.dependence().place = true;
  if (!(frame.place == PlaceRange{})) {
    context.sink.error(n.span, codes::kWrongUse, "`ca` fills its layer's cell and cannot be placed elsewhere",
                       "take it out of at, rot, scale, mirror, repeat and scatter");
    return Extent::nothing();
  }
  const auto argument = [&](uint32_t i) {
    const uint32_t id = i < n.bound.count ? context.program.idAt(n.bound, i) : kNoId;
    return id == kNoId ? Interval::exactly(primitiveTable()[n.id].params[i].fallback)
                       : context.values.number(id, frame);
  };
  const auto whole = [&](uint32_t i) { return floorOf(argument(i) + Interval{0.5, 0.5}); };
  const AutomatonArguments arguments{argument(0), argument(1), whole(2), argument(3), whole(4)};
  const IntervalVector& cell = context.cell.edges;
  double edge = 0;
  for (const Interval& side : cell) edge = std::max(edge, side.hi);
  if (const auto fault = faultOf(arguments, static_cast<int32_t>(edge * kUnitsPerMetre + 0.5))) {
    const uint32_t id = context.program.idAt(n.bound, fault->argument);
    context.sink.error(id == kNoId ? n.span : context.program.expr(id).span, codes::kValueRange, fault->message,
                       fault->hint);
    return Extent::nothing();
  }
  IntervalVector lower, upper;
  const Interval margin{std::max(arguments.voxel.lo, 0.0), std::min(arguments.voxel.hi, edge)};
  for (size_t i = 0; i < 3; ++i) {
    const bool cut = cell[i].hi > 0;
    lower[i] = cut ? -margin : Interval::everything();
    upper[i] = cut ? cell[i] + margin : Interval::everything();
  }
  Extent e = Extent::leaf(lower, upper);
  e.inner = margin.hi;
  e.inner_low = margin.lo;
  e.node();
  return e;
}

}  // namespace sgm::reach
