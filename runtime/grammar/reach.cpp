#include <algorithm>
#include <cmath>

#include "base/math.h"
#include "grammar/codes.h"
#include "grammar/reach_check.h"

namespace sgm {

namespace {

constexpr double kUnit = 1.0 / kUnitsPerMetre;
constexpr const char* kCutShort = "the rules are too many or too deep to follow; bound their recursion";

}  // namespace

ReachCheck::ReachCheck(Program& program, const CompileLimits& limits, DiagnosticSink& sink)
    : program_(program),
      sink_(sink),
      most_steps_(limits.bound_steps),
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

void ReachCheck::layerReach(uint32_t index) {
  Layer& layer = program_.layers[index];
  const bool finite = !program_.domain.infinite && layer.cell_expr == kNoId;
  const bool boxed = !program_.domain.box.empty();
  IntervalVector edges;
  for (int axis = 0; axis < 3; ++axis) edges[static_cast<size_t>(axis)] = Interval::exactly(layer.cell[axis] * kUnit);
  if (finite && !boxed) edges.fill({0, kInfinity});  // the shapes' bounds make the box, not the other way round
  centred_ = finite;
  whole_ = layer.cell_expr == kNoId;
  values_.setCell(edges, finite);
  cell_ = edges;
  Extent extent = startExtent(index);
  if (cut_short_ && !few_pieces_) {
    few_pieces_ = true;
    cut_short_ = false;
    steps_ = most_steps_;
    extent = startExtent(index);
  }
  if (sink_.full()) return;
  seen(layer, values_.sight());
  if (sink_.full()) return;

  double over_may = 0, over_sure = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const size_t i = static_cast<size_t>(axis);
    if (!program_.domain.axes[i] && program_.domain.infinite) continue;
    double low = -layer.reach * kUnit, high = layer.cell[axis] * kUnit + layer.reach * kUnit;
    if (finite) low = program_.domain.box.lo[axis] * kUnit, high = program_.domain.box.hi[axis] * kUnit;
    if (extent.empty) continue;
    over_may = std::max({over_may, low - extent.at.may[i].lo, extent.at.may[i].hi - high});
    over_sure = std::max({over_sure, low - extent.sure_lo[i], extent.sure_hi[i] - high});
  }
  for (int axis = 0; axis < 3; ++axis) {
    const Interval side = extent.empty ? Interval{1, 0} : extent.at.may[static_cast<size_t>(axis)];
    // An end that is not a number is no bound: the first operands of these are taken then.
    const double lo = std::min(std::max(-3e9, std::floor(side.lo * kUnitsPerMetre)), 3e9);
    const double hi = std::max(std::min(3e9, std::ceil(side.hi * kUnitsPerMetre)), -3e9);
    layer.bound.lo[axis] = saturate(static_cast<int64_t>(lo));
    layer.bound.hi[axis] = saturate(static_cast<int64_t>(hi));
  }
  if (finite && !boxed) return finiteBox(layer, extent);
  layer.proven = over_may <= 0 && !cut_short_;
  if (!layer.proven) report(layer, extent, finite, over_may, over_sure);
}

Extent ReachCheck::startExtent(uint32_t index) {
  known_.clear();
  scaled_.clear();
  placed_.clear();
  values_.sight() = {};
  startOverrides(index);
  RangeFrame frame;
  frame.scope = cell_;
  return callExtent(program_.layers[index].start, frame, Call::start);
}

/// What a cell depends on lies within its reach.
void ReachCheck::seen(const Layer& layer, const RangeEvaluator::Sight& sight) {
  const double reach = layer.reach * kUnit;
  if (sight.query == kNoId || sight.far <= reach) return;
  const bool bounded = std::isfinite(sight.far);
  sink_.error(program_.expr(sight.query).span, codes::kReach,
              join({"cannot prove reach: this query may look ", bounded ? metresText(sight.far) : "without bound",
                    " from its cell, layer `", program_.text(layer.name), "` declares reach ", metresText(reach)}),
              bounded ? join({"raise reach to ", metresText(std::ceil(sight.far)), " or ask nearer to the cell"})
                      : "bound its radius and where it stands: a parameter's range, or clamp()");
}

