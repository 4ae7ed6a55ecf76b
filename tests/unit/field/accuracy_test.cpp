// Tests that float values are as close to the double-precision reference as ops.def states.

#include <algorithm>
#include <array>
#include <cmath>
#include <iostream>
#include <iterator>

#include "catch.h"
#include "field/builder.h"
#include "field/interval.h"
#include "field/reference.h"
#include "random_programs.h"
#include "rounds.h"

using namespace sgm;

namespace {

// The reference value of a register after the first `count` instructions of a group.
double referenceOf(const ProgramView& program, const ProgramGroup& g, uint32_t count, uint8_t result, Int3 p) {
  ProgramGroup part = g;
  part.count = count;
  part.result = result;
  part.guarded = false;
  ProgramView view = program;
  view.groups = std::span(&part, 1);
  view.initial = 3e38f;
  return referenceField(view, p);
}

// Bounds of the float value at one point, for a program with one group. They are computed from the reference values of
// the leaves, and from the error that ops.def states for each operation above the leaves.
FloatInterval boundsAt(const ProgramView& program, Int3 p) {
  const ProgramGroup& g = program.groups[0];
  const PositionBox here = positionBox({p, p});
  std::array<FloatInterval, kMaxRegisters> r{};
  for (uint32_t i = 0; i < g.count; ++i) {
    const Instr& in = program.instrs[g.first + i];
    const uint32_t* params = program.params.data() + in.params;
    const FloatInterval a = r[in.a], b = r[in.b], c = r[in.c];
    FloatInterval& out = r[in.dst];
    auto accumulate = [&](FloatInterval share) {
      r[in.b] = {(b.lo + share.lo) * (1 - 1e-6), (b.hi + share.hi) * (1 + 1e-6)};
    };
    switch (in.op) {
      case Op::noise:
      case Op::sweep: {
        const double v = referenceOf(program, g, i + 1, in.dst, p);
        out = {v - statedError(in.op), v + statedError(in.op)};
        break;
      }
      case Op::coordinate:
      case Op::lattice:
      case Op::sphere:
      case Op::box:
      case Op::cylinder:
      case Op::truncone:
      case Op::capsule:
      case Op::torus:
      case Op::ellipsoid:
      case Op::superquadric:
      case Op::power_morph:
      case Op::halfspace:
      case Op::prism:
      case Op::blob:
        out = boundPosition(in.op, params, here, a);
        // At a warped position, rounding may choose the next unit on each axis, so the bounds are wider.
        if (in.place != 0) {
          const double v = referenceOf(program, g, i + 1, in.dst, p);
          out = {v - 2 - 1e-5 * std::abs(v), v + 2 + 1e-5 * std::abs(v)};
        }
        break;
      case Op::round_begin:
        out = {double{kFar}, double{kFar}};
        r[in.b] = {0, 0};
        break;
      case Op::round_add:
        accumulate(boundRoundShare(params, a));
        out = {std::min(out.lo, a.lo), std::min(out.hi, a.hi)};
        break;
      case Op::round_end:
        out = boundRoundEnd(params, a, b);
        break;
      case Op::sum_begin:
        out = {0, 0};
        r[in.b] = {0, 0};
        break;
      case Op::sum_add:
        accumulate(a);
        out = {std::max(out.lo, a.lo), std::max(out.hi, a.hi)};
        break;
      case Op::sum_end:
        out = boundSumEnd(params, b);
        break;
      case Op::warp:
        break;
      default:
        out = boundOperands(in.op, params, a, b, c);
        break;
    }
  }
  const FloatInterval result = r[g.result];
  return {std::min(result.lo, double{kFar}), std::min(result.hi, double{kFar})};
}

}  // namespace

