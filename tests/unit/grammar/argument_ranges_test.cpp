// Tests declared ranges of the arguments of rules, lets and fields. The messages are compared word for word; each must
// name the line of the call.

#include "grammar/check_file.h"
#include "grammar/help/declarations.h"
#include "messages.h"

using namespace sgm;
using namespace sgm::test;

namespace {

/// The messages about a text. Line 1 is the head of the file; the text begins on line 2.
std::string rangeWords(const std::string& text, ImportResolver* resolver = nullptr) {
  const CompileResult result = compileText("sgm 1;\n" + text, resolver);
  INFO(renderDiagnostics(result));
  for (const Diagnostic& d : result.diagnostics) {
    CHECK(saysWhatToWrite(d));
    CHECK(d.end_column > d.column);
  }
  return inWords(result);
}

const std::string kHall = "rule Hall(r in 1m..60m, thick = 0.12 in 0.02..1) { sphere(r + 0.1*thick*r); }\n";

/// The messages about a body of the start rule, on line 3.
std::string wordsOfBody(const std::string& body) { return rangeWords(kHall + "rule A { " + body + " } start A;"); }

}  // namespace

TEST_CASE("an argument within its range is taken without a word", "[grammar][ranges]") {
  CHECK(wordsOfBody("Hall(1m); Hall(60m); Hall(2m, 0.02); Hall(thick 1, r 3m); Hall(r 3m, thick = 100%);").empty());
  CHECK(wordsOfBody("Hall(rand(1m, 60m)); for i in 1..61 { Hall(1m*i); }").empty());
  // 0.1*8 in floating point may exceed 0.8 by a rounding error, which is no violation of a range.
  CHECK(rangeWords("rule B(t in 0.3..0.7) { sphere(1m*t); }\nrule A { for i in 3..8 { B(0.1*i); } } start A;").empty());
}

TEST_CASE("an argument outside of its range is told at its own place", "[grammar][ranges]") {
  CHECK(wordsOfBody("Hall(0m);") ==
        "3:15 argument-range: `Hall` is given `r` = 0m, which is not within 1m..60m | give it a length from 1m to 60m");
  CHECK(wordsOfBody("Hall(2m, 30);") ==
        "3:19 argument-range: `Hall` is given `thick` = 30, which is not within 0.02..1 | give it a ratio from 0.02 to "
        "1");
  CHECK(wordsOfBody("Hall(thick 0.001, r 2m);") ==
        "3:21 argument-range: `Hall` is given `thick` = 0.001, which is not within 0.02..1 | give it a ratio from 0.02 "
        "to 1");
  CHECK(wordsOfBody("Hall(60.001m);").starts_with("3:15 argument-range: `Hall` is given `r` = 60.001m, which"));
  CHECK(wordsOfBody("Hall(-2m);").starts_with("3:15 argument-range: `Hall` is given `r` = -2m, which"));
  // All violations are reported in one run, not only the first one.
  CHECK(brief(compileText("sgm 1;\n" + kHall + "rule A { Hall(0m, 2); } start A;").diagnostics) ==
        "3:15 argument-range; 3:19 argument-range");
}

TEST_CASE("draws, loops and parameters are followed", "[grammar][ranges]") {
  CHECK(wordsOfBody("Hall(rand(0.2m, 0.6m));") ==
        "3:15 argument-range: `Hall` is given `r` = 0.2m..0.6m, none of which is within 1m..60m | give it a length "
        "from 1m to 60m");
  CHECK(wordsOfBody("Hall(rand(0.2m, 2m));") ==
        "3:15 warning argument-range: `Hall` may be given `r` = 0.2m..2m, not all of which is within 1m..60m | bound "
        "what it depends on, or write clamp(..., 1m, 60m)");
  CHECK(wordsOfBody("Hall(clamp(rand(0.2m, 2m), 1m, 60m));").empty());
  CHECK(wordsOfBody("for i in 0..4 { Hall(1m*i); }")
            .starts_with("3:31 warning argument-range: `Hall` may be given `r` = 0m"));
  CHECK(wordsOfBody("for i in 100..104 { Hall(1m*i); }")
            .starts_with("3:35 argument-range: `Hall` is given `r` = 100m..103m, none of which"));
  CHECK(
      rangeWords("param wide = 1m in 0.2m..0.5m;\n" + kHall + "rule A { Hall(wide); } start A;").find("param-range") !=
      std::string::npos);
  CHECK(rangeWords("param wide = 30cm in 20cm..50cm;\n" + kHall + "rule A { Hall(wide); } start A;")
            .starts_with("4:15 argument-range: `Hall` is given `r` = 0.2m..0.5m, none of which"));
  CHECK(rangeWords("param wide = 1m in 0.2m..5m;\n" + kHall + "rule A { Hall(2*wide); } start A;")
            .starts_with("4:15 warning argument-range: `Hall` may be given `r` = 0.4m..10m, not all of which"));
  // A rule whose condition keeps the value in the range needs no warning.
  CHECK(rangeWords("param wide = 1m in 0.2m..5m;\n" + kHall +
                   "rule A { B(wide); }\nrule B(w) when w >= 1m { Hall(w); }\nrule B(w) else { box(w); } start A;")
            .empty());
}

