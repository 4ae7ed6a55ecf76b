// Tests the results of operators, functions and members: each result becomes the radius of a sphere.

#include <cmath>

#include "derive_fixture.h"

using namespace sgm;

namespace {

/// The radius of `sphere(expression)` in the grammar cell (1, 2, 3). before: statements before the sphere in the same
/// rule.
double radiusOf(const std::string& expression, const std::string& before = {}) {
  const GrammarChunk chunk = derivedRules(
      "let twice(x) = 2*x; let three = 3; rule Main { " + before + " meet { box(9m); sphere(" + expression + "); } }",
      {1, 2, 3});
  INFO(expression);
  REQUIRE(chunk.notes.empty());
  REQUIRE(chunk.groups.size() == 1);
  for (const Shape& s : chunk.shapes)
    if (s.kind == ShapeKind::sphere) return static_cast<double>(s.size[0]) / kUnitsPerMetre;
  FAIL("no sphere");
  return 0;
}

}  // namespace

TEST_CASE("arithmetic, functions and members give their values") {
  const std::pair<const char*, double> cases[] = {
      {"1m + 2m*three - 4m/2", 5},
      {"-(-2m)", 2},
      {"twice(1.5m)", 3},
      {"1m*floor(2.9)", 2},
      {"1m*ceil(2.1)", 3},
      {"1m*fract(2.25)", 0.25},
      {"1m*abs(-3)", 3},
      {"min(2m, 3m)", 2},
      {"max(2m, 3m)", 3},
      {"clamp(9m, 1m, 4m)", 4},
      {"mix(1m, 3m, 25%)", 1.5},
      {"1m*smoothstep(0, 4, 2)", 0.5},
      {"sqrt(9m2)", 3},
      {"1m*pow(2, 3)", 8},
      {"1m*sin(90deg)", 1},
      {"2m*cos(0deg)", 2},
      {"1m*(atan2(1, 1)/45deg)", 1},
      {"length((2m, 3m, 6m))", 7},
      {"vec(1m, 2m, 3m).z", 3},
      {"(2*(1m, 2m, 3m) + (1m, 1m, 1m)).y", 5},
      {"1m*(cell.x + 10*cell.y)", 21},
      {"cell.size.x/16", 4},
      {"cell.center.y/8", 4},
      {"scope.z/32", 2},
  };
  for (const auto& [expression, value] : cases) {
    INFO(expression);
    CHECK(radiusOf(expression) == Approx(value).epsilon(1e-6));
  }
}

TEST_CASE("conditions choose by every comparison and connective") {
  const std::pair<const char*, bool> cases[] = {
      {"1 < 2", true},           {"2 < 2", false},           {"2 <= 2", true},         {"3 <= 2", false},
      {"3 > 2", true},           {"2 > 2", false},           {"2 >= 2", true},         {"1 >= 2", false},
      {"2 == 2", true},          {"2 == 3", false},          {"2 != 3", true},         {"2 != 2", false},
      {"1 < 2 and 2 < 3", true}, {"1 < 2 and 3 < 2", false}, {"2 < 1 or 2 < 3", true}, {"2 < 1 or 3 < 2", false},
      {"not 2 < 1", true},       {"not true", false},        {"chance(1)", true},      {"chance(cell, 0)", false},
      {"chance(cell, 1)", true},
  };
  for (const auto& [condition, holds] : cases) {
    INFO(condition);
    CHECK(radiusOf("if " + std::string(condition) + " then 2m else 3m") == (holds ? 2 : 3));
  }
}

TEST_CASE("the faces of a cell are three, one an axis, with their points on them") {
  const GrammarChunk chunk = derivedRules(
      "rule Main { for f in cell.faces { at(f.point(jitter 1)) sphere(1m + 1m*f.axis); at(f.center) box(1m); } }");
  CHECK(chunk.notes.empty());
  std::array<int, 3> found{};
  for (const Group& group : chunk.groups) {
    const Shape& s = chunk.shapes[group.root];
    if (s.kind != ShapeKind::sphere) continue;
    const int axis = static_cast<int>(std::lround(s.size[0] / 1024.0f)) - 1;
    REQUIRE((axis >= 0 && axis < 3));
    ++found[static_cast<size_t>(axis)];
    CHECK(std::abs(s.frame.origin[axis] - 64 * 1024) <= 1);
  }
  CHECK(found == std::array<int, 3>{1, 1, 1});
}
