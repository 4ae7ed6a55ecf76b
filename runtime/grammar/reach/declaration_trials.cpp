#include "grammar/reach/declaration_trials.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "grammar/reach/layer_proof.h"

namespace sgm::reach {

namespace {

constexpr int kMaxTrials = 6;
/// Maximum edge of a tried cell or box, metres, so that a reach of several cells stays within the world.
constexpr double kLargestEdge = 2.5e5;

double wholeMetres(double metres) { return std::ceil(metres - 1e-9); }

std::string lengthText(double metres) { return join({numberText(metres), "m"}); }

/// Returns the edges, in metres, that should be tried next for the domain's box or the layer's cell. needed: the reach
/// that the shapes need.
std::array<double, 3> nextEdges(const Layer& layer, const Extent& tried, double needed, const ReachContext& context) {
  const IntBox& box = context.program.domain.box;
  const bool finite = isFinite(context.program, layer);
  std::array<double, 3> edges{};
  for (size_t axis = 0; axis < 3; ++axis) {
    const int a = static_cast<int>(axis);
    edges[axis] = finite ? std::max(2 * wholeMetres(tried.at.may[axis].magnitude()), (box.hi[a] - box.lo[a]) * kUnit)
                         : wholeMetres(std::max(needed / context.limits.neighbours, cellEdge(layer)));
  }
  return edges;
}

/// Sets the domain's box, or the layer's cell with the largest reach that the cell permits.
void declare(Layer& layer, const std::array<double, 3>& edges, int32_t written_reach, ReachContext& context) {
  IntBox& box = context.program.domain.box;
  const bool finite = isFinite(context.program, layer);
  for (size_t axis = 0; axis < 3; ++axis) {
    const int a = static_cast<int>(axis);
    const auto units = static_cast<int32_t>(std::ceil(edges[axis] * kUnitsPerMetre));
    if (finite) box.lo[a] = -units / 2, box.hi[a] = box.lo[a] + units;
    if (layer.cell[a] > 0) layer.cell[a] = units;
  }
  setCell(layer, context);
  layer.reach =
      finite ? written_reach : static_cast<int32_t>(cellEdge(layer) * context.limits.neighbours * kUnitsPerMetre);
}

}  // namespace

TrialDeclaration::TrialDeclaration(uint32_t index, ReachContext& context)
    : context_(context),
      layer_(context.program.layers[index]),
      cell_(layer_.cell),
      reach_(layer_.reach),
      box_(context.program.domain.box) {}

TrialDeclaration::~TrialDeclaration() {
  layer_.cell = cell_;
  layer_.reach = reach_;
  context_.program.domain.box = box_;
  setCell(layer_, context_);
}

bool needsBox(uint32_t index, ReachContext& context) {
  Layer& layer = context.program.layers[index];
  IntBox& box = context.program.domain.box;
  if (!isFinite(context.program, layer) || !box.empty()) return false;
  const TrialDeclaration trial(index, context);
  constexpr int32_t kHalf = 10 * kUnitsPerMetre;
  box = {{-kHalf, -kHalf, -kHalf}, {kHalf, kHalf, kHalf}};
  layer.cell = {2 * kHalf, 2 * kHalf, 2 * kHalf};
  setCell(layer, context);
  const bool bounded = !boundStart(index, context).lost();
  return !context.budget.clearCut() && bounded;
}

std::string findRoom(uint32_t index, const Extent& extent, ReachContext& context) {
  Layer& layer = context.program.layers[index];
  const bool finite = isFinite(context.program, layer);
  const int32_t written_reach = layer.reach;
  if (finite && context.program.domain.box.empty()) return {};
  double needed = wholeMetres(measureExcess(context.program, layer, extent).may + written_reach * kUnit);
  if (!finite && needed <= cellEdge(layer) * context.limits.neighbours)
    return join({"raise reach to ", metresText(needed), " or make the shape smaller"});

  // Several trials may be needed, since a new cell or box may change the extent of the shapes.
  const TrialDeclaration trials(index, context);
  Extent tried = extent;
  for (int trial = 0; trial < kMaxTrials && !tried.lost(); ++trial) {
    const std::array<double, 3> edges = nextEdges(layer, tried, needed, context);
    if (!std::all_of(edges.begin(), edges.end(), [](double edge) { return edge <= kLargestEdge; })) break;
    declare(layer, edges, written_reach, context);
    context.budget.refill();
    tried = proveStart(index, context);
    if (isEnough(layer, tried, context)) {
      layer.reach = 0;
      needed = finite ? 0 : wholeMetres(std::max(measureExcess(context.program, layer, tried).may, 0.0));
      return finite ? join({"write `box(", lengthText(edges[0]), ", ", lengthText(edges[1]), ", ", lengthText(edges[2]),
                            ")`, or make the shape smaller"})
                    : join({"raise cell to ", metresText(cellEdge(layer)), " and reach to ", metresText(needed),
                            ", or make the shape smaller"});
    }
    if (!finite && !tried.lost())
      needed = wholeMetres(measureExcess(context.program, layer, tried).may + layer.reach * kUnit);
  }
  return {};
}

}  // namespace sgm::reach
