// Tests the evaluation of lists of primitives and of boxes of lattice points, for every instruction set. The reference
// evaluates one instruction and one point after another.

#include <random>

#include "backend/cpu/instruction_sets.h"
#include "catch.h"
#include "field/builder.h"
#include "one_by_one.h"
#include "random_programs.h"
#include "rounds.h"
#include "seed.h"

using namespace sgm;

namespace {

class ListMaker {
 public:
  explicit ListMaker(std::mt19937& random) : random_(random) {}

  int32_t within(int32_t lo, int32_t hi) {
    return lo + static_cast<int32_t>(random_() % static_cast<uint32_t>(hi - lo + 1));
  }
  float size() { return static_cast<float>(within(300, 4000)); }
  Int3 place() {
    const int32_t x = within(-9000, 9000), y = within(-9000, 9000);
    return {x, y, within(-9000, 9000)};
  }
  Value primitive(int kind) {
    const Int3 at = place();
    Frame frame;
    frame.origin = at;
    const float a = size(), b = size(), c = size();
    const auto label = static_cast<uint32_t>(within(1, 9));
    switch (kind) {
      case 0:
        return builder_.sphere(at, a, label);
      case 1:
        return builder_.box(frame, a, b, c, label);
      case 2:
        return builder_.capsule(at, a, -b, c, 300, label);
      case 3:
        return builder_.truncone(frame, a, b, c, label);
      default:
        return builder_.torus(frame, 2 * a, b, label);  // the evaluators have no special code for lists of tori
    }
  }
  /// Adds runs of primitives of one kind, so that lists of equal instructions begin, end and follow each other.
  template <class Add>
  void some(const Add& add) {
    for (int runs = within(1, 3); runs > 0; --runs) {
      const int kind = within(0, 4);
      for (int n = within(1, 5); n > 0; --n) add(kind);
    }
  }
  void group() {
    const bool cut = within(0, 3) == 0;
    Value root;
    switch (within(0, 3)) {
      case 0: {
        KernelSum sum(builder_);
        some([&](int kind) {
          sum.add(kind < 3 ? builder_.blobWeight(place(), size(), static_cast<uint32_t>(kind))
                           : builder_.kernelWeight(primitive(kind), size()));
        });
        root = sum.end(0.25f, size());
        break;
      }
      case 1: {
        RoundUnion round(builder_, size());
        some([&](int kind) { round.add(primitive(kind)); });
        root = round.end();
        break;
      }
      default:
        root = primitive(within(0, 4));
    }
    (void)builder_.group(root, IntBox::everything(), ++layer_, cut);
  }
  FieldProgram finish() {
    FieldProgram program = builder_.finish();
    // A quarter of the groups are guarded by their bounds. The others are like most groups after pruning: all samples
    // are known to lie inside the group's bounds.
    for (ProgramGroup& g : program.groups) g.guarded = within(0, 3) == 0;
    return program;
  }

 private:
  std::mt19937& random_;
  ProgramBuilder builder_{256, false, 0};
  uint32_t layer_ = 0;
};

FieldProgram listedProgram(std::mt19937& random) {
  ListMaker maker(random);
  for (int groups = maker.within(1, 6); groups > 0; --groups) maker.group();
  return maker.finish();
}

/// A plane displaced by noise. coarse: all periods are longer than three lattice steps; otherwise, octaves may be finer
/// than a step.
FieldProgram noisyProgram(std::mt19937& random, const LatticeBox& box, bool coarse) {
  ProgramBuilder builder(1 + static_cast<int32_t>(random() % 1024), false, 0);
  Frame frame;
  frame.origin = box.origin;
  Value height = builder.constant(0);
  for (auto k = 1 + random() % 3; k > 0; --k) {
    NoiseSpec spec;
    for (int axis = 0; axis < 3; ++axis) spec.origin[axis] = static_cast<int32_t>(random());
    if (random() % 2 == 0) spec.origin = box.origin;
    spec.period = 1 + box.step / 2 + static_cast<int32_t>(random() % static_cast<uint32_t>(40 * box.step));
    if (coarse) spec.period += 3 * box.step;
    spec.octaves = coarse ? 1 : 1 + static_cast<uint32_t>(random() % 6);
    spec.seed = static_cast<uint32_t>(random());
    height = builder.binary(Op::add, height, builder.noise(spec, spec.octaves));
  }
  height = builder.binary(Op::multiply, height, builder.constant(static_cast<float>(box.step) / 256));
  const Value root = builder.binary(Op::displace, builder.halfspace(frame, 3), height);
  constexpr int32_t kEnd = 2147483647;
  REQUIRE(builder.group(root, {{-kEnd, -kEnd, -kEnd}, {kEnd, kEnd, kEnd}}, 0, false));
  return builder.finish();
}

}  // namespace

