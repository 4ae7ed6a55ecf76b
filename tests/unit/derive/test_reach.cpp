// Tests what is proven about layers (their reach, and the levels at which they are visible) against the results of
// derivation.

#include <algorithm>
#include <limits>

#include "catch.h"
#include "derive/coarse_chunk.h"
#include "derive_fixture.h"
#include "random_rules.h"
#include "rounds.h"

using namespace sgm;

namespace {

/// Random parameter values: within the declared ranges, and for every second seed at the ends of the ranges. Parameters
/// without a range get any values.
ParameterValues randomValues(const Program& program, uint64_t seed) {
  ParameterValues values = ParameterValues::defaults(program);
  for (size_t i = 0; i < program.params.size(); ++i) {
    const Param& param = program.params[i];
    double unit = PathKey{seed}.unit(i);
    if (seed % 2 == 0) unit = unit < 0.5 ? 0 : 1;
    double v = param.has_range ? param.low + (param.high - param.low) * unit : 100 * unit - 50;
    if (param.whole) v = std::floor(v + 0.5);
    values.values[i] = v;
  }
  return values;
}

/// The largest cell size at which a shape may be visible.
int32_t coarsestCell(const GrammarChunk& chunk, uint32_t index) {
  const Shape& s = chunk.shapes[index];
  int32_t most = s.child_count == 0 ? std::numeric_limits<int32_t>::max() : 0;
  for (uint32_t i = 0; i < s.child_count; ++i)
    most = std::max(most, coarsestCell(chunk, chunk.children[s.first_child + i]));
  return s.detail > 0 ? std::min(most, s.detail) : most;
}

/// Checks that all shapes of a cell lie within the proven bound, and that no shape was left out for exceeding its
/// reach.
int checkCell(const Program& program, const ParameterValues& values, uint64_t seed, Int3 cell) {
  const Result<GrammarChunk> chunk = deriveCell(program, values, seed, 0, cell, Ceiling(0));
  if (!chunk) return 0;  // the cell exceeds the limits of derivation
  for (const DeriveNote& note : chunk->notes) {
    INFO(note.message << " in " << note.path << " at " << note.line << ":" << note.column);
    CHECK(note.message.find("may pass") == std::string::npos);
    CHECK(note.message.find("has no bound") == std::string::npos);
    CHECK(note.message.find("proven bound") == std::string::npos);
  }
  const Layer& layer = program.layers[0];
  CHECK((chunk->anchors.empty() || layer.anchors));
  for (const Group& group : chunk->groups) {
    for (int axis = 0; axis < 3; ++axis) {
      const int64_t base = isWhole(layer) ? 0 : int64_t{cell[axis]} * layer.cell[axis];
      CAPTURE(axis, group.root);
      CHECK(int64_t{group.bounds.lo[axis]} - base >= int64_t{layer.bound.lo[axis]} - kReachSlack);
      CHECK(int64_t{group.bounds.hi[axis]} - base <= int64_t{layer.bound.hi[axis]} + kReachSlack);
    }
    CHECK(coarsestCell(*chunk, group.root) <= layer.coarsest_cell);
  }
  return static_cast<int>(chunk->groups.size());
}

}  // namespace

