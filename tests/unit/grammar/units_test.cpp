// Tests the dimensions of expressions.

#include "catch.h"
#include "compile_text.h"

using namespace sgm;
using namespace sgm::test;

namespace {

/// The diagnostics, in the form of brief(), of a grammar whose start rule A has this body.
std::string brokenUnits(const std::string& use) {
  return brief(
      compileText(
          "sgm 1; param l = 2m in 1m..3m; param a = 30deg in 0deg..90deg; param n = 3 in 1..5; start A;\nrule A { " +
          use + " }")
          .diagnostics);
}

}  // namespace

TEST_CASE("sums and comparisons want equal dimensions", "[grammar][units]") {
  for (const char* good : {"sphere(l + 1m);",
                           "sphere(2*l - 50cm);",
                           "sphere(l*n);",
                           "sphere(l/n);",
                           "sphere(l*l/l);",
                           "rot(y, a + 1rad) sphere(l);",
                           "repeat floor(l/1m) rot(y, a) sphere(l);",
                           "sphere(sqrt(l*l));",
                           "sphere(min(l, 3m));",
                           "sphere(max(0, l));",
                           "sphere(clamp(l, 1m, 2m));",
                           "sphere(mix(l, 2*l, 0.5));",
                           "sphere(if l > 1m then l else 2m);",
                           "sphere(abs(-l));",
                           "at((l, 0, 0)) sphere(l);",
                           "at(2*(l, l, l) - (1m, 1m, 1m)) sphere(l);",
                           "sphere((l, l, l).x);",
                           "sphere(l*sin(a));",
                           "sphere(length((l, l, 0m)));",
                           "sphere(rand(1m, l));",
                           "sphere(smoothstep(0, 1, n)*l + 1m);",
                           "at(x 3m, z l) sphere(l);",
                           "sphere(30%*l);"}) {
    INFO(good);
    CHECK(brokenUnits(good).empty());
  }
  const std::pair<const char*, const char*> bad[] = {{"sphere(l + a);", "2:17 unit-mismatch"},
                                                     {"sphere(l + 2);", "2:17 unit-mismatch"},
                                                     {"sphere(l*l);", "2:17 unit-mismatch"},
                                                     {"sphere(n);", "2:17 unit-mismatch"},
                                                     {"rot(y, l) sphere(l);", "2:17 unit-mismatch"},
                                                     {"sphere(min(l, a));", "2:24 unit-mismatch"},
                                                     {"sphere(sqrt(l));", "2:17 unit-mismatch"},
                                                     {"repeat l sphere(l);", "2:17 unit-mismatch"},
                                                     {"at((l, a, l)) sphere(l);", "2:17 unit-mismatch"},
                                                     {"sphere(if n > 1 then l else a);", "2:38 unit-mismatch"},
                                                     {"sphere(if n then l else l);", "2:20 type-mismatch"},
                                                     {"sphere(-true);", "2:17 type-mismatch"},
                                                     {"sphere(n > 2);", "2:17 type-mismatch"},
                                                     {"scale(l) sphere(l);", "2:16 unit-mismatch"},
                                                     {"detail 3 sphere(l);", "2:17 unit-mismatch"},
                                                     {"displace 1 sphere(l);", "2:19 unit-mismatch"},
                                                     {"union smooth 1 { sphere(l); }", "2:23 unit-mismatch"},
                                                     {"scatter l on disc(l) sphere(l);", "2:18 unit-mismatch"},
                                                     {"sphere(rand(1, 2m)*1m);", "2:25 unit-mismatch"}};
  for (const auto& [text, expected] : bad) {
    INFO(text);
    CHECK(brokenUnits(text) == expected);
  }
}

TEST_CASE("an error names both dimensions", "[grammar][units]") {
  const CompileResult result = compileText("sgm 1; start A; rule A { sphere(2m + 30deg); }");
  REQUIRE(result.diagnostics.size() == 1);
  CHECK(result.diagnostics[0].message == "a length and an angle cannot be added");
}

TEST_CASE("a rule's parameters have one dimension each, from the first call", "[grammar][units]") {
  const CompileResult result = compileText("sgm 1; start A;\nrule A { B(2m); B(30deg); }\nrule B(r) { sphere(r); }");
  CHECK(brief(result.diagnostics) == "2:19 unit-mismatch");
  // The literal 0 fits every dimension, so the first call leaves the dimension of r open.
  CHECK(compileText("sgm 1; start A;\nrule A { B(0); B(2m); }\nrule B(r) { at(r, 0, 0) sphere(1m); }").program);
  CHECK(brief(compileText("sgm 1; start A;\nrule A { B(0); B(2deg); }\nrule B(r) { at(r, 0, 0) sphere(1m); }")
                  .diagnostics) == "3:16 unit-mismatch");
}

TEST_CASE("one field or let serves several dimensions", "[grammar][units]") {
  CHECK(compileText("sgm 1; start A; let twice(x) = 2*x; rule A { rot(y, twice(30deg)) sphere(twice(2m)); }").program);
  const CompileResult result = compileText(
      "sgm 1; start A;\nlet both(x) = x + 1m;\nrule A { sphere(both(2m)); rot(y, both(1deg)) sphere(1m); }");
  CHECK(brief(result.diagnostics) == "2:15 unit-mismatch");
}

TEST_CASE("stages are kept apart", "[grammar][units]") {
  const std::pair<const char*, const char*> bad[] = {
      {"rule A { let a = p.y; sphere(1m); }", "2:18 stage"},
      {"rule A { at(0m, q.x, 0m) sphere(1m); }", "2:17 stage"},
      {"rule A { repeat u { sphere(1m); } }", "2:17 stage"},
      {"rule A { field f = p.y; sphere(f); }", "2:32 stage"},
      {"rule A { B(p.y); } rule B(r) { sphere(r); }", "2:12 stage"},
      {"rule A { displace fractal(period p.x) * 1m { sphere(1m); } }", "2:34 stage"},
      {"rule A weight u { sphere(1m); }", "2:15 stage"},
      {"rule A { detail p.x { sphere(1m); } }", "2:17 stage"},
      {"rule A { union smooth p.y { sphere(1m); } }", "2:23 stage"}};
  for (const auto& [text, expected] : bad) {
    INFO(text);
    CHECK(brief(compileText(std::string("sgm 1; start A;\n") + text).diagnostics) == expected);
  }
  CHECK(
      compileText(
          "sgm 1; start A;\nrule A { field f(x) = x*fractal(2m); displace f(1m) + 0.1m*u { morph(sphere(1m), box(1m), "
          "smoothstep(0m, 4m, p.y + f(1m))); } }")
          .program);
}

TEST_CASE("what a rule that nothing calls makes of its parameters fits every dimension", "[grammar][units]") {
  // A rule that nothing calls (here Spare) is checked like the uncalled rules of an imported library.
  for (const char* statement : {"ellipsoid((r, 0.35*r, r*(1 - 0.2)));", "at((r, r, 2*r) + (r, 0, 0)) sphere(1m);",
                                "at(-(r, r, r)) box((r, r, r));", "superq((r, r, r), r);"}) {
    INFO(statement);
    const CompileResult result =
        compileText(std::string("sgm 1; start A; rule A { sphere(1m); } rule Spare(r) { ") + statement + " }");
    CHECK(result.program != nullptr);
    CHECK(brief(result.diagnostics).find("mismatch") == std::string::npos);
  }
  // The known dimension of a component, here of the literal 2, is still checked.
  CHECK(!compileText("sgm 1; start A; rule A { sphere(1m); } rule Spare(r) { ellipsoid((r, 2, r)); }").program);
}
