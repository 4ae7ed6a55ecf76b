// One body of comparisons that every backend runs: bytes against the scalar evaluator.

#include <cstdlib>
#include <iostream>

#include "backend/cpu/instruction_sets.h"
#include "catch.h"
#include "random_programs.h"

using namespace sgm;

namespace {

const Int3 kCentres[] = {{0, 0, 0}, {2'000'000'000, -2'000'000'000, 1'999'000'000}, {-2'047'000'000, 5, 2'000'000'000}};

uint32_t seedFromEnvironment() {
  const char* text = std::getenv("SGM_TEST_SEED");
  return text ? static_cast<uint32_t>(std::strtoul(text, nullptr, 10)) : 20'260'101u;
}

}  // namespace

TEST_CASE("every op gives the scalar evaluator's bits on every instruction set") {
  for (const InstructionSet& set : instructionSets()) {
    if (!set.runs_here) {
      std::cout << "SKIPPED: " << set.kernels->name
                << " does not run on this processor; its code is built, not compared\n";
      continue;
    }
    for (int o = 0; o < static_cast<int>(Op::count); ++o) {
      for (uint32_t round = 0; round < 12; ++round) {
        const uint32_t seed = seedFromEnvironment() + round;
        std::mt19937 random(seed);
        const Int3 centre = kCentres[round % 3];
        const FieldProgram program = programOf(static_cast<Op>(o), random, centre);
        const PointSet points = randomPoints(random, centre, 40'000, 700 + round);
        INFO(set.kernels->name << ", op " << opName(static_cast<Op>(o)) << ", seed " << seed);
        CHECK(differentBits(evaluate(scalarKernels(), program.view(), points.points()),
                            evaluate(*set.kernels, program.view(), points.points())) == 0);
      }
    }
  }
}

TEST_CASE("random programs give the scalar evaluator's bits on every instruction set") {
  for (uint32_t round = 0; round < 150; ++round) {
    const uint32_t seed = seedFromEnvironment() + 1000 + round;
    std::mt19937 random(seed);
    RandomProgramOptions options;
    options.centre = kCentres[round % 3];
    const FieldProgram program = randomProgram(random, options);
    const PointSet points = randomPoints(random, options.centre, 3 * options.extent, 513);
    const Evaluated expected = evaluate(scalarKernels(), program.view(), points.points());
    for (const InstructionSet& set : instructionSets()) {
      if (!set.runs_here) continue;
      INFO(set.kernels->name << ", seed " << seed);
      CHECK(differentBits(expected, evaluate(*set.kernels, program.view(), points.points())) == 0);
    }
  }
}

TEST_CASE("any count of points, 0 and odd ones included, gives the same bits") {
  std::mt19937 random(seedFromEnvironment());
  const FieldProgram program = randomProgram(random, {});
  const PointSet points = randomPoints(random, {}, 20'000, 1000);
  const Evaluated whole = evaluate(scalarKernels(), program.view(), points.points());
  for (const InstructionSet& set : instructionSets()) {
    if (!set.runs_here) continue;
    for (size_t count : {0u, 1u, 3u, 7u, 17u, 255u, 256u, 257u, 511u, 999u}) {
      Points some = points.points();
      some.count = count;
      const Evaluated part = evaluate(*set.kernels, program.view(), some);
      INFO(set.kernels->name << ", " << count << " points");
      CHECK(std::equal(part.q.begin(), part.q.end(), whole.q.begin()));
      CHECK(std::equal(part.nx.begin(), part.nx.end(), whole.nx.begin()));
      CHECK(std::equal(part.label.begin(), part.label.end(), whole.label.begin()));
    }
  }
}
