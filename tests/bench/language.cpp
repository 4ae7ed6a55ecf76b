// What the language costs: compiling a grammar of 2,000 lines, and deriving a city, block by block.
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
#include "stream/world_field.h"

namespace {

using namespace sgm;

constexpr int kHouses = 330;  // of six lines each

int fail(const std::string& message) {
  std::fprintf(stderr, "sgm_bench_language: %s\n", message.c_str());
  return 1;
}

/// Houses with guards, weights, displacements, cuts, loops and labels, each with two heads, and a street of them all.
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

void print(const char* what, const bench::Times& times) {
  std::printf("%-52s %8.2f ms (%.2f to %.2f, %d runs)\n", what, times.median, times.least, times.most, times.runs);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) return fail("give a grammar of a city, such as samples/grammars/city.sgm");
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
  constexpr int32_t kBlocks = 4;  // along each axis
  size_t shapes = 0, bytes = 0;
  std::string error;
  const bench::Times deriving = bench::timed(1, runs, [&] {
    WorldFieldSettings settings;
    settings.program = city.program;
    settings.parameters = ParameterValues::defaults(*city.program);
    const WorldField world(std::move(settings), std::pmr::get_default_resource());
    shapes = bytes = 0;
    for (uint32_t layer = 0; layer < city.program->layers.size(); ++layer) {
      for (int32_t i = 0; i < kBlocks * kBlocks; ++i) {
        const auto cell = world.cell(layer, {i % kBlocks, 0, i / kBlocks});
        if (!cell) {
          error = cell.error().message;
          return;
        }
        shapes += (*cell)->chunk.shapes.size();
        bytes += (*cell)->bytes;
      }
    }
  });
  if (!error.empty()) return fail(error);
  print(("deriving " + std::to_string(kBlocks * kBlocks) + " blocks, " + std::to_string(shapes) + " shapes").c_str(),
        deriving);
  std::printf("%-52s %8.2f ms\n", "10,000 of these shapes", deriving.median * 1e4 / static_cast<double>(shapes));
  std::printf("%-52s %8.2f KiB\n", "memory of a block", static_cast<double>(bytes) / kBlocks / kBlocks / 1024);
  return 0;
}
