// Messages if the reach of a layer is not proven: the cause, at a line that its author can change, and the remedy.

#include <algorithm>
#include <charconv>
#include <cmath>

#include "base/math.h"
#include "grammar/reach/reach_check.h"
#include "grammar/text/codes.h"

namespace sgm {

namespace {

constexpr const char* kCutShort = "the rules are too many or too deep to follow; bound their recursion";
constexpr const char* kGiveBox = "give the domain a box: `domain finite box(20m, 20m, 20m);`";
constexpr const char* kSmaller = "make the shape smaller";
constexpr size_t kMostParts = 32;  ///< calls of a start rule that are examined one by one
constexpr int kMostTrials = 6;
constexpr uint64_t kMostAttempts = 8;  ///< limit for all calls of a start rule together, in steps of one proof

double wholeMetres(double metres) { return std::ceil(metres - 1e-9); }

std::string lengthText(double metres) { return join({numberText(metres), "m"}); }

/// An example of a small positive value of a dimension; empty if it has no unit.
std::string_view smallValue(Dim dim) {
  return dim == kRatio    ? "0.1"
         : dim == kLength ? "0.1m"
         : dim == kArea   ? "0.1m2"
         : dim == kVolume ? "0.1m3"
         : dim == kAngle  ? "1deg"
                          : "";
}

}  // namespace

std::string_view ReachCheck::written(ExprId id) const {
  const Span& span = program_.expr(id).span;
  return std::string_view(program_.modules[span.file].text).substr(span.begin, span.end - span.begin);
}

/// Content on which a cell depends must lie within its reach.
void ReachCheck::reportObservation(const Layer& layer, const Observation& farthest) {
  const double reach = layer.reach * kUnit;
  if (farthest.query == kNoId || farthest.distance_m <= reach) return;
  const bool bounded = std::isfinite(farthest.distance_m);
  sink_.error(
      program_.expr(farthest.query).span, codes::kReach,
      join({"cannot prove reach: this query may look ", bounded ? metresText(farthest.distance_m) : "without bound",
            " from its cell, layer `", program_.text(layer.name), "` declares reach ", metresText(reach)}),
      bounded ? join({"raise reach to ", metresText(std::ceil(farthest.distance_m)), " or ask nearer to the cell"})
              : "bound its radius and where it stands: a parameter's range, or clamp()");
}

/// Divisions that never have a value. Each is an error of its own, at its line.
void ReachCheck::reportZeroDivisions() {
  for (const BoundLoss& zero : values_.losses().zeroDivisions()) {
    const ExprNode& quotient = program_.expr(zero.expr);
    if (zero.caller == kNoId) {
      const ExprId divisor = program_.idAt(quotient.children, 1);
      sink_.error(program_.expr(divisor).span, codes::kDivideByZero,
                  join({"division by zero: `", written(divisor), "` is 0 here"}), "divide by a number other than 0");
      continue;
    }
    const ExprNode& call = program_.expr(zero.caller);
    sink_
        .error(call.span, codes::kDivideByZero,
               join({"division by zero: `", program_.text(call.name),
                     "` divides by a value that is 0 with these arguments"}),
               "give it arguments other than 0")
        .notes.push_back(join({"the division is at ", sink_.place(quotient.span)}));
  }
}

ReachCheck::Contributor ReachCheck::describeContributor(const Layer& layer, const Extent& extent) const {
  if (extent.override_id != kNoId)
    return {"the shape of this override", program_.overrides[extent.override_id].address_span};
  const ExprNode& node = program_.expr(extent.largest_contributor == kNoId ? layer.start : extent.largest_contributor);
  return {node.shape ? join({"`", program_.text(node.name), "`"}) : "the shape that this displaces", node.span};
}

std::string ReachCheck::lossText(const BoundLoss& loss) const {
  if (loss.cause == BoundLoss::Cause::parameter)
    return join({": the parameter `", written(loss.expr), "` has no range"});
  return join({": `", written(program_.idAt(program_.expr(loss.expr).children, 1)), "`, the divisor, may be 0"});
}

std::string ReachCheck::lossHint(const BoundLoss& loss) const {
  if (loss.cause == BoundLoss::Cause::parameter) {
    const Param& param = program_.params[program_.expr(loss.expr).id];
    const ExprNode& value = program_.expr(param.value_expr);
    const std::string_view text = written(param.value_expr);
    const std::string name(program_.text(param.name));
    if (value.kind != ExprKind::number || !(value.value > 0))
      return join({"give it one: `param ", name, " = ", text, " in LOW..HIGH`"});
    // Suggest twice the default, in the unit in which that is written.
    const std::string_view unit = text.substr(std::min(text.find_first_not_of("0123456789.eE"), text.size()));
    double number = 0;
    std::from_chars(text.data(), text.data() + text.size(), number);
    return join({"give it one: `param ", name, " = ", text, " in 0", unit, "..", numberText(2 * number), unit, "`"});
  }
  const ExprId divisor = program_.idAt(program_.expr(loss.expr).children, 1);
  const std::string_view least = smallValue(program_.expr(divisor).type.dim);
  if (least.empty()) return "keep it away from 0: a parameter's range, or max()";
  return join({"keep it away from 0: `max(", written(divisor), ", ", least, ")`"});
}

/// Without a box a finite grammar's scope is unbounded; with one, its content may be bounded.
bool ReachCheck::needsBox(uint32_t index) {
  Layer& layer = program_.layers[index];
  if (!isFinite(layer) || !program_.domain.box.empty()) return false;
  const Int3 cell = layer.cell;
  constexpr int32_t kHalf = 10 * kUnitsPerMetre;
  program_.domain.box = {{-kHalf, -kHalf, -kHalf}, {kHalf, kHalf, kHalf}};
  layer.cell = {2 * kHalf, 2 * kHalf, 2 * kHalf};
  setCell(layer);
  const bool bounded = !startExtent(index).lost() && !cut_short_;
  cut_short_ = false;
  program_.domain.box = {};
  layer.cell = cell;
  setCell(layer);
  return bounded;
}

std::string ReachCheck::hint(const Extent& extent) const {
  if (cut_short_) return kCutShort;
  if (extent.why == Unbound::sum && extent.inside != kNoId)
    return "give it a size that cannot come near to 0, such as `max(r, 1m)` for r";
  if (extent.why == Unbound::sum && extent.allowed <= 0)
    return "a sum can be displaced only where its largest shape is sure to have some size: displace the shapes in it";
  if (extent.why == Unbound::sum && std::isfinite(extent.allowed))
    return join({"displace by less than ", numberText(std::floor(extent.allowed * 100) / 100),
                 " m: a sum's field is no larger far away"});
  if (extent.why == Unbound::radius)
    return "give the smallest radius of the displaced shape a lower bound, such as max(r, 1m)";
  if (extent.loss != 0) return lossHint(values_.losses()[extent.loss]);
  const ExprNode* blamed = extent.largest_contributor == kNoId ? nullptr : &program_.expr(extent.largest_contributor);
  if (blamed != nullptr && blamed->ref == Ref::primitive && static_cast<Primitive>(blamed->id) == Primitive::halfspace)
    return "meet it with a box, or cut a shape with it";
  return "bound what it depends on: a parameter's range, clamp(), or `amp` of displace and warp";
}

std::string ReachCheck::roomHint(uint32_t index, const Extent& extent) {
  Layer& layer = program_.layers[index];
  IntBox& box = program_.domain.box;
  const bool finite = isFinite(layer);
  const Int3 cell = layer.cell;
  const int32_t reach = layer.reach;
  const IntBox written_box = box;
  if (finite && box.empty()) return kSmaller;
  double needed = wholeMetres(excessOf(layer, extent).may + reach * kUnit);
  if (!finite && needed <= cellOf(layer) * limits_.neighbours)
    return join({"raise reach to ", metresText(needed), " or make the shape smaller"});

  // The extent of a shape may depend on the cell or the box itself.
  std::string found;
  Extent tried = extent;
  constexpr double kLargest = 2.5e5;  // metres; a reach of several such cells is within the grid
  for (int trial = 0; trial < kMostTrials && found.empty() && !tried.lost(); ++trial) {
    std::array<double, 3> edges{};
    for (size_t axis = 0; axis < 3; ++axis) {
      const int a = static_cast<int>(axis);
      edges[axis] = finite ? std::max(2 * wholeMetres(tried.at.may[axis].magnitude()), (box.hi[a] - box.lo[a]) * kUnit)
                           : wholeMetres(std::max(needed / limits_.neighbours, cellOf(layer)));
      if (!(edges[axis] <= kLargest)) break;
      const auto units = static_cast<int32_t>(std::ceil(edges[axis] * kUnitsPerMetre));
      if (finite) box.lo[a] = -units / 2, box.hi[a] = box.lo[a] + units;
      if (layer.cell[a] > 0) layer.cell[a] = units;
    }
    if (!(*std::max_element(edges.begin(), edges.end()) <= kLargest)) break;
    setCell(layer);
    steps_ = limits_.bound_steps;
    layer.reach = finite ? reach : static_cast<int32_t>(cellOf(layer) * limits_.neighbours * kUnitsPerMetre);
    tried = provenExtent(index);
    if (isEnough(layer, tried)) {
      layer.reach = 0;
      needed = finite ? 0 : wholeMetres(std::max(excessOf(layer, tried).may, 0.0));
      found = finite ? join({"write `box(", lengthText(edges[0]), ", ", lengthText(edges[1]), ", ",
                             lengthText(edges[2]), ")`, or make the shape smaller"})
                     : join({"raise cell to ", metresText(cellOf(layer)), " and reach to ", metresText(needed),
                             ", or make the shape smaller"});
    } else if (!finite && !tried.lost()) {
      needed = wholeMetres(excessOf(layer, tried).may + layer.reach * kUnit);
    }
  }
  layer.cell = cell;
  layer.reach = reach;
  box = written_box;
  setCell(layer);
  return found.empty() ? kSmaller : found;
}

double ReachCheck::cellOf(const Layer& layer) {
  return std::max({layer.cell[0], layer.cell[1], layer.cell[2]}) * kUnit;
}

/// Reports all causes at once: every call in the layer's own rule that exceeds the declaration by itself.
void ReachCheck::report(uint32_t index, const Extent& extent) {
  const Layer& layer = program_.layers[index];
  std::vector<Extent> parts;
  if (!cut_short_) {
    top_calls_.clear();
    collects_ = true;
    startExtent(index);
    collects_ = false;
    const std::vector<ExprId> calls = top_calls_;
    spent_ = 0;
    for (size_t i = 0; i < std::min(calls.size(), kMostParts) && calls.size() > 1; ++i) {
      if (spent_ > kMostAttempts * limits_.bound_steps) break;  // the others are reported once these are fixed
      only_ = calls[i];
      steps_ = limits_.bound_steps;
      const Extent part = provenExtent(index);
      if (!isEnough(layer, part)) parts.push_back(part);
      only_ = kNoId;
      cut_short_ = false;
    }
  }
  if (parts.empty()) parts.push_back(extent);
  // One declaration with room for all of them.
  Extent bounded = Extent::nothing();
  for (const Extent& part : parts)
    if (!part.lost()) bounded.join(part);
  const std::string room = bounded.empty || cut_short_ ? std::string() : roomHint(index, bounded);
  const bool boxless = !cut_short_ && extent.lost() && needsBox(index);
  for (const Extent& part : parts) reportOne(layer, part, boxless && part.lost() ? kGiveBox : room);
}

void ReachCheck::reportOne(const Layer& layer, const Extent& extent, const std::string& room) {
  const bool finite = isFinite(layer), boxed = !program_.domain.box.empty();
  const bool unbounded = extent.lost() || cut_short_;
  auto [shape, span] = describeContributor(layer, extent);
  const Excess over = excessOf(layer, extent);
  const std::string name = join({"`", program_.text(layer.name), "`"});
  const double reach = layer.reach * kUnit;
  // A finite grammar's declared box is its reach; a layer's reach is measured from its cell.
  const std::string extends =
      unbounded ? "without bound" : metresText(finite && !boxed ? extent.size() : over.may + (finite ? 0 : reach));
  const std::string from = finite ? (boxed       ? " beyond the domain's box"
                                     : unbounded ? ""
                                                 : " from its origin")
                                  : " from its cell";
  const std::string limit = finite ? "" : join({", layer ", name, " declares reach ", metresText(reach)});
  std::string message = join({shape, " may extend ", extends, from, limit});
  if (!unbounded && over.sure <= 0 && (!finite || boxed)) {
    if (lossy_) return;  // a missing part of the text may keep it within
    sink_.warning(span, codes::kReachMaybe, std::move(message), "shapes that go farther are left out whole");
    return;
  }
  const BoundLoss* loss = nullptr;
  // Message and hint must describe the same cause.
  if (unbounded && !cut_short_ && extent.loss != 0 && hint(extent) == lossHint(values_.losses()[extent.loss]))
    loss = &values_.losses()[extent.loss];
  if (loss != nullptr) {
    message += lossText(*loss);
    if (loss->cause == BoundLoss::Cause::divisor && loss->caller == kNoId)
      span = program_.expr(program_.idAt(program_.expr(loss->expr).children, 1)).span;
  }
  const bool boxless = unbounded && room == kGiveBox;
  Diagnostic& d = sink_.error(span, codes::kReach, join({"cannot prove reach: ", message}),
                              unbounded && !boxless ? hint(extent)
                              : room.empty()        ? std::string(kSmaller)
                                                    : room);
  if (unbounded && extent.inside != kNoId)
    d.notes.push_back(join({"the bound is lost at ", sink_.place(program_.expr(extent.inside).span)}));
}

}  // namespace sgm