TEST_CASE("what comes through other rules is told where it leaves the range", "[grammar][ranges]") {
  CHECK(rangeWords(kHall + "rule Two(r) { Hall(r); at(x 9m) Hall(2m); }\nrule A { Two(0.5m); } start A;")
            .starts_with("3:20 argument-range: `Hall` is given `r` = 0.5m, which"));
  // One of two callers passes a valid value, the other one does not.
  CHECK(rangeWords(kHall + "rule Two(r) { Hall(r); }\nrule A { Two(5m); Two(0.5m); } start A;")
            .starts_with("3:20 argument-range: `Hall` is given `r` = 0.5m, which"));
  // Arguments of a start, of a rule after `depth ->`, and in a block of an override are checked as well.
  CHECK(rangeWords(kHall + "start Hall(0m);").starts_with("3:12 argument-range"));
  CHECK(rangeWords(kHall + "rule A(n) depth 3 -> Hall(70m) { scale(0.5) A(n); sphere(1m); } start A(1);")
            .starts_with("3:27 argument-range: `Hall` is given `r` = 70m, which"));
  CHECK(rangeWords(kHall + "rule A { Hall(2m); } start A;\noverride \"A/Hall\" { box(1m); Hall(0.1m); }")
            .starts_with("4:35 argument-range: `Hall` is given `r` = 0.1m, which"));
}

TEST_CASE("what nothing derives is held to what is certain", "[grammar][ranges]") {
  const auto found = compileText("sgm 1;\n" + kHall + "rule A { sphere(1m); }\nrule B { Hall(0m); } start A;");
  CHECK(brief(found.diagnostics).find("4:15 argument-range") != std::string::npos);
  // A library has no start, so its rules are checked without callers. Their arguments are unknown, so only violations
  // that do not depend on them are reported.
  const CheckResult library =
      checkFile("sgm 1;\n" + kHall + "rule B(s) { Hall(0m); Hall(s); Hall(rand(0m, 2m)); }", "test.sgm", {});
  CHECK(brief(library.compiled.diagnostics) == "3:18 argument-range; 3:37 argument-range");
}

TEST_CASE("what has no known bound is not judged", "[grammar][ranges]") {
  CHECK(rangeWords(kHall + "rule A { size(scope.x, 1m, 1m) Hall(scope.x); } start A; domain finite box(90m);")
            .starts_with("3:37 argument-range: `Hall` is given `r` = 90m, which"));
  const auto found = compileText("sgm 1;\n" + kHall + "param w = 2m;\nrule A { meet { box(3m); Hall(w); } } start A;");
  CHECK(brief(found.diagnostics).find("argument-range") == std::string::npos);
}

