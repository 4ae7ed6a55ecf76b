// Programs against their judges: the reference, interval bounds, pruning.

#include <cmath>
#include <iostream>

#include "catch.h"
#include "field/builder.h"
#include "field/prune.h"
#include "field/reference.h"
#include "random_programs.h"

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

TEST_CASE("every op is close to the double-precision reference") {
  for (int o = 0; o < static_cast<int>(Op::count); ++o) {
    const Op op = static_cast<Op>(o);
    // A step op may stand on either side of its step by rounding; what it feeds on is compared elsewhere.
    const bool step = op == Op::floor || op == Op::less || op == Op::divide;
    for (uint32_t seed = 1; seed <= 20 && !step; ++seed) {
      std::mt19937 random(seed);
      const FieldProgram program = programOf(op, random, {});
      bool has_step = false;
      for (const Instr& in : program.instrs) {
        has_step |= in.op == Op::floor || in.op == Op::less || in.op == Op::divide || in.op == Op::sweep;
      }
      if (has_step && op != Op::sweep) continue;
      const PointSet points = randomPoints(random, {}, 40'000, 300);
      const Evaluated e = evaluate(scalarKernels(), program.view(), points.points());
      size_t far = 0;
      for (size_t i = 0; i < points.x.size(); ++i) {
        const double expected = referenceField(program.view(), {points.x[i], points.y[i], points.z[i]});
        const double tolerance = op == Op::warp ? 4.0 : 1e-3 + 2e-4 * std::abs(expected) + 3.0 * 1e-5 * 65536;
        far += !(std::abs(double{e.value[i]} - expected) <= tolerance);
      }
      INFO(opName(op) << ", seed " << seed);
      // Along a polyline the nearest segment may differ on a tie.
      CHECK(far <= (op == Op::sweep ? 3u : 0u));
    }
  }
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
    for (uint32_t seed = 1; seed <= 25; ++seed) {
      std::mt19937 random(seed * 1000 + static_cast<uint32_t>(o + 40));
      const Int3 centre = seed % 2 ? Int3{} : Int3{2'000'000'000, -2'000'000'000, 7};
      RandomProgramOptions options;
      options.centre = centre;
      options.groups = 2;
      options.whole_influence = seed % 3 == 0;
      const FieldProgram program =
          o >= 0 ? programOf(static_cast<Op>(o), random, centre) : randomProgram(random, options);
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

TEST_CASE("a pruned program keeps every bit of every sample and attribute") {
  size_t before = 0, after = 0;
  for (uint32_t seed = 1; seed <= 600; ++seed) {
    std::mt19937 random(seed);
    RandomProgramOptions options;
    options.centre = seed % 2 ? Int3{} : Int3{-1'999'999'999, 2'000'000'000, -3};
    options.whole_influence = seed % 4 == 0;
    options.depth = 2 + static_cast<int>(seed % 4);
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
