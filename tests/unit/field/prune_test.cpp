// Tests interval bounds and pruning against the values at many points.

#include <cmath>
#include <iostream>

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

}  // namespace

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
    // The x offset, 4.1e9 units, saturates at the largest int32. With the exact offset, the sum of the three offsets
    // would be positive.
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
  // A warp displaces a point by at most 1,048,576 m, here into the middle of the ball.
  SECTION("a place warped farther than a warp goes") {
    ProgramBuilder b(512, false, 0);
    const Value far = b.constant(2e6f), none = b.constant(0);
    b.pushWarp(far, none, none);
    const Value ball = b.sphere({-2'000'000'000 + 1024 * 1'048'576, 0, 0}, 500'000, 0);
    b.popWarp();
    check(b, ball, {-2'000'000'000, 0, 0});
  }
}

TEST_CASE("a gradient that outgrows float32 does not cost a pruned program its bits") {
  // Near x = 1 km, the morph's amount is above 1, and the slope of the amount exceeds the range of float32.
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
  f.origin = {2'000'000'000, 0, 0};  // the tested box lies some 3,900 km inside the half-space
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

TEST_CASE("a pruned program keeps every bit of every sample and attribute") {
  size_t before = 0, after = 0, uniform = 0;
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
      CHECK(pruned.instrs.empty());
      prune(view, box, scratch, pruned, Uniform::keep);
      CHECK(differentBits(expected, evaluate(scalarKernels(), pruned.view(), points.points())) == 0);
      ++uniform;
      continue;
    }
    before += program.instrs.size();
    after += pruned.instrs.size();
    CHECK(differentBits(expected, evaluate(scalarKernels(), pruned.view(), points.points())) == 0);
    // Prunes repeatedly, as chunks do: prunes the box's program again for an octant of the box.
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
  CHECK(uniform > 0);
}