TEST_CASE("sizes of parts of scopes are known from above alone", "[grammar][ranges]") {
  const std::string head = kHall + "rule B { Hall(0.5*scope.x); }\nrule A { ";
  const std::string tail = "; } start A; domain finite box(40m);";
  // The parts that fit are 10 m to 20 m long, but the analysis of splits only knows that they are at most as long as
  // the scope.
  CHECK(rangeWords(head + "split x { { ~10m: B; }* }" + tail).find("argument-range") == std::string::npos);
  CHECK(rangeWords(head + "cut treemap { hall 3: B; room 2: { } }" + tail).find("argument-range") == std::string::npos);
  CHECK(rangeWords(head + "wfc 10m { floor 1: B; }" + tail).find("argument-range") == std::string::npos);
  // Values that are out of range for every size of the scope are reported, and so are values that do not depend on this
  // size.
  CHECK(rangeWords(kHall + "rule B { Hall(-1m - scope.x); }\nrule A { split x { { ~10m: B; }* }" + tail)
            .starts_with("3:15 argument-range: `Hall` is given `r` = -"));
  CHECK(rangeWords(kHall + "rule A { split x { { ~10m: Hall(rand(0.5m, 2m)); }* }" + tail)
            .find("3:33 warning argument-range: `Hall` may be given `r` = 0.5m..2m, not all") != std::string::npos);
  // If the size of the scope is known, the check uses it.
  CHECK(rangeWords(kHall + "rule B { Hall(0.5*scope.x); }\nrule A { split x { 1m: B; ~5m: { } }" + tail)
            .starts_with("3:15 argument-range: `Hall` is given `r` = 0.5"));
}

TEST_CASE("what a rule gives itself is its own affair", "[grammar][ranges]") {
  // These recursive rules give themselves ever smaller arguments, even below the range, until a condition, a depth or a
  // minimum size ends the recursion: no messages.
  CHECK(rangeWords("rule Tree(h in 1m..20m) minsize 0.2m -> Leaf { cylinder(0.1*h, h); at(y h) Tree(0.6*h); }\n"
                   "rule Leaf { sphere(0.1m); }\nrule A { Tree(4m); } start A;")
            .empty());
  CHECK(rangeWords("rule Tree(n in 1..6) when n > 0 { sphere(1m); at(y 1m) Tree(n - 1); }\nrule Tree(n) else { }\n"
                   "rule A { Tree(1); } start A;")
            .empty());
  CHECK(rangeWords("rule Tree(n in 1..6) depth 4 -> Leaf { sphere(1m); at(y 1m) Other(n - 1); }\n"
                   "rule Other(n in 1..6) depth 4 -> Leaf { at(y 1m) Tree(0.5*n); }\n"
                   "rule Leaf { sphere(0.1m); }\nrule A { Tree(1); } start A;")
            .empty());
  CHECK(rangeWords("rule Tree(n in 1..6) when n > 0 { sphere(1m); at(y 1m) Tree(n - 1); }\nrule Tree(n) else { }\n"
                   "rule A { Tree(7); } start A;")
            .starts_with("4:15 argument-range: `Tree` is given `n` = 7, which is not within 1..6 |"));
}

TEST_CASE("lets and fields have ranges, too", "[grammar][ranges]") {
  CHECK(rangeWords("let share(t in 0..1) = 2m*t;\nrule A { sphere(share(0.5)); sphere(share(1.5)); } start A;") ==
        "3:43 argument-range: `share` is given `t` = 1.5, which is not within 0..1 | give it a ratio from 0 to 1");
  CHECK(rangeWords("field rough(period in 1cm..1km, amp) = amp*fractal(period);\n"
                   "rule A { displace rough(0m, 0.1m) { sphere(1m); } } start A;")
            .starts_with("3:25 argument-range: `rough` is given `period` = 0m, which is not within 1cm..1km |"));
  CHECK(rangeWords(
            "rule A { field rough(amp in 0m..1m) = amp*fractal(1m); displace rough(rand(1m, 2m)) { sphere(5m); } }\n"
            "start A;")
            .starts_with("2:71 warning argument-range: `rough` may be given `amp` = 1m..2m, not all of which"));
  CHECK(rangeWords("let twice(n in 1..8) = 2*n;\nrule A { for i in 0..3 { sphere(1m*twice(i)); } } start A;")
            .starts_with("3:42 warning argument-range: `twice` may be given `n` = 0..2, not all of which"));
  // The value of a field varies from point to point, so it has no known bounds.
  CHECK(rangeWords("field shaded(t in 0..1) = t;\nrule A { morph(sphere(1m), box(1m), shaded(q.y/1m)); } start A;")
            .empty());
}

