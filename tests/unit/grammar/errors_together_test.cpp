// Tests that one run reports all independent errors: every part that was parsed is checked, and an error that only
// follows from another error is not reported.

#include "grammar/check_file.h"
#include "grammar/std/std_library.h"
#include "messages.h"

using namespace sgm;
using namespace sgm::test;

namespace {

std::string places(const std::string& text, ImportResolver* files = nullptr) {
  return brief(compileText(text, files).diagnostics);
}

}  // namespace

TEST_CASE("errors of meaning are told beside errors of syntax", "[grammar][together]") {
  // One text has an error each in a statement, a rule's head, a declaration, and the characters.
  CHECK(places("sgm 1; start A;\nrule A { sphere(1); at(1m 0m, 0m) box(1m); }\nrule B { bxo(1m); }") ==
        "2:17 unit-mismatch; 2:27 syntax; 3:10 unknown-name");
  CHECK(places("sgm 1; start A;\nrule A { sphere(1); B; }\nrule B weight { box(1m); }") ==
        "2:17 unit-mismatch; 3:15 syntax");
  CHECK(places("sgm 1; start A;\nlet a = ;\nrule A { sphere(1); box(a); }") == "2:9 syntax; 3:17 unit-mismatch");
  CHECK(places("sgm 1; start A;\nrule A { sphere(1);\n tag \"open;\n}\n") == "2:17 unit-mismatch; 3:6 bad-text");
  CHECK(places("sgm 1; start A;\nrule A { sphere(3furlongs); box(1); }") == "2:17 unknown-unit; 2:33 unit-mismatch");
  CHECK(places("sgm 1; start A;\nrule A { box(1); sphere(2m ? 3m); }") == "2:14 unit-mismatch; 2:28 bad-character");
  CHECK(places("sgm 1; domain infinite; layer a cell 8m reach 4m { start A; }\nrule A { sphere(9m); box(1m }") ==
        "2:10 reach; 2:29 syntax");
  CHECK(places("sgm 1; start A;\nrule A { B; box(1m }\nrule B { B; }") == "2:20 syntax; 3:10 unbounded-recursion");
}

TEST_CASE("what is missing makes no errors of its own", "[grammar][together]") {
  const char* texts[] = {
      // Texts in which a let, a field, a rule, an import, a parameter, a layer, a start or a domain has a syntax error.
      "sgm 1; start A;\nlet a = 2m *;\nrule A { sphere(a); }",
      "sgm 1; start A;\nfield f = 1m*;\nrule A { displace f { sphere(1m); } }",
      "sgm 1; start A;\nrule B(r { sphere(r); }\nrule A { B(1m); }",
      "sgm 1; start A;\nrule B(r) when > { sphere(r); } rule B(r) else { box(r); }\nrule A { B(1m); }",
      "sgm 1; start A;\nimport \"std/rock.sgm\" a rock;\nrule A { displace rock.fbm(period 1m, amp 0.1m) { "
      "sphere(1m); } }",
      "sgm 1; start A;\nparam a = 1m in ..2m;\nrule A { sphere(a); }",
      "sgm 1; domain infinite solid;\nlayer net cell 8m reach { start A; } layer drip cell 8m reach 4m uses net { "
      "start D; }\nrule A { sphere(1m); } rule D { scatter poisson(1m) probe up 1m of net { sphere(1m); } }",
      "sgm 1;\nstart A\nrule A { sphere(1m); }",
      "sgm 1;\ndomain infinit; layer a cell 8m reach 4m { start A; }\nrule A { sphere(1m); }",
      // Texts with a part that cannot be parsed. Names and bounds that this part would have defined are missing, but
      // this must cause no further errors.
      "sgm 1; start A;\nrule A { meet { box(1m; halfspace(below 0m); } }",
      "sgm 1; start A;\nrule A { let r = 1m +; sphere(r); }",
      "sgm 1; start A;\nrule A { footprint rect(1m 2m) as plan; extrude 2m of plan; }",
      "sgm 1; start A;\nrule A { treemap { living: sphere(1m); link living kitchen by door(1m); } }",
      "sgm 1; start A;\noverride \"A/B\" { sphere(1m); }\nrule A { B(1m; } rule B(r) { sphere(r); }",
      "sgm 1; start A;\nexpect components == 1 per B;\nrule B { sphere(1m;\n}\nrule A { box(1m); }",
  };
  for (const char* text : texts) {
    const CompileResult result = compileText(text);
    INFO(text << "\n" << renderDiagnostics(result));
    CHECK(countDiagnostics(result.diagnostics).starts_with("1 error,"));
  }
}

TEST_CASE("a file that cannot be read hides no other error", "[grammar][together]") {
  MapResolver files;
  files.files["bad.sgm"] = "sgm 1;\nrule Post { sphere(1m; }\nrule Beam { box(1); }";
  CHECK(places("sgm 1; start A; import \"gone.sgm\" as gone;\nrule A { gone.Post; fit gone; sphere(1); }", &files) ==
        "1:24 import-missing; 2:38 unit-mismatch");
  CHECK(places("sgm 1; start A; import \"bad.sgm\" as bad;\nrule A { bad.Post; bad.Beam; bad.Nail; sphere(1); }",
               &files) == "2:30 unknown-name; 2:47 unit-mismatch; 2:22 syntax; 3:17 unit-mismatch");
}

TEST_CASE("a file for others to import is checked by itself", "[grammar][library]") {
  CompileOptions options;
  MapResolver files;
  files.files["noise.sgm"] = "sgm 1; field wave(period, amp) = amp*fractal(period);";
  options.resolver = &files;
  const std::string library =
      "sgm 1; import \"noise.sgm\" as noise;\nrule Post(h, wide = 0.1) { displace noise.wave(1m, 0.1m) { "
      "cylinder(wide*h, "
      "h); } }\nlet half(a) = a/2;\n";
  const auto checked = [&](const std::string& more) {
    return brief(checkFile(library + more, "lib.sgm", options).compiled.diagnostics);
  };
  const CheckResult good = checkFile(library, "lib.sgm", options);
  INFO(renderDiagnostics(good.compiled));
  CHECK(good.compiled.diagnostics.empty());
  CHECK(good.library);
  REQUIRE(good.compiled.program);
  // Errors in a library's rules are found although nothing calls these rules.
  CHECK(checked("rule Beam { bxo(1m); sphere(1); }") == "4:13 unknown-name; 4:29 unit-mismatch");
  CHECK(checked("rule Tree(r) { Tree(r); }") == "4:16 unbounded-recursion");
  // A declaration that only the root file may contain makes the file a root, which needs a start. Compiling for
  // derivation needs a start, too.
  CHECK(checked("param a = 1m;") == "1:1 no-start");
  CHECK(checked("domain infinite;") == "1:1 no-start");
  CHECK(brief(compileGrammar(library, "lib.sgm", options).diagnostics) == "1:1 no-start");
}

TEST_CASE("the standard library is right by itself", "[grammar][library]") {
  FolderResolver folder(SGM_SOURCE_DIR "/runtime/grammar/std");
  CompileOptions options;
  options.resolver = &folder;
  for (const StdFile& file : stdLibrary()) {
    const std::string name(file.path.substr(file.path.find('/') + 1));
    const CheckResult result = checkFile(*folder.read(name, 0), name, options);
    INFO(name << "\n" << renderDiagnostics(result.compiled));
    CHECK(result.compiled.diagnostics.empty());
    CHECK(result.library);
    CHECK(result.compiled.program);
  }
}
