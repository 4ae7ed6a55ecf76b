#include "grammar/reach/layer_report.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "base/math.h"
#include "grammar/reach/declaration_trials.h"
#include "grammar/reach/layer_proof.h"
#include "grammar/text/codes.h"

namespace sgm::reach {

namespace {

constexpr const char* kCutShort = "the rules are too many or too deep to follow; bound their recursion";
constexpr const char* kGiveBox = "give the domain a box: `domain finite box(20m, 20m, 20m);`";
constexpr const char* kSmaller = "make the shape smaller";
constexpr size_t kMaxParts = 32;  ///< maximum number of a start rule's calls that are examined one by one
/// maximum cost of examining a start rule's calls, as a multiple of one attempt's steps
constexpr uint64_t kMaxAttempts = 8;

/// Returns an example of a small positive value of a dimension, for hints; empty if the dimension has no unit.
std::string_view smallValue(Dim dim) {
  return dim == kRatio    ? "0.1"
         : dim == kLength ? "0.1m"
         : dim == kArea   ? "0.1m2"
         : dim == kVolume ? "0.1m3"
         : dim == kAngle  ? "1deg"
                          : "";
}

/// Returns the source text of an expression.
std::string_view readText(const Program& program, ExprId id) {
  const Span& span = program.expr(id).span;
  return std::string_view(program.modules[span.file].text).substr(span.begin, span.end - span.begin);
}

/// Examines the calls in the layer's own rule one by one. Returns the extents of the calls that by themselves are not
/// proven to stay within what the layer declares. Omits calls after the first kMaxParts, and calls that are left when
/// the steps of kMaxAttempts attempts are spent; a later run of the compiler reports these. Returns an empty list if
/// the rule has only one call.
std::vector<Extent> boundCallsOneByOne(uint32_t index, ReachContext& context) {
  const Layer& layer = context.program.layers[index];
  context.start_calls.beginCollecting();
  boundStart(index, context);
  const std::vector<ExprId> calls = context.start_calls.endCollecting();
  context.budget.clearSpent();
  std::vector<Extent> parts;
  for (size_t i = 0; i < std::min(calls.size(), kMaxParts) && calls.size() > 1; ++i) {
    if (context.budget.hasSpentMoreThan(kMaxAttempts)) break;
    context.start_calls.restrictTo(calls[i]);
    context.budget.refill();
    const Extent part = proveStart(index, context);
    if (!isEnough(layer, part, context)) parts.push_back(part);
    context.start_calls.restrictTo(kNoId);
    context.budget.clearCut();
  }
  return parts;
}

}  // namespace

void LayerReport::report(const Extent& extent) const {
  const bool finite = isFinite(program_, layer_), boxed = !program_.domain.box.empty();
  const bool cut_short = context_.budget.isCutShort(), unbounded = extent.lost() || cut_short;
  auto [shape, span] = describeContributor(extent);
  const Excess over = measureExcess(program_, layer_, extent);
  const std::string name = join({"`", program_.text(layer_.name), "`"});
  const double reach = layer_.reach * kUnit;
  // The message states how far the shapes extend. In a finite domain with a declared box, it measures from the box; in
  // a finite domain without one, from the domain's origin; otherwise from the layer's cell.
  const std::string extends =
      unbounded ? "without bound" : metresText(finite && !boxed ? extent.size() : over.may + (finite ? 0 : reach));
  const std::string from = finite ? (boxed       ? " beyond the domain's box"
                                     : unbounded ? ""
                                                 : " from its origin")
                                  : " from its cell";
  const std::string limit = finite ? "" : join({", layer ", name, " declares reach ", metresText(reach)});
  std::string message = join({shape, " may extend ", extends, from, limit});
  if (!unbounded && over.sure <= 0 && (!finite || boxed)) {
    if (context_.lossy) return;  // a part of the text that failed to parse may bound the shapes
    context_.sink.warning(span, codes::kReachMaybe, std::move(message), "shapes that go farther are left out whole");
    return;
  }
  const BoundLoss* loss = nullptr;
  // Names the expression that has no bound only if the hint is about the same expression. Otherwise the message and its
  // hint would describe different causes.
  if (unbounded && !cut_short && extent.loss != 0 &&
      boundHint(extent) == lossHint(context_.values.losses()[extent.loss]))
    loss = &context_.values.losses()[extent.loss];
  if (loss != nullptr) {
    message += lossText(*loss);
    if (loss->cause == BoundLoss::Cause::divisor && loss->caller == kNoId) span = program_.expr(divisor(*loss)).span;
  }
  std::string remedy = room_.empty() ? kSmaller : room_;
  if (unbounded) remedy = needs_box_ && extent.lost() ? kGiveBox : boundHint(extent);
  Diagnostic& d = context_.sink.error(span, codes::kReach, join({"cannot prove reach: ", message}), std::move(remedy));
  if (unbounded && extent.inside != kNoId)
    d.notes.push_back(join({"the bound is lost at ", context_.sink.place(program_.expr(extent.inside).span)}));
}

LayerReport::Contributor LayerReport::describeContributor(const Extent& extent) const {
  if (extent.override_id != kNoId)
    return {"the shape of this override", program_.overrides[extent.override_id].address_span};
  const ExprNode& node = program_.expr(extent.largest_contributor == kNoId ? layer_.start : extent.largest_contributor);
  return {node.shape ? join({"`", program_.text(node.name), "`"}) : "the shape that this displaces", node.span};
}

ExprId LayerReport::divisor(const BoundLoss& loss) const { return program_.idAt(program_.expr(loss.expr).children, 1); }

std::string LayerReport::lossText(const BoundLoss& loss) const {
  if (loss.cause == BoundLoss::Cause::parameter)
    return join({": the parameter `", readText(program_, loss.expr), "` has no range"});
  return join({": `", readText(program_, divisor(loss)), "`, the divisor, may be 0"});
}

std::string LayerReport::lossHint(const BoundLoss& loss) const {
  if (loss.cause == BoundLoss::Cause::parameter) {
    const Param& param = program_.params[program_.expr(loss.expr).id];
    const ExprNode& value = program_.expr(param.value_expr);
    const std::string_view text = readText(program_, param.value_expr);
    const std::string name(program_.text(param.name));
    if (value.kind != ExprKind::number || !(value.value > 0))
      return join({"give it one: `param ", name, " = ", text, " in LOW..HIGH`"});
    // The suggested range ends at twice the default, in the default's unit.
    const std::string_view unit = text.substr(std::min(text.find_first_not_of("0123456789.eE"), text.size()));
    double number = 0;
    std::from_chars(text.data(), text.data() + text.size(), number);
    return join({"give it one: `param ", name, " = ", text, " in 0", unit, "..", numberText(2 * number), unit, "`"});
  }
  const std::string_view least = smallValue(program_.expr(divisor(loss)).type.dim);
  if (least.empty()) return "keep it away from 0: a parameter's range, or max()";
  return join({"keep it away from 0: `max(", readText(program_, divisor(loss)), ", ", least, ")`"});
}

std::string LayerReport::boundHint(const Extent& extent) const {
  if (context_.budget.isCutShort()) return kCutShort;
  if (extent.why == Unbound::sum && extent.inside != kNoId)
    return "give it a size that cannot come near to 0, such as `max(r, 1m)` for r";
  if (extent.why == Unbound::sum && extent.allowed <= 0)
    return "a sum can be displaced only where its largest shape is sure to have some size: displace the shapes in it";
  if (extent.why == Unbound::sum && std::isfinite(extent.allowed))
    return join({"displace by less than ", numberText(std::floor(extent.allowed * 100) / 100),
                 " m: a sum's field is no larger far away"});
  if (extent.why == Unbound::radius)
    return "give the smallest radius of the displaced shape a lower bound, such as max(r, 1m)";
  if (extent.loss != 0) return lossHint(context_.values.losses()[extent.loss]);
  const ExprNode* contributor =
      extent.largest_contributor == kNoId ? nullptr : &program_.expr(extent.largest_contributor);
  if (contributor != nullptr && contributor->ref == Ref::primitive &&
      static_cast<Primitive>(contributor->id) == Primitive::halfspace)
    return "meet it with a box, or cut a shape with it";
  return "bound what it depends on: a parameter's range, clamp(), or `amp` of displace and warp";
}

void reportLayer(uint32_t index, const Extent& extent, ReachContext& context) {
  const StepBudget& budget = context.budget;
  std::vector<Extent> parts;
  if (!budget.isCutShort()) parts = boundCallsOneByOne(index, context);
  if (parts.empty()) parts.push_back(extent);
  // Suggest a single declaration that is large enough for all calls whose extents have a bound.
  Extent bounded = Extent::nothing();
  for (const Extent& part : parts)
    if (!part.lost()) bounded.join(part);
  std::string room;
  if (!bounded.empty && !budget.isCutShort()) room = findRoom(index, bounded, context);
  const bool needs_box = !budget.isCutShort() && extent.lost() && needsBox(index, context);
  const LayerReport report(context.program.layers[index], std::move(room), needs_box, context);
  for (const Extent& part : parts) report.report(part);
}

void reportObservation(const Layer& layer, ReachContext& context) {
  const Observation& farthest = context.values.observation();
  const double reach = layer.reach * kUnit;
  if (farthest.query == kNoId || farthest.distance_m <= reach) return;
  const bool bounded = std::isfinite(farthest.distance_m);
  context.sink.error(
      context.program.expr(farthest.query).span, codes::kReach,
      join({"cannot prove reach: this query may look ", bounded ? metresText(farthest.distance_m) : "without bound",
            " from its cell, layer `", context.program.text(layer.name), "` declares reach ", metresText(reach)}),
      bounded ? join({"raise reach to ", metresText(std::ceil(farthest.distance_m)), " or ask nearer to the cell"})
              : "bound its radius and where it stands: a parameter's range, or clamp()");
}

void reportZeroDivisions(ReachContext& context) {
  const Program& program = context.program;
  DiagnosticSink& sink = context.sink;
  for (const BoundLoss& zero : context.values.losses().zeroDivisions()) {
    const ExprNode& quotient = program.expr(zero.expr);
    if (zero.caller == kNoId) {
      const ExprId divisor = program.idAt(quotient.children, 1);
      sink.error(program.expr(divisor).span, codes::kDivideByZero,
                 join({"division by zero: `", readText(program, divisor), "` is 0 here"}),
                 "divide by a number other than 0");
      continue;
    }
    const ExprNode& call = program.expr(zero.caller);
    sink.error(call.span, codes::kDivideByZero,
               join({"division by zero: `", program.text(call.name),
                     "` divides by a value that is 0 with these arguments"}),
               "give it arguments other than 0")
        .notes.push_back(join({"the division is at ", sink.place(quotient.span)}));
  }
}

}  // namespace sgm::reach
