// Measures costs of the grammar language: compiling a grammar of 2,000 lines, deriving a city block by block, and
// filling lattices with tiles.
//
//   sgm_bench_language CITY.sgm [RUNS]

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "grammar/compile.h"
#include "measure.h"
#include "world/world_field.h"

namespace {

using namespace sgm;

constexpr int kHouses = 330;  // number of houses in the long grammar

int fail(const std::string& message) {
  std::fprintf(stderr, "sgm_bench_language: %s\n", message.c_str());
  return 1;
}

/// Makes a grammar of houses with guards, weights, displacements, cuts, loops and labels, each in two alternatives, and
/// a street with all houses.
std::string longGrammar() {
  const auto number = [](int i) { return std::to_string(i); };
  std::string text =
      "sgm 1;\nimport \"std/noise.sgm\" as noise;\nparam wet = 0.5 in 0..1;\ndomain infinite axes xz;\n"
      "layer city cell 200m reach 190m { start Main; }\nrule Main {\n";
  for (int i = 0; i < kHouses; ++i)
    text +=
        "  at(" + number(i % 18 * 10) + "m, 0m, " + number(i / 18 * 10) + "m) House" + number(i) + "(rand(3m, 6m));\n";
  text += "}\n";
  for (int i = 0; i < kHouses; ++i) {
    const std::string name = "House" + number(i);
    text += "rule " + name + "(h) when h > 4m {\n  displace noise.fbm(period " + number(1 + i % 5) +
            "m, amp 0.1m) { box(4m, h, " + number(2 + i % 3) +
            "m); }\n  cut { repeat 3 at(0m, 1m, 0m) { at(0.5m, 0m, 0m) box(0.5m, 0.6m, 9m); } }\n  mat brick; tag "
            "\"house." +
            number(i % 7) + "\";\n}\nrule " + name +
            "(h) else { union smooth 0.2m { box(3m, h, 3m); at(y 0.5*h) sphere(min(h, 2m)*(1 + 0.1*wet)); } }\n";
  }
  return text;
}

/// A grammar of castles by wave function collapse, with empty tiles: 12 tiles, in lattices of 16 by 4 by 16 tiles per
/// grammar cell.
const char* const kCastles = R"(sgm 1;
domain infinite axes xz;
layer castles cell 96m reach 96m { start Castle; }
rule Castle {
  size(96m, 24m, 96m) wfc 6m {
    border side meadow or air, bottom ground, top sky;
    meadow 1, side meadow, bottom ground, top sky: { }
    yard 12, side yard, bottom ground, top sky: { }
    house 2 turn, side yard, bottom ground, top storey or attic: { }
    wall 6 turn, front meadow, back yard, left wall or post, right wall or post, bottom ground, top sky: { }
    gate 1 turn, front meadow, back yard, left wall or post, right wall or post, bottom ground, top sky: { }
    corner 1 turn, side meadow, right post meets wall, back post meets wall, bottom ground, top tower: { }
    nook 0.3 turn, side yard, right post meets wall, back post meets wall, bottom ground, top tower: { }
    tower 2, side air, bottom tower, top tower: { }
    spire 1, side air, bottom tower, top sky: { }
    storey 1 turn, side air, bottom storey, top attic: { }
    attic 1 turn, side air, bottom attic, top sky: { }
    sky 30, side air, bottom sky, top sky: box(1m);
  }
}
)";
constexpr double kPlaces = 16 * 4 * 16;

constexpr int32_t kBlocks = 4;  // number of derived grammar cells (city blocks) along each horizontal axis

/// Time and result of deriving 4 by 4 grammar cells of every layer.
struct Derived {
  bench::Times times;
  size_t shapes = 0, bytes = 0;
  std::string error;
};

Derived derived(const std::shared_ptr<const Program>& program, int runs) {
  Derived out;
  out.times = bench::timed(1, runs, [&] {
    WorldFieldSettings settings;
    settings.program = program;
    settings.parameters = ParameterValues::defaults(*program);
    const WorldField world(std::move(settings), std::pmr::get_default_resource());
    out.shapes = out.bytes = 0;
    for (uint32_t layer = 0; layer < program->layers.size(); ++layer) {
      for (int32_t i = 0; i < kBlocks * kBlocks; ++i) {
        const auto cell = world.cell(layer, {i % kBlocks, 0, i / kBlocks});
        if (!cell) {
          out.error = cell.error().message;
          return;
        }
        if (!(*cell)->chunk.notes.empty()) out.error = (*cell)->chunk.notes[0].message;
        out.shapes += (*cell)->chunk.shapes.size();
        out.bytes += (*cell)->bytes;
      }
    }
  });
  return out;
}

void print(const char* what, const bench::Times& times) {
  std::printf("%-52s %8.2f ms (%.2f to %.2f, %d runs)\n", what, times.median, times.least, times.most, times.runs);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) return fail("give a grammar of a city, such as tests/bench/grammars/city.sgm");
  const int runs = argc > 2 ? std::max(1, std::atoi(argv[2])) : 15;
  const std::string houses = longGrammar();
  const auto lines = std::count(houses.begin(), houses.end(), '\n');
  const CompileResult whole = compileGrammar(houses, "houses.sgm");
  if (!whole.program) return fail(renderDiagnostics(whole));
  const bench::Times compiling = bench::timed(2, runs, [&] { (void)compileGrammar(houses, "houses.sgm"); });
  print(("compiling " + std::to_string(lines) + " lines").c_str(), compiling);

  std::ifstream file(argv[1]);
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  const CompileResult city = compileGrammar(text, argv[1]);
  if (!city.program) return fail(renderDiagnostics(city));
  const Derived blocks = derived(city.program, runs);
  if (!blocks.error.empty()) return fail(blocks.error);
  print(("deriving " + std::to_string(kBlocks * kBlocks) + " blocks, " + std::to_string(blocks.shapes) + " shapes")
            .c_str(),
        blocks.times);
  std::printf("%-52s %8.2f ms\n", "10,000 of these shapes",
              blocks.times.median * 1e4 / static_cast<double>(blocks.shapes));
  std::printf("%-52s %8.2f KiB\n", "memory of a block", static_cast<double>(blocks.bytes) / kBlocks / kBlocks / 1024);

  const CompileResult castles = compileGrammar(kCastles, "castles.sgm");
  if (!castles.program) return fail(renderDiagnostics(castles));
  const Derived lattices = derived(castles.program, runs);
  if (!lattices.error.empty()) return fail(lattices.error);
  print(("filling " + std::to_string(kBlocks * kBlocks) + " lattices of 16 x 4 x 16 with 12 tiles").c_str(),
        lattices.times);
  std::printf("%-52s %8.2f million\n", "places a second", kBlocks * kBlocks * kPlaces / lattices.times.median / 1e3);
  return 0;
}
