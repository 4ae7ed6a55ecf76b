// Tests many overrides together, and several overrides with the same address.

#include <set>

#include "derive_fixture.h"

using namespace sgm;

namespace {

const std::string kLayer = "sgm 1; domain infinite;\nlayer net cell 64m reach 128m { start Main; }\n";

/// Numbers of boxes and of spheres among the root shapes of the cell's groups.
std::array<size_t, 2> boxesAndBalls(const GrammarChunk& chunk) {
  std::array<size_t, 2> out{};
  for (const Group& g : chunk.groups) {
    if (chunk.shapes[g.root].kind == ShapeKind::box) ++out[0];
    if (chunk.shapes[g.root].kind == ShapeKind::sphere) ++out[1];
  }
  return out;
}

}  // namespace

TEST_CASE("overrides of one address have draws of their own", "[override]") {
  const std::string rules = kLayer + "rule Main { Ball; }\nrule Ball { tag \"ball\"; sphere(rand(1m, 9m)); }\n";
  for (const std::string& address : {std::string("\"Main/Ball\""), std::string("tag \"ball\"")}) {
    CAPTURE(address);
    const std::string edit = "override " + address;
    const auto program = compiled(rules + edit + " { inner; at(20m, 0m, 0m) inner; sphere(rand(1m, 9m)); }\n" + edit +
                                  " { inner; at(-40m, 0m, 0m) inner; sphere(rand(1m, 9m)); }\n");
    for (int32_t x = 0; x < 8; ++x) {
      const GrammarChunk chunk = derived(*program, {x, 0, 0});
      std::set<float> radii;
      for (const Shape& shape : chunk.shapes) {
        if (shape.kind == ShapeKind::sphere) radii.insert(shape.size[0]);
      }
      // Seven spheres: four copies of the original, two spheres of the lower override, and one of the upper override.
      CHECK(radii.size() == 7);
    }
  }
}

TEST_CASE("what a use costs does not depend on how many overrides there are", "[override]") {
  const std::string rules = kLayer +
                            "rule Main { for i in 0..2000 { Room; } }\n"
                            "rule Room { sphere(1m); Door; }\nrule Door { sphere(2m); }\n";
  std::string edits;
  for (int i = 0; i < 2000; ++i) {
    const std::string door = i % 2 == 0 ? "/Door" : "";
    edits += "override \"Main/Room[" + std::to_string(i) + "]" + door + "\" { box(1m); }\n";
  }
  const auto program = compiled(rules + edits);
  // A thousand rooms keep their sphere, and have a box in place of their door. The other thousand rooms are replaced by
  // a box.
  CHECK(boxesAndBalls(derived(*program, {})) == std::array<size_t, 2>{2000, 1000});

  DeriveLimits limits;
  limits.steps = 100'000;
  const auto plain = compiled(rules);
  for (const Program& each : {std::cref(*plain), std::cref(*program)})
    CHECK(deriveCell(each, ParameterValues::defaults(each), 7, 0, {}, Ceiling(1 << 30), limits));
}

TEST_CASE("of paths that hold for one use, the last is derived, every one by its own way", "[override]") {
  const std::string rules =
      kLayer + "rule Main { A; A; B; }\nrule A { C; C; }\nrule B { C; }\nrule C { torus(2m, 1m); }\n";
  // Each path, and which of the five uses of C it selects, counted in the order of derivation.
  const std::vector<std::pair<std::string, std::set<size_t>>> paths = {
      {"Main/A/C", {0, 1, 2, 3}}, {"Main/A[1]/C", {2, 3}}, {"Main/A/C[1]", {1, 3}},
      {"Main/A[1]/C[1]", {3}},    {"Main/B/C", {4}},       {"Main/B/C[0]", {4}},
  };
  for (size_t mask = 0; mask < 64; ++mask) {
    CAPTURE(mask);
    std::string text = rules;
    std::array<float, 5> radius{};
    for (size_t p = 0; p < paths.size(); ++p) {
      if ((mask >> p & 1) == 0) continue;
      const auto& [path, leads] = paths[p];
      text += "override \"" + path + "\" { sphere(" + std::to_string(p + 1) + "m); }\n";
      for (const size_t use : leads) radius[use] = static_cast<float>((p + 1) * 1024);
    }
    std::vector<float> expected, found;
    for (const float r : radius) {
      if (r > 0) expected.push_back(r);
    }
    const GrammarChunk chunk = derived(*compiled(text), {});
    for (const Group& g : chunk.groups) {
      if (chunk.shapes[g.root].kind == ShapeKind::sphere) found.push_back(chunk.shapes[g.root].size[0]);
    }
    CHECK(found == expected);
  }
}
