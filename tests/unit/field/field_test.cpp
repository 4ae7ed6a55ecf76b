// Programs against their judges: the reference, interval bounds, pruning.

#include <algorithm>
#include <array>
#include <cmath>
#include <iostream>
#include <iterator>

#include "base/hash.h"
#include "catch.h"
#include "field/builder.h"
#include "field/prune.h"
#include "field/reference.h"
#include "random_programs.h"
#include "rounds.h"

using namespace sgm;

namespace {

IntBox randomBox(std::mt19937& random, Int3 centre, int32_t extent) {
  const PointSet p = randomPoints(random, centre, extent, 1);
  const int32_t size = 64 << random() % 8;
  return IntBox{{p.x[0], p.y[0], p.z[0]}, {p.x[0], p.y[0], p.z[0]}}.grown(size);
}

PointSet pointsOf(std::mt19937& random, const IntBox& b, size_t count) {
  PointSet s;
  auto axis = [&](int32_t lo, int32_t hi) {
    return static_cast<int32_t>(lo + static_cast<int64_t>(random() % static_cast<uint64_t>(int64_t{hi} - lo + 1)));
  };
  for (size_t i = 0; i < count; ++i) {
    s.x.push_back(axis(b.lo.x, b.hi.x));
    s.y.push_back(axis(b.lo.y, b.hi.y));
    s.z.push_back(axis(b.lo.z, b.hi.z));
  }
  return s;
}

int32_t shortestPeriod(const FieldProgram& program) {
  int32_t shortest = 1 << 30;
  for (const Instr& in : program.instrs) {
    if (in.op != Op::noise) continue;
    const uint32_t octaves = program.params[in.params + 3];
    for (uint32_t k = 0; k < octaves; ++k) {
      shortest = std::min(shortest, static_cast<int32_t>(program.params[in.params + 6 + 2 * k]));
    }
  }
  return shortest;
}

}  // namespace

namespace {

// A register after the first `count` instructions of a group, by the reference.
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

// Bounds of the float value of a program of one group at one point: the reference at its leaves, and each op's stated
// error from there on.
Interval boundsAt(const ProgramView& program, Int3 p) {
  const ProgramGroup& g = program.groups[0];
  const PlaceBox here = placeBox({p, p});
  std::array<Interval, kMaxRegisters> r{};
  for (uint32_t i = 0; i < g.count; ++i) {
    const Instr& in = program.instrs[g.first + i];
    const uint32_t* params = program.params.data() + in.params;
    const Interval a = r[in.a], b = r[in.b], c = r[in.c];
    Interval& out = r[in.dst];
    auto accumulate = [&](Interval share) {
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
        // Read at a warped place, where rounding may choose the next unit on each axis.
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
  const Interval result = r[g.result];
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
        const Interval bounds = boundsAt(program.view(), p);
        const double slack = 1e-12 * std::abs(expected);
        const bool reference_in = expected >= bounds.lo - slack && expected <= bounds.hi + slack;
        far += !(v >= bounds.lo - 1e-30 && v <= bounds.hi + 1e-30) || !reference_in;
        ++compared;
        tight += bounds.hi - bounds.lo <= 1e-4 + 1e-4 * std::abs(expected);
      }
      // Along a polyline the nearest segment may differ on a tie.
      CHECK(far <= (std::any_of(program.instrs.begin(), program.instrs.end(),
                                [](const Instr& in) { return in.op == Op::sweep; })
                        ? 2u
                        : 0u));
    }
    // Bounds that hold everything would compare nothing.
    INFO(opName(op) << ": tight at " << tight << " of " << compared);
    const bool coarse = op == Op::warp || op == Op::displace || op == Op::superquadric || op == Op::power_morph;
    CHECK((coarse || tight * 4 > compared * 2));
  }
}