TEST_CASE("values are written in the unit of the range", "[grammar][ranges]") {
  const auto given = [](const std::string& range, const std::string& value) {
    const std::string words =
        rangeWords("rule B(v in " + range + ") { box(1m); }\nrule A { B(" + value + "); } start A;");
    const size_t from = words.find("= ") + 2;
    return words.substr(from, words.find(", which") - from);
  };
  CHECK(given("1cm..50cm", "2m") == "200cm");
  CHECK(given("1mm..50mm", "1m/3") == "333.333mm");
  CHECK(given("10deg..80deg", "90deg") == "90deg");
  CHECK(given("0.1rad..1rad", "2rad") == "2rad");
  CHECK(given("0deg..90deg", "-30deg") == "-30deg");
  CHECK(given("0%..100%", "1.2") == "120%");
  CHECK(given("1..12", "0.5") == "0.5");
  CHECK(given("1m2..2m2", "9m2") == "9m2");
  CHECK(given("1m3..2m3", "0m3") == "0m3");
  CHECK(given("1km..2km", "0.5*100m") == "0.05km");
  CHECK(given("1cm..2km", "0.5*10km") == "5000m");
  CHECK(given("1m..2m", "2.0000001m") == "2.0000001m");
  CHECK(given("1m..2m", "123456.78m") == "123457m");
  // A fourth power of metres has no unit name in messages.
  CHECK(given("1m*1m*1m*1m..2m*1m*1m*1m", "3m*1m*1m*1m") == "3");
}

TEST_CASE("what has no end on one side is written so", "[grammar][ranges]") {
  const std::string head = "rule B(v in 1..9) { box(1m); }\nparam far = 1;\nrule A { ";
  CHECK(rangeWords(head + "B(max(far, 10)); } start A;")
            .starts_with("4:12 argument-range: `B` is given `v` = 10 or more, none"));
  CHECK(rangeWords(head + "B(min(far, 0)); } start A;")
            .starts_with("4:12 argument-range: `B` is given `v` = 0 or less, none"));
}

TEST_CASE("a range has two ends of one dimension, made of numbers", "[grammar][ranges]") {
  CHECK(rangeWords("param wide = 2m in 1m..3m;\nrule B(r in 1m..wide) { sphere(r); } rule A { B(1m); } start A;") ==
        "3:17 not-constant: the range of a parameter is made of numbers alone | such as r in 1m..60m");
  CHECK(rangeWords("rule B(r in 1m..60) { sphere(r); } rule A { B(1m); } start A;") ==
        "2:17 unit-mismatch: the high end of a range is a length, and this is a ratio | write `60m`");
  CHECK(rangeWords("rule B(r in 9m..1m) { sphere(r); } rule A { B(1m); } start A;") ==
        "2:13 param-range: the range is reversed | write its low end first");
  CHECK(rangeWords("rule B(r = 90m in 1m..60m) { sphere(r); } rule A { B(); } start A;") ==
        "2:12 param-range: the default of `r` lies outside of its range | widen the range, or choose a default within "
        "it");
  CHECK(rangeWords("rule B(r = 2 in 1m..60m) { box(1m); } rule A { B(); } start A;") ==
        "2:12 unit-mismatch: the default of a parameter is a length, and this is a ratio | write `2m`");
  CHECK(rangeWords("rule B(on = true in 0..1) { box(1m); } rule A { B(); } start A;")
            .starts_with("2:13 type-mismatch: the default of a parameter is a ratio"));
  CHECK(rangeWords("rule B(r in 1m..60m = 2m) { sphere(r); } rule A { B(); } start A;")
            .starts_with("2:21 syntax: a default stands before the range | such as r = 2m in 1m..60m"));
  CHECK(rangeWords("rule B(r in 1m) { sphere(r); } rule A { B(1m); } start A;")
            .starts_with("2:15 syntax: expected `..`"));
  // The literal 0 has any dimension, so a range from 0 to 60m is valid.
  CHECK(rangeWords("rule B(r in 0..60m) { sphere(r); } rule A { B(1m); } start A;").empty());
}

