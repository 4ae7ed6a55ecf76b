// Tests gradients against difference quotients of the reference.

#include <algorithm>
#include <cmath>
#include <iostream>

#include "catch.h"
#include "field/builder.h"
#include "field/reference.h"
#include "random_programs.h"

using namespace sgm;

namespace {

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
    // Points on the edges of cells, where vertices lie.
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
  // Compares gradients with central differences of the double-precision reference where the field is smooth around the
  // point.
  size_t compared = 0, off = 0;
  for (int o = 0; o < static_cast<int>(Op::count); ++o) {
    const Op op = static_cast<Op>(o);
    if (op == Op::floor || op == Op::less || op == Op::divide) continue;
    for (uint32_t seed = 1; seed <= 12; ++seed) {
      std::mt19937 random(seed * 77 + static_cast<uint32_t>(o));
      const FieldProgram program = programOf(op, random, {});
      // Skips noise that is finer than the step of the difference quotient.
      if (shortestPeriod(program) < 128) continue;
      // Skips the op `lattice`: its gradients are smoothed, and tested separately.
      if (reads(program, Op::lattice)) continue;
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
        // Near a crease, difference quotients with two step widths disagree: no gradient is correct there.
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