TEST_CASE("what is proven holds all that is derived", "[costly]") {
  int proven = 0, groups = 0, fine = 0, edited = 0;
  const int programs = static_cast<int>(rounds(1200));
  for (uint64_t seed = 1; seed <= static_cast<uint64_t>(programs); ++seed) {
    RandomRules rules(seed);
    std::string text = rules.program(seed % 2 == 0);
    if (seed % 3 == 0) text += rules.edits();
    const CompileResult result = compileGrammar(text, "test.sgm");
    if (!result.program) {
      for (const Diagnostic& d : result.diagnostics) {
        INFO(text << "\n" << renderDiagnostics(result));
        if (d.severity == Severity::error)
          CHECK((d.code == "reach" || d.message.find("a cut of the domain") != std::string::npos));
      }
      continue;
    }
    const Program& program = *result.program;
    if (!program.layers[0].proven) continue;
    ++proven;
    edited += seed % 3 == 0;
    fine += program.layers[0].coarsest_cell < std::numeric_limits<int32_t>::max();
    for (uint64_t world = 1; world <= 4; ++world) {
      INFO("seed " << seed << ", world " << world << "\n" << text);
      const bool whole = isWhole(program.layers[0]);
      Int3 cell = whole ? Int3{} : Int3{static_cast<int32_t>(world) - 2, 0, 1};
      // This cell is near the ends of the world, where floats have the least precision.
      if (!whole && world == 4) cell = {8180, -8180, 8180};
      groups += checkCell(program, randomValues(program, seed * 8 + world), world, cell);
    }
  }
  INFO(proven << " proven, " << groups << " groups");
  CHECK(edited > programs / 24);
  CHECK(proven > programs / 4);
  CHECK(groups > programs * 5 / 2);
  CHECK(fine > programs / 24);
}

TEST_CASE("what passes its reach, its domain or every bound is left out whole", "[notes]") {
  const auto far = compiled(
      "sgm 1; domain infinite; layer main cell 64m reach 8m { start Main; }\n"
      "rule Main { Faulty; Sound; }\nrule Faulty { at(rand(-60m, 60m), 0m, 0m) sphere(1m); }\n"
      "rule Sound { at(9m, 9m, 9m) sphere(1m); }");
  int noted = 0;
  for (uint64_t seed = 0; seed < 40; ++seed) {
    CAPTURE(seed);
    const GrammarChunk chunk = derived(*far, {}, seed);
    CHECK(chunk.groups.size() + chunk.notes.size() == 2);
    for (const DeriveNote& note : chunk.notes) {
      ++noted;
      CHECK(note.path == "main(0, 0, 0)/Main/Faulty[0]");
      CHECK(note.message.starts_with("this shape may pass the reach of its cell by "));
      CHECK(note.message.ends_with(" m; it is left out whole: raise `reach` or make it smaller"));
    }
  }
  CHECK(noted > 5);

  const auto boxed = compiled(
      "sgm 1; domain finite box(8m); start Main;\nrule Main { Faulty; sphere(2m); }\n"
      "rule Faulty { sphere(rand(3m, 9m)); }");
  noted = 0;
  for (uint64_t seed = 0; seed < 40; ++seed) {
    CAPTURE(seed);
    const GrammarChunk chunk = derived(*boxed, {}, seed);
    CHECK(chunk.groups.size() + chunk.notes.size() == 2);
    for (const DeriveNote& note : chunk.notes) {
      ++noted;
      CHECK(note.path == "Main/Faulty[0]");
      CHECK(note.message.starts_with("this shape may pass the domain's box by "));
      CHECK(note.message.ends_with(" m; it is left out whole: enlarge the box or make it smaller"));
    }
  }
  CHECK(noted > 5);

  const auto large = compiled(
      "sgm 1; domain infinite; layer main cell 1024m reach 2100m { start Main; }\n"
      "rule Main { at(1900m, 0m, 0m) sphere(200m); at(-1900m, 0m, 0m) sphere(200m); }");
  // The world's cells have coordinates from -2048 to 2046; these two cells are not outermost.
  for (const Int3 cell : {Int3{2045, 0, 0}, Int3{-2045, 0, 0}}) CHECK(derived(*large, cell).notes.empty());
  for (const Int3 cell : {Int3{2046, 0, 0}, Int3{-2048, 0, 0}}) {
    const GrammarChunk outermost = derived(*large, cell);
    CHECK(outermost.groups.size() == 1);
    REQUIRE(outermost.notes.size() == 1);
    CHECK(outermost.notes[0].message ==
          "this shape may pass the end of the world, about 2,097 km from the origin; it is left out whole");
  }

  // The proof of reach refuses shapes without a bound. Here, a program is changed after the proof: derivation must
  // leave the shape out.
  const auto tame = compiled(
      "sgm 1; domain infinite; layer main cell 64m reach 8m { start Main; }\n"
      "rule Main { Faulty; sphere(2m); }\nrule Faulty { displace 1m*p.x/1m amp 1m { sphere(1m); } }");
  Program wild = *tame;
  for (StmtNode& s : wild.ast.stmts)
    if (s.kind == StmtKind::displace) s.amount = kNoId;
  const GrammarChunk chunk = derived(wild);
  CHECK(chunk.groups.size() == 1);
  REQUIRE(chunk.notes.size() == 1);
  CHECK(chunk.notes[0].path == "main(0, 0, 0)/Main/Faulty[0]");
  CHECK(chunk.notes[0].message ==
        "this shape has no bound, so no cell can own it; meet it with a box, or give the displacement an amplitude");
}

