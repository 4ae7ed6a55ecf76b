// Tests that print(parse(x)) is a fixed point, and that printing keeps meaning and comments.

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "catch.h"
#include "compile_text.h"
#include "grammar/std/std_library.h"
#include "random_program.h"
#include "rounds.h"

using namespace sgm;
using namespace sgm::test;

namespace {

std::string fileText(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::stringstream text;
  text << file.rdbuf();
  return text.str();
}

std::string formatted(std::string_view text) {
  const FormatResult result = formatGrammar(text, "test.sgm");
  INFO(text);
  INFO(brief(result.diagnostics));
  REQUIRE(result.text);
  return *result.text;
}

}  // namespace

TEST_CASE("every sample is canonical and compiles without a word", "[grammar][round]") {
  int count = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(SGM_SOURCE_DIR "/samples/grammars")) {
    if (entry.path().extension() != ".sgm") continue;
    ++count;
    INFO(entry.path().string());
    const std::string text = fileText(entry.path());
    CHECK(formatted(text) == text);
    // Samples have at most 40 lines. A row of the paper's Table 4 may have 60, because it must show everything that the
    // row claims.
    const bool row = entry.path().parent_path().filename() == "table4";
    CHECK(std::count(text.begin(), text.end(), '\n') <= (row ? 60 : 40));
    FolderResolver files(entry.path().parent_path());
    const CompileResult result = compileText(text, &files);
    INFO(renderDiagnostics(result));
    CHECK(result.program);
    CHECK(result.diagnostics.empty());
    if (result.program) CHECK(result.program->canonical == std::string_view(text));
  }
  CHECK(count >= 14);
}

TEST_CASE("every part of the standard library is canonical", "[grammar][round]") {
  for (const StdFile& file : stdLibrary()) {
    INFO(file.path);
    CHECK(formatted(std::string(file.text)) == file.text);
  }
}

TEST_CASE("random programs: printing is a fixed point and keeps the meaning", "[grammar][round]") {
  for (uint64_t seed = 1; seed <= rounds(400); ++seed) {
    const std::string text = randomProgram(seed);
    INFO("seed " << seed << "\n" << text);
    const std::string once = formatted(text);
    CHECK(formatted(once) == once);
    const CompileResult a = compileText(text), b = compileText(once);
    REQUIRE(bool(a.program) == bool(b.program));
    if (a.program) CHECK(a.program->hash == b.program->hash);
  }
}

TEST_CASE("no comment is lost", "[grammar][round]") {
  const std::string text =
      "// 1\nsgm 1; // 2\n// 3\nstart A; // 4\n\n\n// 5\nrule A { // 6\n // 7\n sphere( // 8\n 1m); // 9\n // 10\n\n "
      "union // 11\n"
      "{ // 12\n } // 13\n} // 14\n// 15";
  const std::string once = formatted(text);
  INFO(once);
  size_t at = 0;
  for (int i = 1; i <= 15; ++i) {
    at = once.find("// " + std::to_string(i), at);
    INFO(i);
    REQUIRE(at != std::string::npos);
  }
  CHECK(formatted(once) == once);
}

TEST_CASE("a call without arguments stays one", "[grammar][round]") {
  CHECK(formatted("sgm 1; start A(); rule A { at( cell.point( ) ) sphere(1m); B(); }") ==
        "sgm 1;\nstart A;\nrule A { at(cell.point()) sphere(1m); B; }\n");
}

TEST_CASE("layout is canonical", "[grammar][round]") {
  CHECK(formatted("sgm 1;start A;\n\n\n\nrule A(r=2 , s){sphere( r*(s) );box(1m,2m ,3m);}") ==
        "sgm 1;\nstart A;\n\nrule A(r = 2, s) { sphere(r*(s)); box(1m, 2m, 3m); }\n");
  CHECK(formatted("sgm 1; rule A {\nat(1m,0,0) rot(y,3deg) { sphere(1m);\n} }") ==
        "sgm 1;\nrule A {\n  at(1m, 0, 0) rot(y, 3deg) {\n    sphere(1m);\n  }\n}\n");
  CHECK(formatted("sgm 1; rule A { at(y -2m, z = -1m) at(0m, y - 2m) box(1m); size(y = (1m)) box(scope); }") ==
        "sgm 1;\nrule A { at(y -2m, z -1m) at(0m, y - 2m) box(1m); size(y = (1m)) box(scope); }\n");
  CHECK(formatted("sgm 1; rule A { halfspace(below -2m); f(a = -2, b = (1)); }") ==
        "sgm 1;\nrule A { halfspace(below -2m); f(a = -2, b = (1)); }\n");
  CHECK(formatted("sgm 1; let a = not (b < c) and (d or e) ; let f = -(-a)*(b/(c/d)) - (e - f);") ==
        "sgm 1;\nlet a = not (b < c) and (d or e);\nlet f = -(-a)*(b/(c/d)) - (e - f);\n");
}
