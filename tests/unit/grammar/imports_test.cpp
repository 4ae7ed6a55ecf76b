#include "grammar/parse/imports.h"

#include "catch.h"
#include "compile_text.h"
#include "grammar/std/std_library.h"

using namespace sgm;
using namespace sgm::test;

TEST_CASE("an import stays below the root's folder", "[grammar][imports]") {
  for (const char* path :
       {"a.sgm", "parts/a.sgm", "std/rock.sgm", "a b.sgm", "a.glb", "parts/bay.glb", "\xC3\xA4.sgm", "...x.sgm"})
    CHECK(importPathProblem(path).empty());
  for (const char* path :
       {"",         "/a.sgm",       "../a.sgm",    "a/../b.sgm", "./a.sgm", "a//b.sgm", "C:/a.sgm", "c:a.sgm",
        "a\\b.sgm", "\\\\h\\a.sgm", "a.txt",       ".sgm",       ".glb",    "a.gltf",   "a/.sgm",   "http://a/b.sgm",
        "a\nb.sgm", "a/..",         "a/.../b.sgm", "a /b.sgm",   "~*.sgm",  "%2e.sgm"}) {
    INFO(path);
    CHECK_FALSE(importPathProblem(path).empty());
  }
  CHECK_FALSE(importPathProblem(std::string(300, 'a') + ".sgm").empty());
}

TEST_CASE("a refused path never reaches the resolver", "[grammar][imports]") {
  MapResolver resolver;
  const CompileResult result = compileText("sgm 1; import \"../../etc/passwd\" as a; start A; rule A { }", &resolver);
  CHECK(brief(result.diagnostics) == "1:15 import-path");
  CHECK(resolver.reads == 0);
}

TEST_CASE("imports are relative to the file that names them, and loaded once", "[grammar][imports]") {
  MapResolver resolver;
  resolver.files["parts/a.sgm"] = "sgm 1; import \"b.sgm\" as b; rule Arch(r) { b.Stone(r); }";
  resolver.files["parts/b.sgm"] =
      "sgm 1; import \"std/rock.sgm\" as rock; rule Stone(r) { displace rock.fbm(1m, 0.1m) { sphere(r); } }";
  const CompileResult result = compileText(
      "sgm 1; import \"parts/a.sgm\" as a; import \"parts/b.sgm\" as b; start A; rule A { a.Arch(2m); b.Stone(1m); }",
      &resolver);
  INFO(renderDiagnostics(result));
  REQUIRE(result.program);
  CHECK(resolver.reads == 2);
  CHECK(result.program->modules.size() == 5);  // the root, a, b, std/rock and std/noise
  CHECK(result.program->findRule("Stone") != kNoId);
}

TEST_CASE("a path goes through imports as calls do, and an imported file overrides nothing", "[grammar][imports]") {
  MapResolver resolver;
  resolver.files["parts/a.sgm"] = "sgm 1; import \"b.sgm\" as b; rule Arch(r) { b.Stone(r); }";
  resolver.files["parts/b.sgm"] = "sgm 1; rule Stone(r) { sphere(r); }";
  const auto with = [&](const std::string& path) {
    return brief(compileText("sgm 1; import \"parts/a.sgm\" as x; start A; rule A { x.Arch(2m); }\noverride \"" + path +
                                 "\" { box(r); }",
                             &resolver)
                     .diagnostics);
  };
  CHECK(with("A/x.Arch[0]").empty());
  CHECK(with("A/x.Arch[0]/b.Stone[0]").empty());
  CHECK(with("A/Arch[0]") == "2:13 unknown-name");
  CHECK(with("A/x.Arch[0]/x.Stone[0]") == "2:23 unknown-name");
  resolver.files["parts/b.sgm"] += "\noverride \"A\" { }";
  CHECK(brief(compileText("sgm 1; import \"parts/b.sgm\" as b; start A; rule A { b.Stone(1m); }", &resolver)
                  .diagnostics) == "2:1 import-content");
}

TEST_CASE("imports have depth, count and size caps", "[grammar][imports]") {
  MapResolver resolver;
  for (int i = 0; i < 40; ++i)
    resolver.files["m" + std::to_string(i) + ".sgm"] =
        "sgm 1; import \"m" + std::to_string(i + 1) + ".sgm\" as next; let a = 1;";
  resolver.files["m40.sgm"] = "sgm 1;";
  const std::string root = "sgm 1; import \"m0.sgm\" as m; start A; rule A { }";
  CHECK(brief(compileText(root, &resolver).diagnostics) == "1:15 import-limit");
  CompileOptions options;
  options.resolver = &resolver;
  options.limits.import_depth = 100;
  CHECK(compileGrammar(root, "t.sgm", options).program);
  options.limits.files = 10;
  CHECK_FALSE(compileGrammar(root, "t.sgm", options).program);
  options.limits.files = 64;
  options.limits.total_bytes = 500;
  CHECK_FALSE(compileGrammar(root, "t.sgm", options).program);
}

TEST_CASE("a circle of imports ends", "[grammar][imports]") {
  MapResolver resolver;
  resolver.files["a.sgm"] = "sgm 1;\nimport \"b.sgm\" as b;";
  resolver.files["b.sgm"] = "sgm 1;\nimport \"a.sgm\" as a;";
  const CompileResult result = compileText("sgm 1; import \"a.sgm\" as a; start A; rule A { }", &resolver);
  REQUIRE(result.diagnostics.size() == 1);
  CHECK(result.diagnostics[0].code == "import-cycle");
  CHECK(result.diagnostics[0].file == "b.sgm");
}

TEST_CASE("an error in an import names its file", "[grammar][imports]") {
  MapResolver resolver;
  resolver.files["a.sgm"] = "sgm 1;\nrule B { sphere(2m }";
  const CompileResult result = compileText("sgm 1; import \"a.sgm\" as a; start A; rule A { a.B; }", &resolver);
  REQUIRE(result.diagnostics.size() == 1);
  CHECK(renderDiagnostics(result).find("a.sgm:2:20: error: ") == 0);
  CHECK(renderDiagnostics(result).find("rule B { sphere(2m }") != std::string::npos);
}

TEST_CASE("the standard library compiles and is canonical", "[grammar][imports]") {
  CHECK(stdLibrary().size() >= 2);
  for (const StdFile& file : stdLibrary()) {
    const std::string root = "sgm 1; import \"" + std::string(file.path) + "\" as s; start A; rule A { sphere(1m); }";
    const CompileResult result = compileText(root);
    INFO(renderDiagnostics(result));
    CHECK(result.program);
    const FormatResult format = formatGrammar(file.text, file.path);
    REQUIRE(format.text);
    CHECK(*format.text == file.text);
  }
}
