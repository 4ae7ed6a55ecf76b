// Tests malicious texts, for example deeply nested or very long ones: each must end quickly with a diagnostic.

#include <algorithm>
#include <ctime>

#include "catch.h"
#include "compile_text.h"

using namespace sgm;
using namespace sgm::test;

namespace {

std::string repeated(std::string_view text, int times) {
  std::string out;
  for (int i = 0; i < times; ++i) out += text;
  return out;
}

/// Returns processor time, because the machine may be busy.
double secondsSince(std::clock_t begin) { return static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC; }

bool mentions(const CompileResult& result, std::string_view code) {
  for (const Diagnostic& d : result.diagnostics)
    if (d.code == code) return true;
  return false;
}

}  // namespace

TEST_CASE("deep nesting is refused, not followed", "[grammar][caps]") {
  const std::string head = "sgm 1; start A; rule A { ";
  for (const std::string& text :
       {head + repeated("{", 100000), head + "sphere(" + repeated("(", 100000),
        head + "sphere(" + repeated("-", 100000), head + "sphere(" + repeated("not ", 100000),
        head + "sphere(" + repeated("if ", 100000), head + repeated("at(1m,0,0) detail 1m ", 20000),
        head + repeated("union ", 100000), head + "let a = " + repeated("min(1,", 50000),
        head + repeated("morph({", 50000), head + "sphere(1m" + repeated(" + 1m", 50000) + "); }",
        head + "sphere(a" + repeated(".x", 50000) + "); }"}) {
    const CompileResult result = compileText(text);
    INFO(text.substr(0, 80));
    CHECK_FALSE(result.program);
    CHECK(mentions(result, "too-deep"));
  }
}

TEST_CASE("a path is no deeper than rules are", "[grammar][caps]") {
  const std::string text =
      "sgm 1; start A; rule A depth 3 -> sphere(1m) { A; }\noverride \"A" + repeated("/A", 64) + "\" { }";
  CHECK(brief(compileText(text).diagnostics) == "2:10 too-deep");
}

TEST_CASE("many overrides of one rule cost what they are", "[grammar][caps]") {
  const std::clock_t begin = std::clock();
  std::string cells, tags, same;
  for (int i = 0; i < 2000; ++i) {
    cells += "override \"a(" + std::to_string(i) + ", 0, 0)/A/B[0]\" { at(1m, 0m, 0m) inner; }\n";
    same += "override \"A/B\" { inner; }\n";
    tags += "override tag \"b\" { inner; }\n";
  }
  const std::string head =
      "sgm 1; domain infinite; layer a cell 8m reach 8m { start A; }\nrule A { B; }\nrule B { tag \"b\"; sphere(1m); "
      "}\n";
  // Each of these overrides applies to another cell, so they never nest: at most one of them moves a shape.
  const CompileResult apart = compileText(head + cells);
  INFO(renderDiagnostics(apart));
  CHECK(apart.program);
  CHECK(apart.diagnostics.empty());
  for (const std::string& text : {head + same, head + tags}) {
    const CompileResult result = compileText(text);
    CHECK((result.program || mentions(result, "reach")));
  }
  CHECK(secondsSince(begin) < 5);
}

TEST_CASE("chains of lets and fields do not explode", "[grammar][caps]") {
  for (const char* kind : {"let", "field"}) {
    std::string text = "sgm 1; start A;\n";
    const int count = 40;
    text += std::string(kind) + " f0(x) = x + x;\n";
    for (int i = 1; i < count; ++i)
      text += std::string(kind) + " f" + std::to_string(i) + "(x) = f" + std::to_string(i - 1) + "(f" +
              std::to_string(i - 1) + "(x));\n";
    text += "rule A { displace clamp(f39(0.001m), -1m, 1m) { sphere(1m); } }\n";
    const std::clock_t begin = std::clock();
    const CompileResult result = compileText(text);
    INFO(renderDiagnostics(result));
    CHECK(secondsSince(begin) < 2);
  }
}

TEST_CASE("rules that multiply are bounded once a range, not once a leaf", "[grammar][caps]") {
  std::string text = "sgm 1; start R0;\n";
  for (int i = 0; i < 100; ++i)
    text += "rule R" + std::to_string(i) + " { R" + std::to_string(i + 1) + "; at(1cm, 0m, 0m) R" +
            std::to_string(i + 1) + "; }\n";
  text += "rule R100 { sphere(1m); }\n";
  const std::clock_t begin = std::clock();
  const CompileResult result = compileText(text);
  INFO(renderDiagnostics(result));
  CHECK(secondsSince(begin) < 2);
  REQUIRE(result.program);
  CHECK(result.program->layers[0].bound.hi.x <= 2 * kUnitsPerMetre + 1);
}

