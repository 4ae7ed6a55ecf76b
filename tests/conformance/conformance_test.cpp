// Tests that every CPU evaluator gives the same bytes as the scalar evaluator.

#include <cstdlib>
#include <iostream>
#include <string_view>
#include <vector>

#include "backend/cpu/instruction_sets.h"
#include "catch.h"
#include "random_programs.h"
#include "rounds.h"

using namespace sgm;

namespace {

uint32_t fromEnvironment(const char* name, uint32_t otherwise) {
  const char* text = std::getenv(name);
  return text ? static_cast<uint32_t>(std::strtoul(text, nullptr, 10)) : otherwise;
}
uint32_t seedFromEnvironment() { return fromEnvironment("SGM_TEST_SEED", 20'260'101u); }
// Returns the number of rounds for each operation. An emulated processor is some hundred times slower, so its
// environment sets a smaller number.
uint32_t roundsOfEachOp() { return fromEnvironment("SGM_TEST_ROUNDS", 12); }
uint32_t randomPrograms() { return fromEnvironment("SGM_TEST_PROGRAMS", sgm::rounds(150)); }

// Returns the evaluators that this machine can run, or only the one that SGM_TEST_INSTRUCTION_SET names; it is an error
// if this machine cannot run that one.
std::vector<const FieldKernels*> compared() {
  std::vector<const FieldKernels*> kernels;
  const char* only = std::getenv("SGM_TEST_INSTRUCTION_SET");
  for (const InstructionSet& set : instructionSets()) {
    if (set.runs_here && (!only || std::string_view(only) == set.kernels->name)) kernels.push_back(set.kernels);
  }
  return kernels;
}

}  // namespace

TEST_CASE("there is an instruction set to compare, and those that are left out are named") {
  for (const InstructionSet& set : instructionSets()) {
    if (!set.runs_here)
      std::cout << "SKIPPED: " << set.kernels->name
                << " does not run on this processor; its code is built, not compared\n";
  }
  for (const FieldKernels* kernels : compared()) {
    std::cout << "comparing " << kernels->name << " with scalar: " << static_cast<int>(Op::count) << " ops x "
              << roundsOfEachOp() << " programs, " << randomPrograms() << " random programs, seed "
              << seedFromEnvironment() << std::endl;
  }
  CHECK(!compared().empty());
}

TEST_CASE("every op gives the scalar evaluator's bits on every instruction set") {
  for (const FieldKernels* kernels : compared()) {
    for (int o = 0; o < static_cast<int>(Op::count); ++o) {
      for (uint32_t round = 0; round < roundsOfEachOp(); ++round) {
        const uint32_t seed = seedFromEnvironment() + round;
        std::mt19937 random(seed);
        const Int3 centre = kTestCentres[round % 3];
        const FieldProgram program = programOf(static_cast<Op>(o), random, centre);
        const PointSet points = randomPoints(random, centre, 40'000, 700 + round);
        INFO(kernels->name << ", op " << opName(static_cast<Op>(o)) << ", seed " << seed);
        const Evaluated expected = evaluate(scalarKernels(), program.view(), points.points());
        CHECK(shows(expected));
        CHECK(differentBits(expected, evaluate(*kernels, program.view(), points.points())) == 0);
      }
    }
  }
}

TEST_CASE("random programs give the scalar evaluator's bits on every instruction set") {
  for (uint32_t round = 0; round < randomPrograms(); ++round) {
    const uint32_t seed = seedFromEnvironment() + 1000 + round;
    std::mt19937 random(seed);
    RandomProgramOptions options;
    options.centre = kTestCentres[round % 3];
    options.odd = {round % 5 == 1, round % 5 == 2};
    options.smooth_groups = static_cast<int>(round % 4);
    const FieldProgram program = randomProgram(random, options);
    const PointSet points = randomPoints(random, options.centre, 3 * options.extent, 513);
    const Evaluated expected = evaluate(scalarKernels(), program.view(), points.points());
    for (const FieldKernels* kernels : compared()) {
      INFO(kernels->name << ", seed " << seed);
      CHECK(differentBits(expected, evaluate(*kernels, program.view(), points.points())) == 0);
    }
  }
}

TEST_CASE("any count of points, 0 and odd ones included, gives the same bits") {
  std::mt19937 random(seedFromEnvironment());
  const FieldProgram program = randomProgram(random, {});
  const PointSet points = randomPoints(random, {}, 20'000, 1000);
  const Evaluated whole = evaluate(scalarKernels(), program.view(), points.points());
  for (const FieldKernels* kernels : compared()) {
    for (size_t count : {0u, 1u, 3u, 7u, 17u, 255u, 256u, 257u, 511u, 999u}) {
      Points some = points.points();
      some.count = count;
      const Evaluated part = evaluate(*kernels, program.view(), some);
      INFO(kernels->name << ", " << count << " points");
      CHECK(std::equal(part.q.begin(), part.q.end(), whole.q.begin()));
      CHECK(std::equal(part.nx.begin(), part.nx.end(), whole.nx.begin()));
      CHECK(std::equal(part.label.begin(), part.label.end(), whole.label.begin()));
    }
  }
}