ReachCheck::Culprit ReachCheck::culpritOf(const Layer& layer, const Extent& extent) const {
  if (extent.edit != kNoId) return {"what this override derives", program_.overrides[extent.edit].address_span};
  const ExprNode& node = program_.expr(extent.culprit == kNoId ? layer.start : extent.culprit);
  return {node.shape ? join({"`", program_.text(node.name), "`"}) : "what this displaces", node.span};
}

/// over: by how much the shapes pass their reach.
std::string ReachCheck::hint(const Extent& extent, bool finite, double reach, double over) const {
  if (extent.why == Unbound::sum && extent.allowed <= 0)
    return "a sum can be displaced only where its largest shape is sure to have some size: displace the shapes in it";
  if (extent.why == Unbound::sum && std::isfinite(extent.allowed))
    return join({"displace by less than ", numberText(std::floor(extent.allowed * 100) / 100),
                 " m: a sum's field is no larger far away"});
  if (extent.why == Unbound::radius)
    return "give the smallest radius of what it displaces a bound from below, such as max(r, 1m)";
  const ExprNode* blamed = extent.culprit == kNoId ? nullptr : &program_.expr(extent.culprit);
  if (!std::isfinite(over) && blamed != nullptr && blamed->ref == Ref::primitive &&
      static_cast<Primitive>(blamed->id) == Primitive::halfspace)
    return "meet it with a box, or cut a shape with it";
  if (!std::isfinite(over))
    return "bound what it depends on: a parameter's range, clamp(), or `amp` of displace and warp";
  if (finite) return "make the box larger or the shape smaller";
  return join({"raise reach to ", metresText(std::ceil(over + reach)), " or make the shape smaller"});
}

void ReachCheck::report(const Layer& layer, const Extent& extent, bool finite, double over_may, double over_sure) {
  const auto [shape, span] = culpritOf(layer, extent);
  const std::string name = join({"`", program_.text(layer.name), "`"});
  const double reach = layer.reach * kUnit;
  const bool unbounded = !std::isfinite(over_may) || cut_short_;
  // A finite grammar's declared box is its reach; a layer's is measured from its cell.
  const std::string extends = unbounded ? "without bound" : metresText(over_may + (finite ? 0 : reach));
  const std::string from = finite ? " beyond the domain's box" : " from its cell";
  const std::string limit = finite ? "" : join({", layer ", name, " declares reach ", metresText(reach)});
  if (unbounded || over_sure > 0) {
    sink_.error(span, codes::kReach, join({"cannot prove reach: ", shape, " may extend ", extends, from, limit}),
                cut_short_ ? kCutShort : hint(extent, finite, reach, unbounded ? kInfinity : over_may));
    return;
  }
  sink_.warning(span, codes::kReachMaybe, join({shape, " may extend ", extends, from, limit}),
                "shapes that go farther are left out whole");
}

void ReachCheck::finiteBox(Layer& layer, const Extent& extent) {
  IntBox box;
  double largest = 0;
  for (const Interval& side : extent.at.may) largest = std::max(largest, side.magnitude());
  if (!extent.empty && (!std::isfinite(largest) || largest > 1e6 || cut_short_)) {
    const auto [shape, span] = culpritOf(layer, extent);
    sink_.error(span, codes::kReach, join({"cannot prove reach: ", shape, " may extend without bound"}),
                cut_short_                    ? kCutShort
                : extent.why != Unbound::none ? hint(extent, true, 0, kInfinity)
                                              : "give the domain a box: `domain finite box(x, y, z);`");
    return;
  }
  for (int axis = 0; axis < 3; ++axis) {
    const Interval side = extent.empty ? Interval{-1, 1} : extent.at.may[static_cast<size_t>(axis)];
    // The box is centred, as a written one is.
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
