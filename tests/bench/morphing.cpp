// Measures the savings by morphic rules: nodes, operations and time of a scene whose shapes are halfway between two
// shapes, for several ways of writing the same scene.
//
//   sgm_bench_morphing [RUNS]
//
// According to the paper (equations in its section 8), morphing by operations on both shapes takes 41 operations per
// point, and a morphic production collapses these to 14, a third.

#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "backend/cpu/instruction_sets.h"
#include "field/evaluate.h"
#include "float_operations.h"
#include "grammar/compile.h"
#include "measure.h"
#include "world/world_field.h"

namespace {

using namespace sgm;

struct Way {
  std::string name;
  std::string body;  ///< source text of the rule Body, in which this variant writes the shape halfway between the two
                     ///< shapes
};

constexpr const char* kHead =
    "sgm 1; units m; domain finite box(64m, 64m, 64m); start Row; param t = 0.5 in 0..1;\n"
    "rule Row { for i in 0..64 { at(8m*(i - 8*floor(i/8)) - 28m, rand(-28m, 28m), 8m*floor(i/8) - 28m) Body; } }\n";

std::vector<Way> ways() {
  const std::string pile =
      "rule Pile { union smooth 0.3m { repeat 8 rot(y, 45deg) at(1.2m, 0m, 0m) sphere(0.9m); } }\n";
  const std::string mixing = "field mixing = t + 0.2*smoothstep(-90m, 90m, p.x) - 0.1;\n";
  return {
      {"a ball and a box: classic, both united", "rule Body { sphere(2m); box(3.2m); }"},
      {"as fields, t known at samples only", mixing + "rule Body { morph(sphere(2m), box(3.2m), mixing); }"},
      {"morphic, linear", "morphic Body : sphere(2m) -> box(3.2m) by t;"},
      {"morphic, by power", "morphic Body : sphere(2m) -> box(3.2m) by t power;"},
      {"a pile of eight and a ball: classic, both united", pile + "rule Body { Pile; sphere(2m); }"},
      {"as fields, t known at samples only", pile + mixing + "rule Body { morph(Pile, sphere(2m), mixing); }"},
      {"morphic, linear", pile + "morphic Body : Pile -> sphere(2m) by t;"},
  };
}

struct Cost {
  size_t nodes = 0, instructions = 0;
  double operations = 0, nanoseconds = 0;
};

bool fail(const std::string& message) {
  std::fprintf(stderr, "sgm_bench_morphing: %s\n", message.c_str());
  return false;
}

bool costOf(const std::string& text, double t, int runs, Cost& cost) {
  const CompileResult compiled = compileGrammar(text, "morphing.sgm");
  if (!compiled.program) return fail(renderDiagnostics(compiled));
  WorldFieldSettings settings;
  settings.program = compiled.program;
  settings.parameters = ParameterValues::defaults(*compiled.program);
  if (const auto set = settings.parameters.set(*compiled.program, "t", t); !set) return fail(set.error().message);
  settings.finest_cell = 256;
  const WorldField world(std::move(settings), std::pmr::get_default_resource());
  const auto cell = world.cell(0, {0, 0, 0});
  if (!cell) return fail(cell.error().message);
  cost.nodes = (*cell)->chunk.shapes.size();
  constexpr int32_t kHalf = 32 * kUnitsPerMetre;
  const auto program = world.compile({{-kHalf, -kHalf, -kHalf}, {kHalf, kHalf, kHalf}}, 0);
  if (!program) return fail(program.error().message);
  cost.instructions = (*program)->instrs.size();

  // Sample a brick of points around the middle of each shape, as meshing does, so that no shape is skipped because its
  // bounding box is far away.
  std::vector<int32_t> x, y, z;
  for (const ProgramGroup& group : (*program)->groups) {
    const IntBox& box = group.influence;
    for (int i = 0; i < 512; ++i) {
      x.push_back((box.lo.x / 2 + box.hi.x / 2) + 256 * (i % 8 - 4));
      y.push_back((box.lo.y / 2 + box.hi.y / 2) + 256 * (i / 8 % 8 - 4));
      z.push_back((box.lo.z / 2 + box.hi.z / 2) + 256 * (i / 64 - 4));
    }
  }
  std::vector<int32_t> q(x.size()), counted(x.size());
  const Points points{x.data(), y.data(), z.data(), x.size()};
  EvalScratch scratch;
  bench::takeOperationCount();
  constexpr size_t kAtOnce = 64;  // number of samples per call; small, because the counting evaluator keeps every
                                  // operation of a call in memory
  for (size_t i = 0; i < x.size(); i += kAtOnce) {
    const Points some{x.data() + i, y.data() + i, z.data() + i, kAtOnce};
    bench::floatCountingKernels().samples((*program)->view(), some, scratch, counted.data() + i);
  }
  const bench::OperationCount operations = bench::takeOperationCount();
  cost.operations = static_cast<double>(operations.arithmetic + operations.others) / static_cast<double>(x.size());
  const bench::Times times =
      bench::timed(2, runs, [&] { bestKernels().samples((*program)->view(), points, scratch, q.data()); });
  cost.nanoseconds = times.median * 1e6 / static_cast<double>(x.size());
  return q == counted || fail("two evaluators differ");
}

}  // namespace

int main(int argc, char** argv) {
  const int runs = argc > 1 ? std::atoi(argv[1]) : 15;
  if (runs < 1) return fail("RUNS is a whole number from 1"), 2;
  bench::pin(1);
  std::printf("| 64 times | t | nodes | instructions | operations a sample | ns a sample | of what is united |\n");
  std::printf("|---|---|---|---|---|---|---|\n");
  double united = 0;
  for (const Way& way : ways()) {
    const bool classic = way.name.find("classic") != std::string::npos;
    for (const double t : {0.5, 1.0}) {
      if (classic && t == 1.0) continue;  // the classic evaluation has no parameter t, so measure it only once
      Cost cost;
      if (!costOf(std::string(kHead) + way.body, t, runs, cost)) return 1;
      if (classic) united = cost.operations;
      std::printf("| %s | %s | %zu | %zu | %.0f | %.0f | %.2f |\n", way.name.c_str(),
                  classic    ? ""
                  : t == 1.0 ? "1"
                             : "0.5",
                  cost.nodes, cost.instructions, cost.operations, cost.nanoseconds, cost.operations / united);
    }
  }
  return 0;
}
