// Tests that no bit of a result depends on the treatment of denormals (arithmetic contract, runtime/README.md): threads
// of games often flush them to zero, and Vulkan devices may do so without reporting it.

#include <xmmintrin.h>

#include "backend/cpu/instruction_sets.h"
#include "catch.h"
#include "random_programs.h"

using namespace sgm;

namespace {

constexpr unsigned kFlushAll = 0x8040;  // the flags FTZ and DAZ of the register MXCSR

bool flushes() {
  volatile float small = 1e-30f;
  volatile float product = small * 1e-10f;
  return product == 0.0f;
}

// Returns random points, and points on the axes through each primitive's centre: only on the axes do the tiny entries
// of a frame's rows affect results.
PointSet pointsFor(const FieldProgram& program, std::mt19937& random, Int3 centre) {
  PointSet points = randomPoints(random, centre, 20'000, 100);
  size_t primitives = 0;
  for (const Instr& in : program.instrs) {
    if (in.op < Op::sphere || in.op > Op::blob || ++primitives > 8) continue;
    for (uint32_t i = 0; i < 12; ++i) {
      Int3 p;
      for (int axis = 0; axis < 3; ++axis) {
        const auto at = static_cast<int32_t>(program.params[in.params + 1 + static_cast<uint32_t>(axis)]);
        const auto offset = static_cast<int32_t>(random() % 40'000) - 20'000;
        p[axis] = saturate(int64_t{at} + (i % 4 == static_cast<uint32_t>(axis) ? offset : 0));
      }
      points.x.push_back(p.x);
      points.y.push_back(p.y);
      points.z.push_back(p.z);
    }
  }
  return points;
}

}  // namespace

TEST_CASE("an evaluator on a thread that flushes denormals gives the same bits") {
  CHECK_FALSE(flushes());
  for (int o = -30; o < static_cast<int>(Op::count); ++o) {
    for (uint32_t round = 0; round < (o < 0 ? 2u : 9u); ++round) {
      const uint32_t seed = 1000 * static_cast<uint32_t>(o + 30) + round;
      std::mt19937 random(seed);
      RandomProgramOptions options;
      options.groups = 3;
      options.centre = kTestCentres[round % 3];
      options.odd = {round % 4 == 1, true};
      options.smooth_groups = 2;
      const FieldProgram program =
          o >= 0 ? programOf(static_cast<Op>(o), random, options.centre, options.odd) : randomProgram(random, options);
      const PointSet points = pointsFor(program, random, options.centre);
      const Evaluated expected = evaluate(scalarKernels(), program.view(), points.points());
      for (const InstructionSet& set : instructionSets()) {
        if (!set.runs_here) continue;
        const unsigned before = _mm_getcsr();
        _mm_setcsr(before | kFlushAll);
        const bool on = flushes();
        const Evaluated flushed = evaluate(*set.kernels, program.view(), points.points());
        _mm_setcsr(before);
        REQUIRE(on);
        INFO(set.kernels->name << ", " << (o >= 0 ? opName(static_cast<Op>(o)) : "random program") << ", seed "
                               << seed);
        CHECK(differentBits(expected, flushed) == 0);
      }
    }
  }
}
