#include "field/prune.h"

#include <algorithm>
#include <bit>

#include "base/kernel.h"

namespace sgm {

namespace {

using Scalar = double;
using Bound = FloatInterval;
using Places = PositionBox;
using GroupBounds = PruneScratch::GroupBounds;
constexpr double kNever = 1e300, kLess = 1 - 1e-6, kMore = 1 + 1e-6;

constexpr double minOf(double a, double b) { return std::min(a, b); }
constexpr double maxOf(double a, double b) { return std::max(a, b); }
float floatOf(uint32_t word) { return std::bit_cast<float>(word); }

PositionBox movePlaces(const PositionBox& from, FloatInterval x, FloatInterval y, FloatInterval z) {
  auto moved = [](FloatInterval v, FloatInterval w) {
    // Bounds of a moved position along one axis. If a warp could move it beyond the end of the world, its bounds are
    // those of the whole world.
    auto held = [](double by) { return std::clamp(by, -1048576.0, 1048576.0) * 1024; };
    const FloatInterval m{v.lo + held(w.lo) - 1, v.hi + held(w.hi) + 1};
    if (m.lo < -2147483648.0 || m.hi > 2147483647.0) return FloatInterval{-2147483648.0, 2147483647.0};
    return m;
  };
  return {moved(from.x, x), moved(from.y, y), moved(from.z, z)};
}

#include "field/prune_kernel.inl"

}  // namespace

void prune(const ProgramView& program, const IntBox& box, PruneScratch& scratch, PrunedProgram& out, Uniform uniform) {
  out.instrs.clear();
  out.groups.clear();
  out.params = program.params;
  out.q_scale = program.q_scale;
  scratch.marks.resize(program.instrs.size());
  scratch.bounds.resize(program.groups.size());
  const FieldBounds bounds = boundField(program, box, positionBox(box), scratch.marks.data(), scratch.bounds.data());
  out.initial = bounds.hidden ? kFar : program.initial;
  out.initial_label = bounds.hidden ? 0 : program.initial_label;
  out.field = bounds.field;
  if (uniform == Uniform::drop && (out.solid() || out.empty())) return;
  for (size_t i = 0; i < program.groups.size(); ++i) {
    if (!scratch.bounds[i].live) continue;
    scratch.reversed.clear();
    keepGroup(program, program.groups[i], scratch.marks.data(),
              [&](const Instr& in) { scratch.reversed.push_back(in); });
    ProgramGroup kept = program.groups[i];
    kept.first = static_cast<uint32_t>(out.instrs.size());
    kept.count = static_cast<uint32_t>(scratch.reversed.size());
    kept.guarded = !scratch.bounds[i].whole;
    out.instrs.insert(out.instrs.end(), scratch.reversed.rbegin(), scratch.reversed.rend());
    out.groups.push_back(kept);
  }
}

}  // namespace sgm