TEST_CASE("of what passes its reach, parts that levels leave out go alone, at each level that would show them",
          "[notes]") {
  const char* const near[] = {
      "union smooth 1m { sphere(2m); detail 30cm at(90m, 0m, 0m) sphere(1m); detail 30cm box(1m); }",
      "{ sphere(2m); detail 30cm at(90m, 0m, 0m) sphere(1m); detail 30cm box(1m); cut box(1m); }",
      "displace 0.1m*fractal(1m) { sphere(2m); detail 30cm at(90m, 0m, 0m) sphere(1m); }",
      "displace 0.1m*fractal(1m) { sphere(2m); Part(1); }",
  };
  for (const char* statement : near) {
    INFO(statement);
    Program program = *compiled(
        "sgm 1; domain infinite; layer main cell 64m reach 64m { start Main; }\nrule Main { Faulty; }\nrule Faulty { " +
        std::string(statement) +
        " }\nrule Part(r) { at(90m*r, 0m, 0m) sphere(1m); }\nrule Part(r) lod 1m { sphere(1m); }");
    program.layers[0].reach = 8 * kUnitsPerMetre;
    const GrammarChunk chunk = derived(program);
    REQUIRE(chunk.notes.size() == 1);
    CHECK(chunk.notes[0].message.starts_with("this shape may pass the reach of its cell by "));
    CHECK(chunk.notes[0].message.ends_with(" m; it is left out whole: raise `reach` or make it smaller"));
    REQUIRE(chunk.groups.size() == 1);
    CHECK(chunk.groups[0].bounds.hi.x < 4 * kUnitsPerMetre);
    Result<GrammarChunk> far = deriveCoarseCell(program, {}, 7, 0, {}, 2 * kUnitsPerMetre, Ceiling(1 << 30));
    REQUIRE(far);
    CHECK(far->groups.size() == 1);
    CHECK(coarseChunk(chunk, 2 * kUnitsPerMetre).groups.size() == 1);
  }
}

#ifdef NDEBUG
TEST_CASE("a shape beyond the bound that was proven of its layer is noted, and ends there", "[notes]") {
  // The proven bound is replaced by a smaller one. A build with assertions would abort at a shape beyond its bound.
  const auto program = compiled(
      "sgm 1; units m; domain infinite; layer main cell 64m reach 16m { start Main; } rule Main { sphere(4m); }");
  Program falsified = *program;
  falsified.layers[0].bound = {{-1024, -1024, -1024}, {1024, 1024, 1024}};
  const GrammarChunk chunk = derived(falsified);
  REQUIRE(chunk.notes.size() == 1);
  const std::string& message = chunk.notes[0].message;
  CHECK(message.find("this shape passes the proven bound of its layer by") == 0);
  CHECK(message.find("m and ends there: a bug in the library, please report it") != std::string::npos);
  REQUIRE(chunk.groups.size() == 1);
  CHECK(chunk.groups[0].bounds.hi.x < 4 * kUnitsPerMetre);
}
#endif
