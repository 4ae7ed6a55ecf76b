// Tests the conformance suite itself. It must fail for evaluators that were compiled with floating-point contraction,
// which rounds a * b + c only once; otherwise its success would prove nothing.

#include <iostream>

#include "catch.h"
#include "contracted.h"
#include "random_programs.h"

using namespace sgm;

TEST_CASE("an evaluator built with contraction on is caught") {
  if (!__builtin_cpu_supports("fma")) {
    std::cout << "SKIPPED: this processor has no fma to contract into\n";
    return;
  }
  size_t different = 0, programs = 0;
  for (uint32_t seed = 1; seed <= 30; ++seed) {
    std::mt19937 random(seed);
    const FieldProgram program = randomProgram(random, {});
    const PointSet points = randomPoints(random, {}, 40'000, 300);
    const size_t words = differentBits(evaluate(scalarKernels(), program.view(), points.points()),
                                       evaluate(contractedKernels(), program.view(), points.points()));
    different += words;
    programs += words > 0;
  }
  INFO(different << " words differ, in " << programs << " of 30 programs");
  CHECK(programs > 15);
}
