// Tests how the scope (the local frame and box) affects what is derived in it: displacements and warps in a scaled
// scope, cuts, and finite domains without layers, which are derived as one cell.

#include "catch.h"
#include "derive_fixture.h"

using namespace sgm;

namespace {

GrammarChunk finite(std::string_view rules) {
  return derived(*compiled("sgm 1; domain finite box(16m); start Main;\n" + std::string(rules)));
}

/// Converts units to metres, rounded to a tenth.
double tenths(int32_t units) { return std::floor(units / 102.4 + 0.5) / 10; }

}  // namespace

TEST_CASE("a displacement is as large as its scope is scaled") {
  const GrammarChunk chunk = derivedRules("rule Main { scale(2) displace 0.5m*fractal(2m) { sphere(1m); } }");
  REQUIRE(chunk.groups.size() == 1);
  CHECK(tenths(chunk.groups[0].bounds.hi.x) == 3.0);
  const GrammarChunk amp = derivedRules("rule Main { scale(2) displace q.x amp 0.5m { sphere(1m); } }");
  REQUIRE(amp.groups.size() == 1);
  CHECK(tenths(amp.groups[0].bounds.hi.x) == 3.0);
}

TEST_CASE("a warp goes along the scope's axes") {
  const GrammarChunk chunk =
      derivedRules("rule Main { rot(y, 90deg) scale(2) warp (0.5m*fractal(2m), 0m, 0m) { sphere(1m); } }");
  REQUIRE(chunk.groups.size() == 1);
  CHECK(tenths(chunk.groups[0].bounds.hi.x) == 2.0);
  CHECK(tenths(chunk.groups[0].bounds.hi.y) == 2.0);
  CHECK(tenths(chunk.groups[0].bounds.hi.z) == 3.0);
}

TEST_CASE("what check proves is derived: a displaced, turned box") {
  const GrammarChunk chunk =
      derived(*compiled("sgm 1; start A; rule A { displace 5m*fractal(20m) { rot(y, 45deg) box(4m); } }"));
  CHECK(chunk.notes.empty());
  CHECK(chunk.groups.size() == 1);
}

TEST_CASE("only the layer's own use of its start rule cuts the domain") {
  const GrammarChunk chunk =
      derivedRules("rule Main depth 2 -> sphere(1m) { box(4m); cut { sphere(1m); } union { at(10m, 0m, 0m) Main; } }");
  int cuts = 0;
  for (const Group& group : chunk.groups) cuts += group.cut ? 1 : 0;
  CHECK(cuts == 1);
  bool nested = false;
  for (const Shape& s : chunk.shapes) nested = nested || s.kind == ShapeKind::subtract;
  CHECK(nested);
}

TEST_CASE("a cut within a meet may stand behind transforms") {
  const GrammarChunk chunk =
      derivedRules("rule Main { meet { box(4m); box(3m); at(1m, 0m, 0m) cut { sphere(1m); } } }");
  CHECK(chunk.notes.empty());
  REQUIRE(chunk.groups.size() == 1);
  CHECK(chunk.shapes[chunk.groups[0].root].kind == ShapeKind::subtract);
}

TEST_CASE("a whole domain's points lie within its box") {
  const GrammarChunk centre = finite("rule Main { at(cell.center) sphere(1m); }");
  REQUIRE(centre.groups.size() == 1);
  CHECK(tenths(centre.groups[0].bounds.hi.x) == 1.0);
  CHECK(tenths(centre.groups[0].bounds.lo.x) == -1.0);
  const GrammarChunk many = finite("rule Main { scatter poisson(4m) sphere(10cm); }");
  CHECK(many.groups.size() > 10);
  IntBox all = many.groups[0].bounds;
  for (const Group& group : many.groups)
    for (int a = 0; a < 3; ++a) {
      all.lo[a] = std::min(all.lo[a], group.bounds.lo[a]);
      all.hi[a] = std::max(all.hi[a], group.bounds.hi[a]);
    }
  for (int a = 0; a < 3; ++a) {
    CHECK(all.lo[a] < -4 * 1024);
    CHECK(all.hi[a] > 4 * 1024);
    CHECK(all.lo[a] > -9 * 1024);
    CHECK(all.hi[a] < 9 * 1024);
  }
}

TEST_CASE("points at no distance are none, and no failure") {
  const GrammarChunk chunk = derivedRules("rule Main { sphere(1m); scatter poisson(0m) on disc(5m) { sphere(1m); } }");
  CHECK(chunk.groups.size() == 1);
  REQUIRE(chunk.notes.size() == 1);
  CHECK(chunk.notes[0].message.find("positive") != std::string::npos);
}

TEST_CASE("edges of `size` are read in the scope as it was") {
  const GrammarChunk swapped = derivedRules(
      "rule Main { size(2m, 4m, 6m) Turned; } rule Turned { size(scope.z, scope.y, scope.x) box(scope); }");
  REQUIRE(swapped.groups.size() == 1);
  CHECK(tenths(swapped.groups[0].bounds.hi.x) == 3.0);
  CHECK(tenths(swapped.groups[0].bounds.hi.y) == 2.0);
  CHECK(tenths(swapped.groups[0].bounds.hi.z) == 1.0);
  // An omitted axis keeps its size; the second `size` refers to the scope of the first one.
  const GrammarChunk moved =
      derivedRules("rule Main { size(2m, 4m, 6m) size(y scope.x, z scope.y) size(x scope.z) box(scope); }");
  REQUIRE(moved.groups.size() == 1);
  CHECK(tenths(moved.groups[0].bounds.hi.x) == 2.0);
  CHECK(tenths(moved.groups[0].bounds.hi.y) == 1.0);
  CHECK(tenths(moved.groups[0].bounds.hi.z) == 2.0);
}
