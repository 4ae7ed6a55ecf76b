#include "catch.h"
#include "compile_text.h"

using namespace sgm;
using namespace sgm::test;

namespace {

std::string recursionErrors(const std::string& rules) {
  return brief(compileText("sgm 1; domain finite box(1000m);\n" + rules).diagnostics);
}

}  // namespace

TEST_CASE("recursion that ends is accepted", "[grammar][recursion]") {
  for (const char* good : {
           "start A(3); rule A(n) when n > 0 { A(n - 1); } rule A(n) else { sphere(1m); }",
           "start A(3, 1m); rule A(n, r) when r > 1cm and n >= 1 { sphere(r); A(n - 1, r); } rule A(n, r) else { "
           "sphere(r); }",
           "start A(8m); rule A(r) when r > 1m { sphere(r); A(0.5*r); } rule A(r) else { sphere(r); }",
           "start A(8m); rule A(r) when r > 1m { A(r*rand(0.2, 0.7)); } rule A(r) else { sphere(r); }",
           "start A(8m); rule A(r) when r > 1m { A(r/2); } rule A(r) else { sphere(r); }",
           "start A(8m); rule A(r) minsize 1m -> L { sphere(r); A(r*0.6); } rule L { sphere(1m); }",
           "start A(8m); rule A(r) minsize 1m -> L { sphere(r); scale(0.5) A(r); } rule L { sphere(1m); }",
           "start A(8m); rule A(r) minsize 1m -> L { sphere(r); scale(1.5) A(r*0.5); } rule L { sphere(1m); }",
           "start A; rule A depth 5 -> L { at(1m, 0m, 0m) A; } rule L { sphere(1m); }",
           "start A; rule A depth 5 -> sphere(1m) { at(1m, 0m, 0m) B; } rule B { A; }",
           "start A; rule A minsize 1m -> sphere(1m) { size(0.5*scope) A; box(scope); }",
       }) {
    INFO(good);
    CHECK(recursionErrors(good).empty());
  }
}

TEST_CASE("recursion that may not end is refused", "[grammar][recursion]") {
  const std::pair<const char*, const char*> bad[] = {
      {"start A; rule A { A; }", "2:19 unbounded-recursion"},
      {"start A; rule A { B; } rule B { A; }", "2:33 unbounded-recursion"},
      {"start A(3); rule A(n) when n > 0 { A(n); }", "2:36 unbounded-recursion"},
      {"start A(3); rule A(n) when n > 0 { A(n + 1); }", "2:36 unbounded-recursion"},
      {"start A(3); rule A(n) when n < 9 { A(n - 1); }", "2:36 unbounded-recursion"},
      {"start A(3m); rule A(r) when r > 0m { A(r*0.5); }", "2:38 unbounded-recursion"},
      {"start A(3m); rule A(r) when r > 1m { A(r*rand(0.5, 1.1)); }", "2:38 unbounded-recursion"},
      {"start A(3m); rule A(r) minsize 1m -> L { A(r); } rule L { }", "2:42 unbounded-recursion"},
      {"start A(3m); rule A(r) minsize 1m -> L { scale(2) A(r*0.6); } rule L { }", "2:51 unbounded-recursion"},
      {"start A; rule A depth 3 -> A { sphere(1m); }", "2:28 unbounded-recursion"},
      {"start A; rule A depth 3 -> B { A; } rule B { A; }", "2:46 unbounded-recursion"},
      {"start A(1, 2); rule A(a, b) when a > 0 { A(b - 1, a); }", "2:42 unbounded-recursion"},
      {"start A; rule A weight 1 { sphere(1m); } rule A weight 1 { A; }", "2:60 unbounded-recursion"}};
  for (const auto& [text, expected] : bad) {
    INFO(text);
    CHECK(recursionErrors(text) == expected);
  }
}

TEST_CASE("a rule that is checked again finds its size anew", "[grammar][recursion]") {
  // The first call, with the literal 0, leaves the dimension of x open; the second one makes x a length.
  const CompileResult result = compileText(
      "sgm 1; start S; rule S { A(0, 2m); A(1m, 2m); }\n"
      "rule A(x, r) minsize 1m -> sphere(1m) { box(max(x, 1m)); sphere(r); }");
  INFO(renderDiagnostics(result));
  REQUIRE(result.program);
  CHECK(result.program->rules[result.program->findRule("A")].alternatives[0].size_slot == 0);
}