TEST_CASE("lists of primitives give the bits of one instruction after the other") {
  const uint32_t seed = testSeed();
  CAPTURE(seed);
  std::mt19937 random(seed);
  unsigned showing = 0;
  for (unsigned round = 0; round < rounds(60); ++round) {
    CAPTURE(round);
    const FieldProgram program = listedProgram(random);
    const PointSet points = randomPoints(random, {}, 12'000, random() % (2 * kEvalBlock + 2));
    const Evaluated expected = evaluate(oneByOneKernels(), program.view(), points.points());
    showing += shows(expected);
    for (const InstructionSet& set : instructionSets()) {
      CAPTURE(set.kernels->name);
      if (set.runs_here) CHECK(differentBits(evaluate(*set.kernels, program.view(), points.points()), expected) == 0);
    }
  }
  CHECK(showing * 2 > rounds(60));
}

TEST_CASE("a box of a lattice is evaluated as its points are") {
  const uint32_t seed = testSeed();
  CAPTURE(seed);
  std::mt19937 random(seed);
  for (unsigned round = 0; round < rounds(120); ++round) {
    CAPTURE(round);
    LatticeBox box;
    for (int axis = 0; axis < 3; ++axis) {
      // Boxes of 8 or 9 points along each axis, like the bricks into which the mesher divides a chunk, or of 1 to 16
      // points, the most that a block can hold.
      box.size[static_cast<size_t>(axis)] = round % 3 == 0 ? 1 + random() % 16 : 8 + random() % 2;
      box.origin[axis] = static_cast<int32_t>(random() % 12000) - 9000;
    }
    box.step = 1 << random() % 12;
    const unsigned kind = round % 4;
    if (kind > 1 && round % 5 == 0) {  // the box ends at the largest coordinate
      for (int axis = 0; axis < 3; ++axis)
        box.origin[axis] = 2147483647 - static_cast<int32_t>(box.size[static_cast<size_t>(axis)]) * box.step;
    }
    const FieldProgram program = kind == 0   ? listedProgram(random)
                                 : kind == 1 ? randomProgram(random, {})
                                             : noisyProgram(random, box, kind == 2);
    PointSet points;
    for (size_t k = 0; k < box.size[2]; ++k) {
      for (size_t j = 0; j < box.size[1]; ++j) {
        for (size_t i = 0; i < box.size[0]; ++i) {
          points.x.push_back(box.origin.x + static_cast<int32_t>(i) * box.step);
          points.y.push_back(box.origin.y + static_cast<int32_t>(j) * box.step);
          points.z.push_back(box.origin.z + static_cast<int32_t>(k) * box.step);
        }
      }
    }
    EvalScratch scratch;
    std::vector<int32_t> expected(points.x.size());
    oneByOneKernels().samples(program.view(), points.points(), scratch, expected.data());
    // The samples are a part of a larger array, whose other samples must stay unchanged.
    constexpr int32_t kOther = 77;
    const size_t row = box.size[0] + random() % 3, plane = row * box.size[1] + random() % 5, first_bit = random() % 20;
    for (const InstructionSet& set : instructionSets()) {
      if (!set.runs_here) continue;
      CAPTURE(set.kernels->name);
      std::vector<int32_t> q(plane * box.size[2], kOther);
      std::vector<uint64_t> signs(box.size[1] * box.size[2], uint64_t{1} << 63);
      set.kernels->box(program.view(), box, scratch, {q.data(), row, plane, signs.data(), box.size[1], first_bit});
      bool same = true, untouched = true;
      for (size_t k = 0; k < box.size[2]; ++k) {
        for (size_t at = 0; at < plane; ++at) {
          const size_t i = at % row, j = at / row;
          const int32_t got = q[k * plane + at];
          if (i >= box.size[0] || j >= box.size[1]) {
            untouched = untouched && got == kOther;
            continue;
          }
          const int32_t want = expected[i + box.size[0] * (j + box.size[1] * k)];
          const bool solid = (signs[j + k * box.size[1]] >> (first_bit + i) & 1) != 0;
          same = same && got == want && solid == (want < 0);
        }
      }
      CHECK(same);
      CHECK(untouched);
    }
  }
}
