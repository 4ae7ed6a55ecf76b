// Tests which instructions of a tape (a program as the shaders run it) are merged into others, and which must not be.
// The conformance tests check that a tape gives the same bytes as its program.

#include "backend/vulkan/tape_schedule.h"

#include <algorithm>
#include <set>

#include "catch.h"
#include "field/builder.h"
#include "random_programs.h"
#include "rounds.h"

using namespace sgm;

namespace {

using Node = TapeScratch::Node;

struct Tapes {
  TapeScratch scratch{std::pmr::get_default_resource()};

  const std::pmr::vector<Node>& of(ProgramBuilder& builder, Value root) {
    REQUIRE(builder.group(root, IntBox::everything(), 0, false));
    program = builder.finish();
    REQUIRE(scheduleTape(program.view(), scratch));
    return scratch.nodes;
  }
  size_t count(Op op) const {
    return static_cast<size_t>(std::count_if(scratch.nodes.begin(), scratch.nodes.end(),
                                             [op](const Node& n) { return n.kind == static_cast<uint32_t>(op); }));
  }
  const Node& first(Op op) const {
    return *std::find_if(scratch.nodes.begin(), scratch.nodes.end(),
                         [op](const Node& n) { return n.kind == static_cast<uint32_t>(op); });
  }
  FieldProgram program;
};

ProgramBuilder builder() { return ProgramBuilder(512, false, 0); }
Value ball(ProgramBuilder& b, int32_t x) { return b.sphere({x, 0, 0}, 1000, 0); }
Value morph(ProgramBuilder& b, Value t) { return b.ternary(Op::morph, ball(b, 0), ball(b, 1), t); }

}  // namespace

TEST_CASE("what a mix or a morph goes by is a parameter where it is constant", "[tape]") {
  for (const Op op : {Op::mix, Op::morph}) {
    Tapes tapes;
    ProgramBuilder b = builder();
    tapes.of(b, b.ternary(op, ball(b, 0), ball(b, 1), b.constant(0.25f)));
    CHECK(tapes.count(Op::constant) == 0);
    CHECK(tapes.first(op).by_constant);
    CHECK(tapes.first(op).by == 0.25f);
    CHECK(tapes.first(op).c < 0);
  }
  SECTION("one constant for several, which nobody else reads") {
    Tapes tapes;
    ProgramBuilder b = builder();
    const Value t = b.constant(0.5f), one = morph(b, t);
    tapes.of(b, b.ternary(Op::mix, one, morph(b, t), t));
    CHECK(tapes.count(Op::constant) == 0);
  }
  SECTION("somebody else reads it") {
    Tapes tapes;
    ProgramBuilder b = builder();
    const Value t = b.constant(0.5f);
    tapes.of(b, b.binary(Op::maximum, morph(b, t), t));
    CHECK(tapes.count(Op::constant) == 1);
    CHECK(tapes.first(Op::morph).by_constant);
  }
  SECTION("it is no constant") {
    Tapes tapes;
    ProgramBuilder b = builder();
    const float row[] = {1, 0, 0};
    tapes.of(b, morph(b, b.coordinate({}, row[0], row[1], row[2])));
    CHECK_FALSE(tapes.first(Op::morph).by_constant);
    CHECK(tapes.first(Op::morph).c >= 0);
  }
  SECTION("it is what sums have come to, of which no one node makes all") {
    Tapes tapes;
    ProgramBuilder b = builder();
    const Value constant = b.constant(0.25f);
    KernelSum sum(b);
    sum.add(b.kernelWeight(ball(b, 0), 500));
    tapes.of(b, b.binary(Op::minimum, morph(b, sum.end(0.2f, 1000)), constant));
    CHECK_FALSE(tapes.first(Op::morph).by_constant);
  }
}

TEST_CASE("what a sum adds is a part of the addition, unless others read it", "[tape]") {
  const auto summed = [](float time, int readers_of) {
    Tapes tapes;
    ProgramBuilder b = builder();
    KernelSum sum(b);
    const Value shape = morph(b, b.constant(time)), weight = b.kernelWeight(shape, 500);
    sum.add(weight);
    Value root = sum.end(0.2f, 1000);
    if (readers_of == 1) root = b.binary(Op::minimum, root, weight);
    if (readers_of == 2) root = b.binary(Op::minimum, root, shape);
    tapes.of(b, root);
    return tapes;
  };
  const Tapes fused = summed(0.25f, 0);
  CHECK(fused.count(Op::kernel) + fused.count(Op::morph) + fused.count(Op::constant) == 0);
  CHECK(fused.first(Op::sum_add).weighs);
  CHECK(fused.first(Op::sum_add).morphs);
  CHECK(fused.first(Op::sum_add).by == 0.25f);
  CHECK(summed(0.25f, 1).count(Op::kernel) == 1);
  CHECK(summed(0.25f, 1).count(Op::morph) == 1);
  CHECK(summed(0.25f, 2).count(Op::kernel) == 0);
  CHECK(summed(0.25f, 2).count(Op::morph) == 1);
  // If the amount of a morph is at most 0 or at least 1, pruning may remove one of its two shapes. Pruning needs the
  // morph as an instruction of its own, so such a morph is not merged into the sum.
  for (const float end : {-0.5f, 0.0f, 1.0f, 2.0f}) {
    CAPTURE(end);
    CHECK(summed(end, 0).count(Op::morph) == 1);
    CHECK(summed(end, 0).first(Op::sum_add).weighs);
    CHECK_FALSE(summed(end, 0).first(Op::sum_add).morphs);
  }
}

TEST_CASE("every value of a tape is made before it is read, in a slot that nobody else has", "[tape]") {
  constexpr uint32_t kSeed = 20'260'101;
  for (uint32_t round = 0; round < rounds(300); ++round) {
    std::mt19937 random(kSeed + round);
    RandomProgramOptions options;
    options.depth = static_cast<int>(round % 5);
    const FieldProgram program = randomProgram(random, options);
    TapeScratch scratch(std::pmr::get_default_resource());
    if (!scheduleTape(program.view(), scratch)) continue;
    CAPTURE(kSeed + round);
    std::vector<size_t> last(scratch.values.size());
    for (size_t i = 0; i < scratch.nodes.size(); ++i) {
      TapeScratch::forEachValue(scratch.nodes[i], [&](size_t v) { last[v] = i; });
    }
    std::set<size_t> made;
    size_t wrong = 0;
    for (size_t i = 0; i < scratch.nodes.size(); ++i) {
      const Node& n = scratch.nodes[i];
      for (const int32_t v : {n.a, n.b, n.c}) wrong += v >= 0 && !made.count(static_cast<size_t>(v)) ? 1u : 0u;
      for (const int32_t v : {n.dst, n.second}) {
        if (v < 0 || !made.insert(static_cast<size_t>(v)).second) continue;
        const int32_t slot = scratch.values[static_cast<size_t>(v)].slot;
        wrong += slot < 0 || slot >= static_cast<int32_t>(kTapeSlots) ? 1u : 0u;
        for (const size_t other : made) {
          const bool lives = other != static_cast<size_t>(v) && last[other] > i;
          wrong += lives && scratch.values[other].slot == slot ? 1u : 0u;
        }
      }
    }
    CHECK(wrong == 0);
  }
}
