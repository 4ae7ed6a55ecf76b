// Tests what is proven about layers (their reach, and the levels at which they are visible) against the results of
// derivation.

#include <algorithm>
#include <limits>

#include "catch.h"
#include "derive_fixture.h"
#include "random_rules.h"
#include "rounds.h"

using namespace sgm;

namespace {

/// Random parameter values within the declared ranges, for every second seed at the ends of the ranges; any values for
/// parameters without a range.
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

/// Checks that the shapes of a cell stay within the proven bound, and that no shape is left out because it exceeds its
/// reach.
int checkCell(const Program& program, const ParameterValues& values, uint64_t seed, Int3 cell) {
  const Result<GrammarChunk> chunk = deriveCell(program, values, seed, 0, cell, Ceiling(0));
  if (!chunk) return 0;  // the cell exceeds the limits of a cell
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
      // Near the ends of the world, where floats have the least precision.
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