TEST_CASE("every op is as close to the double-precision reference as its operands and its stated error allow") {
  for (int o = 0; o < static_cast<int>(Op::count); ++o) {
    const Op op = static_cast<Op>(o);
    size_t tight = 0, compared = 0;
    for (uint32_t seed = 1; seed <= 24; ++seed) {
      std::mt19937 random(seed);
      const Int3 centre = kTestCentres[seed % std::size(kTestCentres)];
      const FieldProgram program = programOf(op, random, centre);
      const PointSet points = randomPoints(random, centre, 40'000, 200);
      const Evaluated e = evaluate(scalarKernels(), program.view(), points.points());
      INFO(opName(op) << ", seed " << seed);
      CHECK(shows(e));
      size_t far = 0;
      for (size_t i = 0; i < points.x.size(); ++i) {
        const Int3 p{points.x[i], points.y[i], points.z[i]};
        const double v = double{e.value[i]}, expected = referenceField(program.view(), p);
        const FloatInterval bounds = boundsAt(program.view(), p);
        const double slack = 1e-12 * std::abs(expected);
        const bool reference_in = expected >= bounds.lo - slack && expected <= bounds.hi + slack;
        far += !(v >= bounds.lo - 1e-30 && v <= bounds.hi + 1e-30) || !reference_in;
        ++compared;
        tight += bounds.hi - bounds.lo <= 1e-4 + 1e-4 * std::abs(expected);
      }
      // On a polyline, two segments may be equally near, and either may be chosen.
      CHECK(far <= (std::any_of(program.instrs.begin(), program.instrs.end(),
                                [](const Instr& in) { return in.op == Op::sweep; })
                        ? 2u
                        : 0u));
    }
    // The check would prove nothing if the bounds were too wide, so most of them must be tight.
    INFO(opName(op) << ": tight at " << tight << " of " << compared);
    const bool coarse = op == Op::warp || op == Op::displace || op == Op::superquadric || op == Op::power_morph;
    CHECK((coarse || tight * 4 > compared * 2));
  }
}

namespace {

// A program with a single operation. The operation either reads a position, or takes constants as operands; constants
// have no error themselves.
FieldProgram lonely(Op op, std::mt19937& random, Int3 centre) {
  const FieldProgram drawn = programOf(op, random, centre);
  if (drawn.instrs.size() == 1) return drawn;
  auto number = [&] {
    const double magnitude = std::exp2(static_cast<double>(random() % 3000) / 100 - 15);
    return static_cast<float>(random() % 2 ? magnitude : -magnitude);
  };
  auto share = [&] { return static_cast<float>(random() % 1001) / 1000.0f; };
  ProgramBuilder b(512, false, 0);
  Value v;
  auto constant = [&] { return b.constant(number()); };
  switch (op) {
    case Op::power_morph: {
      Frame f;
      f.origin = centre;
      const float sizes[6] = {900, 2000, 5000, 7000, 1500, 700};
      v = b.powerMorph(f, sizes, b.constant(share()), 0);
      break;
    }
    case Op::copy:
    case Op::negate:
    case Op::absolute:
    case Op::floor:
    case Op::square_root:
      v = b.unary(op, constant());
      break;
    case Op::smoothstep: {
      const Value x = constant();
      const float lower = number();
      v = b.smoothstep(x, lower, lower + 3 * number());
      break;
    }
    case Op::kernel: {
      const Value d = constant();
      v = b.kernelWeight(d, std::abs(number()));
      break;
    }
    case Op::mix:
    case Op::morph: {
      const Value x = constant(), y = constant();
      v = b.ternary(op, x, y, op == Op::morph ? b.constant(share()) : constant());
      break;
    }
    case Op::round_end: {
      RoundUnion acc(b, std::abs(number()));
      for (int i = 0; i < 9; ++i) acc.add(constant());
      v = acc.end();
      break;
    }
    case Op::sum_end: {
      KernelSum acc(b);
      for (int i = 0; i < 9; ++i) acc.add(b.constant(share()));
      v = acc.end(0.2263f, std::abs(number()));
      break;
    }
    default: {
      const Value x = constant();
      v = b.binary(op, x, constant());
      break;
    }
  }
  (void)b.group(v, IntBox::everything(), 0, false);
  return b.finish();
}

}  // namespace

TEST_CASE("no op's float error is more than the relative error that ops.def states", "[costly]") {
  for (int o = 0; o < static_cast<int>(Op::count); ++o) {
    const Op op = static_cast<Op>(o);
    // These ops are left out: a warp has no value of its own, and the error of a round or a sum is measured at its last
    // op.
    if (op == Op::warp || op == Op::round_begin || op == Op::round_add || op == Op::sum_begin || op == Op::sum_add)
      continue;
    std::mt19937 first(1);
    const bool reads_position = lonely(op, first, {}).instrs.size() == 1;
    const bool of_one = op == Op::noise || op == Op::sweep;
    double worst = 0;
    size_t compared = 0, ties = 0;
    // A program that reads no position has only one value, so many programs are tested: at least 300 values are
    // required below.
    const uint32_t programs = reads_position ? rounds(30) : std::max(rounds(600), 350u);
    for (uint32_t seed = 1; seed <= programs; ++seed) {
      std::mt19937 random(seed);
      const Int3 centre = kTestCentres[seed % std::size(kTestCentres)];
      const FieldProgram program = lonely(op, random, centre);
      // Points near the shapes, where the field is curved, and points 500 km away.
      PointSet points = randomPoints(random, centre, 40'000, reads_position ? 400 : 1);
      if (reads_position) {
        const PointSet far = randomPoints(random, centre, 500'000'000, 200);
        points.x.insert(points.x.end(), far.x.begin(), far.x.end());
        points.y.insert(points.y.end(), far.y.begin(), far.y.end());
        points.z.insert(points.z.end(), far.z.begin(), far.z.end());
      }
      const Evaluated e = evaluate(scalarKernels(), program.view(), points.points());
      for (size_t i = 0; i < points.x.size(); ++i) {
        const Int3 p{points.x[i], points.y[i], points.z[i]};
        const FloatInterval bounds = boundsAt(program.view(), p);
        const double expected = referenceField(program.view(), p), off = std::abs(double{e.value[i]} - expected);
        ++compared;
        // `half`, half the width of the bounds, is the stated relative error times the largest magnitude of the inputs.
        // So off / half times the stated error is the error relative to that magnitude.
        const double half = of_one ? statedError(op) : (bounds.hi - bounds.lo) / 2;
        const double relative = off == 0 ? 0 : half == 0 ? 1 : off / half * std::max(statedError(op), 1e-30);
        if (op == Op::sweep && relative > statedError(op)) {
          ++ties;  // a tie: two segments are equally near
          continue;
        }
        worst = std::max(worst, relative);
      }
    }
    std::cout << opName(op) << ": stated " << statedError(op) << ", measured " << worst << '\n';
    INFO(opName(op) << ", " << compared << " compared");
    CHECK(worst <= statedError(op));
    CHECK(compared >= 300);
    CHECK(ties * 200 <= compared);
  }
}
