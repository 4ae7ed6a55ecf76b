// Runs the cellular automaton of each cell of a layer, and turns its result into one leaf of voxels.

#include <algorithm>
#include <cmath>

#include "base/math.h"
#include "derive/interpret/leaves.h"
#include "derive/layout/automaton.h"
#include "grammar/range/automaton_arguments.h"

namespace sgm::interpret {
namespace {

/// number of voxel updates that count as one step: an update costs far less than an expression
constexpr uint64_t kUpdatesInStep = 16;

/// Half extent in units of a box that is unlimited along an axis without cells: larger than the world.
constexpr float kEndless = 2147483648.0f;

int32_t solidNeighbours(double threshold, int32_t radius, int axes) {
  double all = 1;
  for (int i = 0; i < axes; ++i) all *= 2 * radius + 1;
  // The required number of solid voxels is rounded up. The tolerance prevents a threshold such as 5/9, which is inexact
  // in binary, from increasing the number by 1.
  return static_cast<int32_t>(-detFloor(-(threshold * all - 1e-6)));
}

}  // namespace

void addAutomaton(const ExprNode& node, uint32_t ordinal, CellContext& c, const Env& env, ShapeList& out) {
  const auto argument = [&](uint32_t i) {
    const uint32_t id = c.evaluator.boundAt(node, i);
    return id == kNoId ? primitiveTable()[node.id].params[i].fallback : c.evaluator.real(id, env);
  };
  const auto exactly = [](double v) { return Interval{v, v}; };
  const double voxel = argument(0), fill = argument(1), rounds = detFloor(argument(2) + 0.5), threshold = argument(3),
               radius = detFloor(argument(4) + 0.5);
  const PathKey key = c.evaluator.keyOf(Value::number(argument(5)));
  if (c.budget.failed() || isWhole(c.in.layer)) return;
  const int32_t cell = std::max({c.in.layer.cell.x, c.in.layer.cell.y, c.in.layer.cell.z});
  if (const auto fault =
          faultOf({exactly(voxel), exactly(fill), exactly(rounds), exactly(threshold), exactly(radius)}, cell)) {
    return c.budget.note(fault->message + ": " + fault->hint + "; it is left out", node.span, env.activation);
  }

  Automaton automaton;
  automaton.seed = key.value;
  automaton.fill = fill;
  automaton.rounds = static_cast<int32_t>(rounds);
  automaton.radius = static_cast<int32_t>(radius);
  VoxelBlock block;
  block.edge = toUnits(voxel);
  Shape shape = shapeIn(env, ShapeKind::voxels);
  VoxelBox box{{0, 0, 0}, {1, 1, 1}};
  const IntBox own = cellBox(c.in.layer, c.in.cell);
  uint64_t updates = static_cast<uint64_t>(automaton.rounds) + 1;
  int axes = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<size_t>(axis);
    automaton.axes[a] = c.in.lattice.hasAxis(axis);
    shape.size[a] = kEndless;
    if (!automaton.axes[a]) continue;
    ++axes;
    const int64_t first = floorDiv(own.lo[axis], block.edge) - kVoxelMargin;
    const int64_t last = floorDiv(int64_t{own.hi[axis]} + block.edge, block.edge) + kVoxelMargin;
    box.first[axis] = block.first[axis] = static_cast<int32_t>(first);
    box.count[axis] = block.count[axis] = static_cast<int32_t>(last - first + 1);
    updates *= static_cast<uint64_t>(box.count[axis] + 2 * automaton.halo());
    // The shape's box is the cell plus one voxel on each side. Half of an odd edge is rounded up; kVoxelMargin allows
    // for that.
    shape.frame.origin[axis] = own.lo[axis] + c.in.layer.cell[axis] / 2;
    shape.size[a] = static_cast<float>((c.in.layer.cell[axis] + 1) / 2 + block.edge);
  }
  automaton.least = solidNeighbours(threshold, automaton.radius, axes);
  if (!c.budget.step(updates / kUpdatesInStep, node.span, env.activation)) return;
  shape.inner_radius = static_cast<float>(block.edge);
  shape.block = c.draft.addVoxels(block, runAutomaton(automaton, box));
  out.push_back(c.sink.addShape(shape, ordinal, node.span, env));
}

}  // namespace sgm::interpret
