// Tests making programs: errors of the builder, values that stay finite, and random programs.

#include <cmath>

#include "base/hash.h"
#include "catch.h"
#include "field/builder.h"
#include "random_programs.h"
#include "rounds.h"

using namespace sgm;

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
  // After a change of the generator of random programs, update this hash.
  CHECK(hash == 0xa56a6131dfc0950du);
}

TEST_CASE("the evaluator that counts gives the scalar one's bits, and counts every instruction of every point") {
  for (uint32_t seed = 1; seed <= rounds(50); ++seed) {
    CAPTURE(seed);
    std::mt19937 random(seed);
    const FieldProgram program = randomProgram(random, {});
    const PointSet points = randomPoints(random, {}, 20'000, random() % (2 * kEvalBlock + 2));
    CHECK(differentBits(evaluate(countingKernels(), program.view(), points.points()),
                        evaluate(scalarKernels(), program.view(), points.points())) == 0);
    EvalScratch scratch;
    std::vector<int32_t> q(points.x.size());
    countingKernels().samples(program.view(), points.points(), scratch, q.data());
    const uint64_t once = uint64_t{program.instrs.size()} * points.x.size();
    CHECK(scratch.operations == once);
    countingKernels().attributes(program.view(), points.points(), scratch, {});
    CHECK(scratch.operations == 2 * once);
  }
}
