#include "catch.h"
#include "compile_text.h"

using namespace sgm;
using namespace sgm::test;

TEST_CASE("a diagnostic shows the line and a caret", "[grammar][render]") {
  const CompileResult result = compileText("sgm 1;\nstart A;\nrule A { shpere(5m); }\n");
  CHECK(renderDiagnostics(result) ==
        "test.sgm:3:10: error: unknown name `shpere`\n"
        "  rule A { shpere(5m); }\n"
        "           ^~~~~~\n"
        "  hint: did you mean `sphere`?\n");
}

TEST_CASE("tabs, wide letters and control characters keep the caret in place", "[grammar][render]") {
  Diagnostic d;
  d.file = "f";
  d.message = "m";
  d.line = 1;
  d.column = 6;
  d.end_column = 7;
  CHECK(renderDiagnostic(d, "\t\xC3\xA4\x01 x\n") == "f:1:6: error: m\n  \t\xC3\xA4? x\n  \t   ^\n");
  CHECK(renderDiagnostic(d, "a\xE9\x80 \xC3x\n") == "f:1:6: error: m\n  a?? ?x\n       ^\n");
  d.column = 100;
  CHECK(renderDiagnostic(d, "short\n").find("^\n") != std::string::npos);
  d.line = 9;
  CHECK(renderDiagnostic(d, "short\n") == "f:9:100: error: m\n");
  d.line = 0;
  CHECK(renderDiagnostic(d, "short\n") == "f: error: m\n");
}

TEST_CASE("a very long line is shown in part", "[grammar][render]") {
  Diagnostic d;
  d.file = "f";
  d.message = "m";
  d.line = 1;
  d.column = 5000;
  d.end_column = 5001;
  const std::string out = renderDiagnostic(d, std::string(10000, 'x'));
  CHECK(out.size() < 500);
  CHECK(out.find("^\n") != std::string::npos);
}

TEST_CASE("diagnostics are counted", "[grammar][render]") {
  CHECK(countDiagnostics(compileText("sgm 1; start A; rule A { } rule B { } ").diagnostics) == "0 errors, 1 warning");
  CHECK(countDiagnostics(compileText("sgm 1; start A; rule A { x; }").diagnostics) == "1 error, 0 warnings");
}