namespace {

// One op alone: a position op, or one over constants, which bring no error of their own.
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
      const auto acc = b.beginRound(std::abs(number()));
      for (int i = 0; i < 9; ++i) b.addRound(acc, constant());
      v = b.endRound(acc);
      break;
    }
    case Op::sum_end: {
      const auto acc = b.beginSum();
      for (int i = 0; i < 9; ++i) b.addSum(acc, b.constant(share()));
      v = b.endSum(acc, 0.2263f, std::abs(number()));
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

TEST_CASE("no op's float error is more than the relative error that ops.def states") {
  for (int o = 0; o < static_cast<int>(Op::count); ++o) {
    const Op op = static_cast<Op>(o);
    // A warp gives no value, and what begins and adds is measured where it ends.
    if (op == Op::warp || op == Op::round_begin || op == Op::round_add || op == Op::sum_begin || op == Op::sum_add)
      continue;
    std::mt19937 first(1);
    const bool reads_position = lonely(op, first, {}).instrs.size() == 1;
    const bool of_one = op == Op::noise || op == Op::sweep;
    double worst = 0;
    size_t compared = 0, ties = 0;
    // One point each gives the 300 values that are asked for below.
    const uint32_t programs = reads_position ? rounds(30) : std::max(rounds(600), 350u);
    for (uint32_t seed = 1; seed <= programs; ++seed) {
      std::mt19937 random(seed);
      const Int3 centre = kTestCentres[seed % std::size(kTestCentres)];
      const FieldProgram program = lonely(op, random, centre);
      // Near, where shapes are round, and 500 km away.
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
        const Interval bounds = boundsAt(program.view(), p);
        const double expected = referenceField(program.view(), p), off = std::abs(double{e.value[i]} - expected);
        ++compared;
        // Half the width of the bounds at a point is the stated error times the magnitude that enters.
        const double half = of_one ? statedError(op) : (bounds.hi - bounds.lo) / 2;
        const double relative = off == 0 ? 0 : half == 0 ? 1 : off / half * std::max(statedError(op), 1e-30);
        if (op == Op::sweep && relative > statedError(op)) {
          ++ties;  // two segments as near as each other
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

namespace {

bool reads(const FieldProgram& program, Op op) {
  return std::any_of(program.instrs.begin(), program.instrs.end(), [op](const Instr& in) { return in.op == op; });
}

}  // namespace

TEST_CASE("the slopes between a lattice's samples near the field's with the square of its spacing") {
  const double radius = 9000, middle = 123;
  double before = 0;
  for (const int32_t spacing : {2048, 1024, 512, 256}) {
    const IntBox box{{-12'000, -12'000, -12'000}, {12'000, 12'000, 12'000}};
    const SampleLattice at = latticeAround(box, spacing);
    std::vector<float> samples;
    for (uint32_t z = 0; z < at.count[2]; ++z) {
      for (uint32_t y = 0; y < at.count[1]; ++y) {
        for (uint32_t x = 0; x < at.count[0]; ++x) {
          const auto along = [&](int axis, uint32_t i) { return at.origin[axis] + static_cast<double>(i) * spacing; };
          const double away = std::hypot(along(0, x) - middle, along(1, y) - middle, along(2, z) - middle);
          samples.push_back(static_cast<float>(std::floor((away - radius) * 1024) / 1024));
        }
      }
    }
    ProgramBuilder builder(spacing, false, 0);
    REQUIRE(builder.group(builder.lattice(at, samples, kFarSample, 0), IntBox::everything(), 0, false));
    const FieldProgram program = builder.finish();
    // Where vertices are: on the edges of cells.
    std::mt19937 random(static_cast<uint32_t>(spacing));
    std::vector<int32_t> p[3];
    for (int i = 0; i < 4000; ++i) {
      const auto edge = random() % 3;
      for (size_t a = 0; a < 3; ++a) {
        const auto offset = static_cast<int32_t>(random() % 24'000) - 12'000;
        p[a].push_back(a == edge ? offset : offset / spacing * spacing);
      }
    }
    const Evaluated e = evaluate(scalarKernels(), program.view(), {p[0].data(), p[1].data(), p[2].data(), 4000});
    double worst = 0;
    for (size_t i = 0; i < 4000; ++i) {
      const double x = p[0][i] - middle, y = p[1][i] - middle, z = p[2][i] - middle, away = std::hypot(x, y, z);
      if (std::abs(away - radius) > 1000) continue;
      const double off = std::hypot(double{e.gx[i]} - x / away, double{e.gy[i]} - y / away, double{e.gz[i]} - z / away);
      worst = std::max(worst, off);
    }
    CAPTURE(spacing, worst, before);
    if (before > 0) CHECK(worst * 3 < before);
    before = worst;
  }
  CHECK(before < 1e-3);
}

TEST_CASE("analytic gradients follow the field") {
  // Against central differences of the double-precision reference, where the field is smooth around the point.
  size_t compared = 0, off = 0;
  for (int o = 0; o < static_cast<int>(Op::count); ++o) {
    const Op op = static_cast<Op>(o);
    if (op == Op::floor || op == Op::less || op == Op::divide) continue;
    for (uint32_t seed = 1; seed <= 12; ++seed) {
      std::mt19937 random(seed * 77 + static_cast<uint32_t>(o));
      const FieldProgram program = programOf(op, random, {});
      if (shortestPeriod(program) < 128) continue;  // finer than the differences' own step
      if (reads(program, Op::lattice)) continue;    // smoother than its samples: it has a test of its own
      const PointSet points = randomPoints(random, {}, 20'000, 60);
      const Evaluated e = evaluate(scalarKernels(), program.view(), points.points());
      for (size_t i = 0; i < points.x.size(); ++i) {
        const Int3 p{points.x[i], points.y[i], points.z[i]};
        auto at = [&](int dx, int dy, int dz) {
          return referenceField(program.view(), {p.x + dx, p.y + dy, p.z + dz});
        };
        const double h = 8;
        const double d[3] = {(at(8, 0, 0) - at(-8, 0, 0)) / (2 * h), (at(0, 8, 0) - at(0, -8, 0)) / (2 * h),
                             (at(0, 0, 8) - at(0, 0, -8)) / (2 * h)};
        const double half[3] = {(at(4, 0, 0) - at(-4, 0, 0)) / h, (at(0, 4, 0) - at(0, -4, 0)) / h,
                                (at(0, 0, 4) - at(0, 0, -4)) / h};
        double norm = 0, change = 0, error = 0;
        const double g[3] = {double{e.gx[i]}, double{e.gy[i]}, double{e.gz[i]}};
        for (int a = 0; a < 3; ++a) {
          norm += half[a] * half[a];
          change += (d[a] - half[a]) * (d[a] - half[a]);
          error += (g[a] - half[a]) * (g[a] - half[a]);
        }
        // Near a crease the two step widths disagree; there no gradient is the right one.
        if (change > 1e-6 * (norm + 1e-6)) continue;
        ++compared;
        const bool wrong = error > 4e-4 * norm + 1e-6;
        off += wrong;
        if (wrong && off < 10) {
          std::cout << opName(op) << " seed " << seed << ": gradient " << g[0] << ' ' << g[1] << ' ' << g[2]
                    << " against " << half[0] << ' ' << half[1] << ' ' << half[2] << '\n';
        }
      }
    }
  }
  INFO(compared << " compared, " << off << " off");
  CHECK(compared > 5000);
  CHECK(off * 500 < compared);
}

TEST_CASE("interval bounds hold every float value") {
  for (int o = -40; o < static_cast<int>(Op::count); ++o) {
    for (uint32_t seed = 1; seed <= rounds(40); ++seed) {
      std::mt19937 random(seed * 1000 + static_cast<uint32_t>(o + 40));
      const Int3 centre = seed % 2 ? Int3{} : Int3{2'000'000'000, -2'000'000'000, 7};
      RandomProgramOptions options;
      options.centre = centre;
      options.groups = 2;
      options.whole_influence = seed % 3 == 0;
      options.odd = {seed % 4 == 0, seed % 5 == 0};
      options.smooth_groups = static_cast<int>(seed % 3);
      const FieldProgram program =
          o >= 0 ? programOf(static_cast<Op>(o), random, centre, options.odd) : randomProgram(random, options);
      const IntBox box = randomBox(random, centre, 30'000);
      PruneScratch scratch;
      PrunedProgram pruned;
      prune(program.view(), box, scratch, pruned);
      const PointSet points = pointsOf(random, box, 257);
      const Evaluated e = evaluate(scalarKernels(), program.view(), points.points());
      size_t outside = 0;
      for (float v : e.value) outside += !(double{v} >= pruned.field.lo && double{v} <= pruned.field.hi);
      INFO((o >= 0 ? opName(static_cast<Op>(o)) : "random program")
           << ", seed " << seed << ", bounds " << pruned.field.lo << " .. " << pruned.field.hi);
      CHECK(outside == 0);
    }
  }
}

TEST_CASE("bounds hold where sample and centre are more than an int32 apart, and the reference agrees") {
  auto check = [](ProgramBuilder& b, Value v, Int3 p) {
    (void)b.group(v, IntBox::everything(), 0, false);
    const FieldProgram program = b.finish();
    const PointSet point = gridPoints({p, p}, 1);
    const double value = double{evaluate(scalarKernels(), program.view(), point.points()).value[0]};
    for (int32_t size : {0, 64, 100'000}) {
      PruneScratch scratch;
      PrunedProgram pruned;
      prune(program.view(), IntBox{p, p}.grown(size), scratch, pruned);
      INFO("value " << value << ", box " << size << ", bounds " << pruned.field.lo << " .. " << pruned.field.hi);
      CHECK(value >= pruned.field.lo);
      CHECK(value <= pruned.field.hi);
    }
    const double expected = referenceField(program.view(), p);
    CHECK(std::abs(value - expected) <= 1e-6 * 4e9);
    return value;
  };
  SECTION("a half-space") {
    ProgramBuilder b(512, false, 0);
    Frame f;
    f.origin = {-2'000'000'000, 1'900'000'000, 1'900'000'000};
    const float third = 0.57735f;
    f.rows = {0.81650f, -0.40825f, -0.40825f, third, third, third, 0, 0.70711f, -0.70711f};
    // Unsaturated, the sum of the offsets is positive.
    CHECK(check(b, b.halfspace(f, 0), {2'100'000'000, 0, 0}) < 0);
  }
  SECTION("a comparison of a coordinate") {
    ProgramBuilder b(512, false, 0);
    const Value x = b.coordinate({-2'048'000'000, 0, 0}, 1, 0, 0);
    CHECK(check(b, b.binary(Op::less, x, b.constant(3'000'000)), {2'048'000'000, 0, 0}) == 1);
  }
  SECTION("a sphere, and a morphed power") {
    ProgramBuilder b(512, false, 0);
    const Value ball = b.sphere({-2'048'000'000, 2'000'000'000, 0}, 3.0e9f, 0);
    check(b, ball, {2'048'000'000, -2'000'000'000, 5});
    Frame f;
    f.origin = {-2'048'000'000, 2'000'000'000, 0};
    const float sizes[6] = {2e9f, 2e9f, 2e9f, 1e9f, 1e9f, 1e9f};
    const Value t = b.coordinate({2'048'000'000, 0, 0}, 0.001f, 0, 0);
    check(b, b.powerMorph(f, sizes, t, 0), {2'048'000'000, -2'000'000'000, 5});
  }
  SECTION("a place warped farther than a warp goes") {  // it stops after 1,048,576 m, in the middle of the ball
    ProgramBuilder b(512, false, 0);
    const Value far = b.constant(2e6f), none = b.constant(0);
    b.pushWarp(far, none, none);
    const Value ball = b.sphere({-2'000'000'000 + 1024 * 1'048'576, 0, 0}, 500'000, 0);
    b.popWarp();
    check(b, ball, {-2'000'000'000, 0, 0});
  }
}

TEST_CASE("a gradient that outgrows float32 does not cost a pruned program its bits") {
  // Around x = 1 km the morph is past its end, and its amount's slope past any float.
  ProgramBuilder b(512, false, 0);
  Value t = b.coordinate({}, 1, 0, 0);
  for (int i = 0; i < 5; ++i) t = b.binary(Op::multiply, t, t);
  const Value from = b.sphere({1'024'000, 0, 0}, 2000, 1), to = b.sphere({1'025'000, 700, 300}, 2000, 2);
  (void)b.group(b.ternary(Op::morph, from, to, t), IntBox::everything(), 0, false);
  const FieldProgram program = b.finish();
  const IntBox box = IntBox{{1'024'000, 0, 0}, {1'024'000, 0, 0}}.grown(2000);
  PruneScratch scratch;
  PrunedProgram pruned;
  prune(program.view(), box, scratch, pruned);
  CHECK(pruned.instrs.size() < program.instrs.size() - 4);
  const PointSet points = gridPoints(box, 400);
  const Evaluated whole = evaluate(scalarKernels(), program.view(), points.points());
  CHECK(differentBits(whole, evaluate(scalarKernels(), pruned.view(), points.points())) == 0);
  for (size_t i = 0; i < points.x.size(); ++i) {
    REQUIRE(std::isfinite(whole.gx[i]));
    const double length = std::hypot(double{whole.gx[i]}, double{whole.gy[i]}, double{whole.gz[i]});
    REQUIRE(std::abs(length - 1) < 1e-5);
  }
}

TEST_CASE("a cut that does not reach a box takes nothing from what lies however deep in the solid") {
  ProgramBuilder b(512, false, 0);
  Frame f;
  f.rows = {0, 0, 1, 1, 0, 0, 0, 1, 0};
  f.origin = {2'000'000'000, 0, 0};  // the box is some 3,900 km inside
  (void)b.group(b.halfspace(f, 1), IntBox::everything(), 0, false);
  const IntBox away{{0, 0, 0}, {1000, 1000, 1000}};
  (void)b.group(b.sphere({500, 500, 500}, 400, 2), away, 0, true);
  const FieldProgram program = b.finish();
  const IntBox box = IntBox{{-2'000'000'000, 0, 0}, {-2'000'000'000, 0, 0}}.grown(100);
  const ProgramView whole = program.view();
  ProgramView uncut = whole;
  uncut.groups = whole.groups.first(1);
  const PointSet points = gridPoints(box, 50);
  const Evaluated expected = evaluate(scalarKernels(), uncut, points.points());
  CHECK(std::abs(expected.gx[0]) == 1);
  CHECK(differentBits(expected, evaluate(scalarKernels(), whole, points.points())) == 0);
}

TEST_CASE("a mix of held values stays finite") {
  ProgramBuilder b(512, false, 0);
  const Value x = b.coordinate({}, 1, 0, 0);
  Value big = b.binary(Op::multiply, x, b.constant(1e18f));
  for (int i = 0; i < 4; ++i) big = b.ternary(Op::mix, big, b.unary(Op::negate, big), big);
  const Value root = b.binary(Op::add, b.sphere({}, 1000, 1), b.binary(Op::less, big, x));
  (void)b.group(root, IntBox::everything(), 0, false);
  const FieldProgram program = b.finish();
  const Evaluated e =
      evaluate(scalarKernels(), program.view(), gridPoints({{-4000, -4000, -4000}, {4000, 4000, 4000}}, 1000).points());
  for (size_t i = 0; i < e.value.size(); ++i) REQUIRE(std::isfinite(e.value[i]));
}

TEST_CASE("a pruned program keeps every bit of every sample and attribute") {
  size_t before = 0, after = 0;
  for (uint32_t seed = 1; seed <= rounds(600); ++seed) {
    std::mt19937 random(seed);
    RandomProgramOptions options;
    options.centre = seed % 2 ? Int3{} : Int3{-1'999'999'999, 2'000'000'000, -3};
    options.whole_influence = seed % 4 == 0;
    options.depth = 2 + static_cast<int>(seed % 4);
    options.odd = {seed % 6 == 0, seed % 5 == 0};
    options.smooth_groups = static_cast<int>(seed % 7 == 0 ? 12 : seed % 3);
    const FieldProgram program = randomProgram(random, options);
    IntBox box = randomBox(random, options.centre, options.extent);
    PruneScratch scratch;
    PrunedProgram pruned, twice;
    ProgramView view = program.view();
    prune(view, box, scratch, pruned);
    const PointSet points = pointsOf(random, box, 300);
    const Evaluated expected = evaluate(scalarKernels(), view, points.points());
    INFO("seed " << seed);
    if (pruned.solid() || pruned.empty()) {
      for (int32_t q : expected.q) CHECK((q < 0) == pruned.solid());
      continue;
    }
    before += program.instrs.size();
    after += pruned.instrs.size();
    CHECK(differentBits(expected, evaluate(scalarKernels(), pruned.view(), points.points())) == 0);
    // Level by level, as a chunk does it: an octant of the box, pruned from what the box had left.
    const Int3 middle{box.lo.x + (box.hi.x - box.lo.x) / 2, box.lo.y + (box.hi.y - box.lo.y) / 2,
                      box.lo.z + (box.hi.z - box.lo.z) / 2};
    const IntBox octant{box.lo, middle};
    prune(pruned.view(), octant, scratch, twice);
    const PointSet inner = pointsOf(random, octant, 300);
    const Evaluated inner_expected = evaluate(scalarKernels(), view, inner.points());
    if (twice.solid() || twice.empty()) {
      for (int32_t q : inner_expected.q) CHECK((q < 0) == twice.solid());
    } else {
      CHECK(differentBits(inner_expected, evaluate(scalarKernels(), twice.view(), inner.points())) == 0);
    }
  }
  std::cout << "pruning kept " << after << " of " << before << " instructions\n";
  CHECK(after * 2 < before);
}

TEST_CASE("a shape too deep for the registers is an error, and the builder goes on") {
  ProgramBuilder b(512, false, 0);
  std::vector<Value> held;
  for (int i = 0; i < kMaxRegisters + 1; ++i) held.push_back(b.sphere({i, 0, 0}, 100, 0));
  Value v = held[0];
  for (size_t i = 1; i < held.size(); ++i) v = b.binary(Op::minimum, v, held[i]);
  const Result<void> r = b.group(v, IntBox::everything(), 0, false);
  REQUIRE_FALSE(r);
  CHECK(r.error().code == Code::limit);
  CHECK(b.group(b.sphere({}, 100, 0), IntBox::everything(), 0, false));
  CHECK(b.finish().groups.size() == 1);
}

TEST_CASE("one seed means one random program, whatever the compiler") {
  uint64_t hash = 0;
  auto add = [&](const FieldProgram& program) {
    auto word = [&](uint64_t w) { hash = hashCombine(hash, w); };
    for (const Instr& in : program.instrs) {
      for (unsigned w : {static_cast<unsigned>(in.op), unsigned{in.dst}, unsigned{in.a}, unsigned{in.b}, unsigned{in.c},
                         unsigned{in.place}, unsigned{in.params}}) {
        word(w);
      }
    }
    for (uint32_t p : program.params) word(p);
    word(program.initial_label);
  };
  for (uint32_t seed = 1; seed <= 24; ++seed) {
    std::mt19937 random(seed);
    RandomProgramOptions options;
    options.odd = {seed % 3 == 0, seed % 4 == 0};
    add(randomProgram(random, options));
    for (int o = 0; o < static_cast<int>(Op::count); ++o) add(programOf(static_cast<Op>(o), random, {}));
  }
  // Whoever changes the generator changes this too.
  CHECK(hash == 0xa56a6131dfc0950du);
}