TEST_CASE("a flood of errors is cut off", "[grammar][caps]") {
  const CompileResult result = compileText("sgm 1;\n" + repeated("bogus;\n", 10000));
  CHECK(result.diagnostics.size() == 51);
  CHECK(result.diagnostics.back().code == "too-many-errors");
}

TEST_CASE("a megabyte of noise ends", "[grammar][caps]") {
  for (std::string_view piece :
       {"rule A { sphere(1m); }\n", "}", "{", "\"", "1", "a ", "// c\n", "\xFF", "rule\n", "; "}) {
    std::string text = "sgm 1;\n" + repeated(piece, static_cast<int>(1000000 / piece.size()));
    const std::clock_t begin = std::clock();
    compileText(text);
    INFO(piece);
    CHECK(secondsSince(begin) < 5);
  }
}

namespace {

/// A tree of rules, each with the usual contents of a rule.
std::string treeOfRules(int count) {
  std::string text = "sgm 1;\nimport \"std/rock.sgm\" as rock;\nstart R0(4m);\n";
  for (int i = 0; i < count; ++i) {
    const std::string n = std::to_string(i);
    auto callOf = [&](int child) {
      return child < count ? "R" + std::to_string(child) + "(0.9*r);" : std::string("sphere(r);");
    };
    text += "rule R" + n + "(r) when r > 1m weight 2 {\n  displace rock.fbm(period 5m, amp 0.1m) { sphere(r); }\n" +
            "  union smooth 0.2m { at(r, 0m, 0m) box(r, 0.5*r, r); rot(y, 30deg) cylinder(0.5*r, r); }\n" +
            "  for i in 0..3 { at(0.1m*i, 0m, 0m) torus(r, 0.2*r); }\n  at(0m, 1mm, 0m) " + callOf(2 * i + 1) +
            "\n  rot(y, rand(0deg, 90deg)) " + callOf(2 * i + 2) + "\n}\nrule R" + n + "(r) else { blob(r); }\n";
  }
  return text;
}

/// Returns processor time and not wall time, because other programs may be running.
double secondsToCompile(const std::string& text) {
  double best = 1e9;
  for (int round = 0; round < 3; ++round) {
    const std::clock_t begin = std::clock();
    const CompileResult result = compileText(text);
    best = std::min(best, static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC);
    INFO(renderDiagnostics(result).substr(0, 2000));
    REQUIRE(result.program);
  }
  return best;
}

}  // namespace

TEST_CASE("compiling takes no longer than in step with the text", "[grammar][performance]") {
  const double of_one = secondsToCompile(treeOfRules(100)), of_four = secondsToCompile(treeOfRules(400));
  INFO(of_one << " s for 800 lines, " << of_four << " s for 3,200");
  CHECK(of_four < 10 * of_one);  // a quadratic cost would be 16 times as high
}

TEST_CASE("lets within lets and rules within rules stay on a small stack", "[grammar][caps]") {
  std::string text = "sgm 1; start R0(1m);\nlet f0(x) = x;\n";
  for (int i = 1; i <= 60; ++i) {
    text += "let f" + std::to_string(i) + "(x) = ";
    for (int k = 0; k < 50; ++k) text += "-(";
    text += "f" + std::to_string(i - 1) + "(x)" + repeated(")", 50) + ";\n";
  }
  CHECK(mentions(compileText(text + "rule R0(r) { sphere(f60(r)); }"), "too-deep"));
  std::string rules = "sgm 1; start R0(1m); let f0(x) = x;\n";
  for (int i = 0; i < 300; ++i)
    rules +=
        "rule R" + std::to_string(i) + "(r) { " + repeated("union ", 50) + "R" + std::to_string(i + 1) + "(r); }\n";
  const CompileResult deep = compileText(rules + "rule R300(r) { sphere(r); }");
  INFO(renderDiagnostics(deep).substr(0, 500));
  CHECK(mentions(deep, "reach"));
}

TEST_CASE("a constant costs each let once", "[grammar][caps]") {
  std::string text = "sgm 1;\nlet a0 = 1;\n";
  for (int i = 1; i < 11; ++i) {
    const std::string before = "a" + std::to_string(i - 1);
    text += "let a" + std::to_string(i) + " = " + before;
    for (int k = 0; k < 15; ++k) text += "*" + before;
    text += ";\n";
  }
  text += "domain finite box(8m*a10);\nstart A; rule A { sphere(1m); }";
  const CompileResult result = compileText(text);
  INFO(renderDiagnostics(result));
  CHECK(result.program);
}

TEST_CASE("layers are capped", "[grammar][caps]") {
  std::string text = "sgm 1; domain infinite;\n";
  for (int i = 0; i < 257; ++i) text += "layer l" + std::to_string(i) + " cell 8m reach 8m { start A; }\n";
  CHECK(brief(compileText(text + "rule A { sphere(1m); }").diagnostics) == "258:7 too-large");
}
