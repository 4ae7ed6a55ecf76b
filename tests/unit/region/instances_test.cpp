// Tests the uses of a rule, each of which is derived alone.

#include <algorithm>
#include <set>

#include "derive/chunk_ops.h"
#include "metrics_fixture.h"

using namespace sgm;
using namespace sgm::test;

namespace {

/// Lower layers that must not be queried.
class NoLayers final : public LowerLayers {
 public:
  bool solid(uint32_t, Int3) const override { return false; }
};

std::vector<RuleInstance> instancesOf(const Program& program, std::string_view rule, const DeriveLimits& limits = {}) {
  Result<std::vector<RuleInstance>> found = deriveInstances(program, ParameterValues::defaults(program), 7, 0, {},
                                                            program.findRule(rule), NoLayers(), limits);
  INFO((found ? "" : found.error().message));
  REQUIRE(found);
  return std::move(*found);
}

size_t leaves(const RuleInstance& instance) {
  return static_cast<size_t>(std::count_if(instance.chunk.shapes.begin(), instance.chunk.shapes.end(),
                                           [](const Shape& s) { return s.child_count == 0; }));
}

std::string recursion() {
  return "sgm 1; start A; rule A { Twig(3); }\n"
         "rule Twig(n) when n > 0 { sphere(1m); repeat 2 at(3m, 0m, 0m) { Twig(n - 1); } }\n"
         "rule Twig(n) else { box(1m); }\n";
}

}  // namespace

TEST_CASE("uses of a rule come one by one, with what is below them alone", "[metrics][derive]") {
  const auto program = compiled(
      "sgm 1; start A; rule A { box(9m); at(1m, 2m, 3m) B; cut { at(-2m, 0m, 0m) B; } "
      "union smooth 1m { at(0m, 4m, 0m) B; sphere(1m); } } rule B { sphere(1m); at(1m, 0m, 0m) sphere(0.5m); "
      "anchor spawn; }");
  const std::vector<RuleInstance> uses = instancesOf(*program, "B");
  REQUIRE(uses.size() == 3);
  CHECK(uses[0].origin == Int3{kMetre, 2 * kMetre, 3 * kMetre});
  CHECK(uses[1].origin == Int3{-2 * kMetre, 0, 0});
  CHECK(uses[2].origin == Int3{0, 4 * kMetre, 0});
  CHECK(uses[0].path == "A/B[0]");
  CHECK(uses[2].path == "A/B[2]");
  for (const RuleInstance& use : uses) {
    CHECK(use.bounded);
    REQUIRE(use.chunk.groups.size() == 2);
    CHECK(leaves(use) == 2);
    CHECK(use.chunk.shapes.size() == 2);
    for (const Group& g : use.chunk.groups) CHECK_FALSE(g.cut);
    REQUIRE(use.chunk.anchors.size() == 1);
    CHECK(use.chunk.anchors[0].frame.origin == use.origin);
  }
}

TEST_CASE("uses within uses repeat what is below them", "[metrics][derive]") {
  const auto program = compiled(recursion());
  std::vector<RuleInstance> uses = instancesOf(*program, "Twig");
  CHECK(uses.size() == 15);
  CHECK(leaves(uses[0]) == 15);
  CHECK(leaves(uses[1]) == 7);
  CHECK(leaves(uses.back()) == 1);
  // The start rule has one use, which is the whole cell.
  const std::vector<RuleInstance> start = instancesOf(*program, "A");
  REQUIRE(start.size() == 1);
  const Result<GrammarChunk> cell = deriveCell(*program, ParameterValues::defaults(*program), 7, 0, {}, NoLayers());
  REQUIRE(cell);
  CHECK(hashChunk(start[0].chunk) == hashChunk(*cell));
  CHECK(instancesOf(*compiled("sgm 1; start A; rule A { } rule B { sphere(1m); }"), "B").empty());

  DeriveLimits limits;
  limits.shapes = 30;  // less than the 49 shapes that all copies have together
  const Result<std::vector<RuleInstance>> many = deriveInstances(*program, ParameterValues::defaults(*program), 7, 0,
                                                                 {}, program->findRule("Twig"), NoLayers(), limits);
  REQUIRE_FALSE(many);
  CHECK(many.error().code == Code::limit);
  CHECK_FALSE(deriveInstances(*program, ParameterValues::defaults(*program), 7, 0, {}, 99, NoLayers()));
}

TEST_CASE("a start rule that only cuts the domain is what it cuts", "[metrics][derive]") {
  const auto program = compiled(
      "sgm 1; domain infinite solid; layer l cell 32m reach 8m { start A; } "
      "rule A { cut { at(8m, 8m, 8m) B; } } rule B { displace 0.5m*p.x/1m amp 0.5m { C; } } rule C { sphere(3m); }");
  for (const char* rule : {"A", "B", "C"}) {
    INFO(rule);
    const std::vector<RuleInstance> uses = instancesOf(*program, rule);
    REQUIRE(uses.size() == 1);
    REQUIRE(uses[0].chunk.groups.size() == 1);
    CHECK_FALSE(uses[0].chunk.groups[0].cut);
    // Shapes and expressions around the call of the rule are left out.
    CHECK(uses[0].chunk.shapes.size() == (rule[0] == 'C' ? 1 : 2));
    CHECK(uses[0].chunk.exprs.empty() == (rule[0] == 'C'));
  }
  const auto both = compiled(
      "sgm 1; domain infinite; layer l cell 32m reach 8m { start A; } "
      "rule A { sphere(3m); at(1m, 0m, 0m) { sphere(2m); } }");
  CHECK(instancesOf(*both, "A")[0].chunk.groups.size() == 2);
}

TEST_CASE("a use without a bound says so", "[metrics][derive]") {
  const auto program =
      compiled("sgm 1; start A; rule A { meet { sphere(3m); Half; } } rule Half { halfspace(below 0m); }");
  const std::vector<RuleInstance> uses = instancesOf(*program, "Half");
  REQUIRE(uses.size() == 1);
  CHECK_FALSE(uses[0].bounded);
  CHECK(uses[0].chunk.groups.empty());
}