TEST_CASE("a range says what dimension an argument has", "[grammar][ranges]") {
  CHECK(wordsOfBody("Hall(3);") == "3:15 unit-mismatch: `r` of `Hall` is a length, and this is a ratio | write `3m`");
  CHECK(wordsOfBody("Hall(3m); Hall(3);") ==
        "3:25 unit-mismatch: `r` of `Hall` is a length, and this is a ratio | write `3m`");
  CHECK(wordsOfBody("Hall((1m, 2m, 3m));")
            .starts_with("3:15 type-mismatch: `r` of `Hall` is a length, and this is a point"));
  CHECK(rangeWords("let share(t in 0..1) = t;\nrule A { sphere(1m*share(2m)); } start A;")
            .starts_with("3:26 unit-mismatch: `t` of `share` is a ratio, and this is a length"));
  CHECK(
      rangeWords("field f(t in 0..1) = 1m*t;\nrule A { displace f(p.x) amp 1m { sphere(9m); } } start A;") ==
      "3:21 unit-mismatch: `t` of `f` is a ratio, and this is a length | divide it by a length to make a ratio of it");
  CHECK(
      rangeWords("rule A { field f(t in 0..1) = 1m*t; displace f(2m) amp 1m { sphere(9m); } } start A;") ==
      "2:48 unit-mismatch: `t` of `f` is a ratio, and this is a length | divide it by a length to make a ratio of it");
  // The body of a rule that nothing calls is checked, too.
  CHECK(rangeWords("rule A { box(1m); } start A;\nrule B(r in 1..9) { sphere(r); }").find("3:28 unit-mismatch") !=
        std::string::npos);
}

TEST_CASE("the range of a rule stands in its first head", "[grammar][ranges]") {
  const std::string rest = "rule A { B(0m); } start A;";
  const std::string words = "2:12 argument-range: `B` is given `r` = 0m, which";
  const auto at = [&](const std::string& heads) {
    const std::string all = rangeWords(rest + "\n" + heads);
    return all.substr(0, std::min(all.size(), words.size()));
  };
  CHECK(at("rule B(r in 1m..9m) weight 2 { sphere(r); }\nrule B(r) weight 1 { box(r); }") == words);
  CHECK(at("rule B(r in 1m..9m) { sphere(r); }\nrule B(r in 1m..900cm) lod 2m { box(r); }") == words);
  CHECK(at("rule B(r in 1m..9m) when r > 5m { sphere(r); }\nrule B(s) else { box(s); }") == words);
  CHECK(at("morphic B(r in 1m..9m) : sphere(r) -> box(r) by 0.5;") == words);
  CHECK(rangeWords(
            "rule A { B(2m); } start A;\nrule B(r in 1m..9m) { sphere(r); }\nrule B(r in 1m..8m) lod 2m { box(r); }") ==
        "4:8 param-range: the range of `r` of `B` differs from that in the first head | the range in the first head "
        "holds for all heads | note: the first head is at test.sgm:3:1");
  CHECK(
      rangeWords("rule A { B(2m); } start A;\nrule B(r) { sphere(r); }\nrule B(r in 1m..8m) lod 2m { box(r); }")
          .starts_with(
              "4:8 param-range: `r` of `B` has a range here and none in the first head | the range in the first head"));
}

TEST_CASE("the caller of an import is told, and the caller of the library for what the library does",
          "[grammar][ranges]") {
  MapResolver files;
  files.files["caves.sgm"] = "sgm 1;\n" + kHall + "rule Two(r) { Hall(0.5*r); }\n";
  CHECK(rangeWords("import \"caves.sgm\" as caves;\nrule A { caves.Hall(0m); } start A;", &files)
            .starts_with("3:21 argument-range: `caves.Hall` is given `r` = 0m, which"));
  // An error in an imported file is reported at its place in that file, unless the file belongs to the standard
  // library.
  const CompileResult inner =
      compileText("sgm 1;\nimport \"caves.sgm\" as caves;\nrule A { caves.Two(1m); } start A;", &files);
  REQUIRE(inner.diagnostics.size() == 1);
  CHECK(inner.diagnostics[0].file == "caves.sgm");
  CHECK(inner.diagnostics[0].line == 3);
  CHECK(inner.diagnostics[0].column == 20);
  const std::string karst = "import \"std/karst.sgm\" as karst;\nrule A { ";
  CHECK(rangeWords(karst + "karst.Hall(0m); } start A;") ==
        "3:21 argument-range: `karst.Hall` is given `r` = 0m, which is not within 1m..60m | give it a length from 1m "
        "to 60m");
  CHECK(rangeWords(karst + "karst.Canyon((0m, 0m, 0m), (70m, -4m, 20m), 2m, deep 900m); } start A;")
            .starts_with("3:63 argument-range: `karst.Canyon` is given `deep` = 900m, which is not within 0.5m..200m"));
  // Rules of the standard library's facade module, with scopes that are too small for them.
  const std::string facade = "import \"std/facade.sgm\" as facade;\nrule A { ";
  CHECK(rangeWords(facade + "size(0.05m, 4m, 0m) facade.Shop; } start A;") ==
        "3:30 argument-range: `facade.Shop` gives `Frame` `w` = 0m here, which is not within 0.1m..20m | give it other "
        "arguments, or a scope of another size | note: the call is at std/facade.sgm:389:3");
}

TEST_CASE("a range is printed as it is written, and changes no world", "[grammar][ranges]") {
  const auto formatted = [](const std::string& text) {
    const FormatResult result = formatGrammar(text, "test.sgm");
    REQUIRE(result.text);
    return *result.text;
  };
  const std::string text =
      "sgm 1;\n"
      "let share(t = 50% in 0..1) = t;\n"
      "field rough(amp in 1cm..2*50cm) = amp*fractal(1m);\n"
      "start A;\n\n"
      "rule A { B(2m, share()); }\n"
      "rule B(r in 1m..60m, thick = 0.12 in 0.02..1, on = true) { displace rough(0.1m) { sphere(r); } }\n"
      "morphic C(t = 0 in -1..1) : sphere(1m) -> box(1m) by t;\n";
  CHECK(formatted(text) == text);
  CHECK(formatted("sgm 1;start A ;rule A( r=2m   in 1m .. 3m){sphere(r);}") ==
        "sgm 1;\nstart A;\nrule A(r = 2m in 1m..3m) { sphere(r); }\n");
  const CompileResult with = compileText("sgm 1; start A; rule A { B(2m); } rule B(r in 1m..3m) { sphere(r); }");
  const CompileResult without = compileText("sgm 1; start A; rule A { B(2m); } rule B(r) { sphere(r); }");
  REQUIRE((with.program && without.program));
  CHECK(with.program->hash == without.program->hash);
  CHECK(with.program->canonical != without.program->canonical);
}

TEST_CASE("editors show a parameter with its default and its range", "[grammar][ranges]") {
  const std::string text =
      "sgm 1;\nrule Hall(r in 1m..60m, thick = max(0.1, 0.2) in 0.02..1, on) { sphere(r*thick); }\n";
  const Declarations declarations = declarationsOf(text);
  const auto head = [&](std::string_view name) {
    const auto found = declarations.find(name, static_cast<uint32_t>(text.find("sphere")));
    return found.empty() ? std::string() : found[0]->head;
  };
  CHECK(head("r") == "parameter r in 1m..60m");
  CHECK(head("thick") == "parameter thick = max(0.1, 0.2) in 0.02..1");
  CHECK(head("on") == "parameter on");
  CHECK(head("Hall") == "rule Hall(r in 1m..60m, thick = max(0.1, 0.2) in 0.02..1, on)");
}

TEST_CASE("an axis is a letter, whatever numbers have its name", "[grammar][ranges]") {
  CHECK(rangeWords("rule A { Bar(2m, 1m, 30deg); } start A;\n"
                   "rule Bar(x, y, z) { at(y 1m) rot(x, z) mirror(y) at(x, y, 0m) box(x, y, 1m); }")
            .empty());
  // A vector named x takes precedence over the axis x.
  CHECK(rangeWords("rule A { let x = (0m, 1m, 0m); rot(x, 30deg) box(1m); } start A;").empty());
  const CompileResult turned = compileText("sgm 1; start A; rule A { let x = (0m, 1m, 0m); rot(x, 30deg) box(1m); }");
  REQUIRE(turned.program);
  CHECK(turned.program->ast.xforms[0].axis == 3);
}
