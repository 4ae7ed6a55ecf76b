// Tests messages about grammars beyond the limits of size and depth, and about imports, word for word.

#include "messages.h"

using namespace sgm;
using namespace sgm::test;

namespace {

std::string times(int count, const std::string& text) {
  std::string out;
  for (int i = 0; i < count; ++i) out += text;
  return out;
}

/// Repeats the text `count` times; each # in it becomes the number of the repetition.
std::string numbered(int count, const std::string& text) {
  std::string out;
  for (int i = 0; i < count; ++i)
    for (const char c : text) out += c == '#' ? std::to_string(i) : std::string(1, c);
  return out;
}

template <class Change>
CompileResult compileWithin(const std::string& text, Change change) {
  MapResolver resolver;
  resolver.files["a.sgm"] = "sgm 1; import \"b.sgm\" as b; let width = 2m; rule Arch { sphere(1m); }";
  resolver.files["b.sgm"] = "sgm 1;";
  resolver.files["loop.sgm"] = "sgm 1; import \"loop.sgm\" as me;";
  resolver.files["all.sgm"] =
      "sgm 1; param a = 1; seed 1; domain finite; layer b cell 8m reach 4m { start B; } start B;\n"
      "override \"B\" { } report volume; expect watertight;\nrule B { }";
  resolver.files["empty.sgm"] = "sgm 1;";
  CompileOptions options;
  options.resolver = &resolver;
  change(options.limits);
  return compileGrammar(text, "test.sgm", options);
}

CompileResult compiledHere(const std::string& text) {
  return compileWithin(text, [](CompileLimits&) {});
}

void checkAll(const CompileResult& result, const std::string& expected) {
  INFO(renderDiagnostics(result));
  CHECK(inWords(result) == expected);
  for (const Diagnostic& d : result.diagnostics) CHECK((d.code == "too-many-errors" || saysWhatToWrite(d)));
}

}  // namespace

TEST_CASE("messages: limits of the text", "[grammar][messages]") {
  const std::string start = "sgm 1; start A; rule A { ";
  checkAll(compileWithin("sgm 1; start A; rule A { }", [](CompileLimits& l) { l.text_bytes = 10; }),
           "1:1 too-large: the text is longer than 10 bytes | move rules into a file of their own and import it");
  checkAll(compileWithin("sgm 1; a b c", [](CompileLimits& l) { l.nodes = 4; }),
           "1:10 too-large: the text has more than 4 words and signs | use loops and rules to say the same in fewer");
  checkAll(compileWithin(start + times(15, "B; ") + "} rule B { }", [](CompileLimits& l) { l.nodes = 46; }),
           "1:71 too-large: the text has more than 46 expressions and statements | use loops and rules to say the same "
           "in fewer");
  std::string deep;
  for (int i = 1; i < 45; ++i)
    deep += "let a" + std::to_string(i) + " = " + times(10, "-") + "a" + std::to_string(i - 1) + "; ";
  checkAll(compiledHere("sgm 1; start A; let a0 = 1; " + deep + "rule A { repeat a44 { } }"),
           "1:202 too-deep: lets, fields and expressions are nested too deep | use fewer levels of lets");
  checkAll(compileWithin(start + "{ { } } }", [](CompileLimits& l) { l.nesting = 3; }),
           "1:28 too-deep: this is nested more than 3 deep | name a part of it: a value with let, a block with a rule");
  checkAll(compileWithin("sgm 1; a; b;", [](CompileLimits& l) { l.diagnostics = 1; }),
           "1:8 syntax: expected a declaration, found `a` | shapes stand in rules: rule Name { ... }\n1:11 "
           "too-many-errors: there are more than 1 errors; the rest are left out");
  checkAll(compiledHere("sgm 1; let " + times(65, "a") + " = 1;"),
           "1:12 too-large: a name has at most 64 letters | shorten it");
  checkAll(compiledHere(start + "tag \"" + times(1025, "a") + "\"; }"),
           "1:30 bad-text: a text has at most 1024 bytes | shorten it");
  checkAll(compiledHere("sgm 1; let a = 1" + times(300, " + 1") + ";"),
           "1:16 too-deep: the expression has more than 128 steps | name a part of it with let");
}

TEST_CASE("messages: limits of what is declared", "[grammar][messages]") {
  const std::string start = "sgm 1; start A; rule A { ";
  checkAll(compiledHere(start + numbered(4096, "{ mat m#; }") + " }"),
           "1:56248 too-large: the program has more than 4096 different names of one kind | materials, tags and "
           "anchors may have that many names each; use some names again");
  checkAll(compiledHere("sgm 1; domain infinite; " + numbered(257, "layer l# cell 8m reach 1m { start A; } ") +
                        "rule A { }"),
           "1:10417 too-large: the program has more than 256 layers | put rules of several layers into one");
  std::string chain = "sgm 1; start A; let a0 = 1m;", fields = start;
  for (int i = 1; i < 60; ++i) {
    const std::string n = std::to_string(i), before = std::to_string(i - 1);
    chain.append(" let a").append(n).append(" = a").append(before).append(";");
    fields.append("field f").append(n).append("(x) = ");
    fields.append(i == 1 ? "x" : "f" + before + "(x)").append("; ");
  }
  checkAll(compiledHere(chain + " rule A { sphere(a59); }"),
           "1:186 too-deep: lets and fields use each other more than 48 deep | combine some of them");
  checkAll(compiledHere(fields + "displace f59(1m) { sphere(1m); } }"),
           "1:271 too-deep: lets and fields use each other more than 48 deep | combine some of them");
  checkAll(compiledHere("sgm 1; start A; rule A { }" + numbered(20001, "let a#=1;")),
           "1:248928 too-large: the program has more than 20000 lets and fields, counted once for each kind of "
           "arguments | write fewer of them, or call them with arguments of fewer kinds");
}

TEST_CASE("messages: rules too many to follow", "[grammar][messages]") {
  const auto few = [](CompileLimits& l) { l.bound_steps = 20; };
  const std::string rules =
      "rule A { B(rand(1m, 2m)); B(rand(2m, 3m)); B(rand(1m, 3m)); }\n"
      "rule B(r) { sphere(r); sphere(r/2); sphere(r/3); }";
  checkAll(compileWithin("sgm 1; start A;\n" + rules, few),
           "3:37 reach: cannot prove reach: `sphere` may extend without bound | the rules are too many or too deep to "
           "follow; bound their recursion");
  checkAll(compileWithin("sgm 1; domain infinite; layer a cell 8m reach 4m { start A; }\n" + rules, few),
           "3:37 reach: cannot prove reach: `sphere` may extend without bound from its cell, layer `a` declares reach "
           "4 m | the rules are too many or too deep to follow; bound their recursion");
}

TEST_CASE("messages: imports", "[grammar][messages]") {
  const auto importing = [](const std::string& file) {
    return "sgm 1; import \"" + file + "\" as d; start A; rule A { }";
  };
  checkAll(compileWithin(importing("a.sgm"), [](CompileLimits& l) { l.files = 1; }),
           "1:15 import-limit: the program imports more than 1 files | combine some of them");
  checkAll(compileWithin(importing("a.sgm"), [](CompileLimits& l) { l.import_depth = 1; }),
           "1:15 import-limit: imports are nested more than 1 deep | combine some of the files");
  checkAll(
      compileWithin(importing("a.sgm"), [](CompileLimits& l) { l.text_bytes = 60; }),
      "1:15 import-limit: `a.sgm` is too long | a file has at most 60 bytes, and all files together at most 4194304");
  checkAll(compiledHere(importing("c.sgm")),
           "1:15 import-missing: cannot import `c.sgm`: no such file | a path is relative to the folder of the file "
           "that imports it");
  checkAll(compiledHere(importing("loop.sgm")),
           "1:15 import-cycle: `loop.sgm` imports itself in a circle | move what both files need into a third");
  checkAll(compiledHere(importing("all.sgm")),
           "1:14 import-content: an imported file has no `param` | imports give lets, fields and rules\n"
           "1:21 import-content: an imported file has no `seed` | imports give lets, fields and rules\n"
           "1:29 import-content: an imported file has no `domain` | imports give lets, fields and rules\n"
           "1:44 import-content: an imported file has no `layer` | imports give lets, fields and rules\n"
           "1:82 import-content: an imported file has no `start` | imports give lets, fields and rules\n"
           "2:1 import-content: an imported file has no `override` | imports give lets, fields and rules\n"
           "2:18 import-content: an imported file has no `report` | imports give lets, fields and rules\n"
           "2:33 import-content: an imported file has no `expect` | imports give lets, fields and rules");
  checkAll(compiledHere("sgm 1; import \"a.sgm\" as d; start d.Arhc;"),
           "1:35 unknown-name: `d` has no `Arhc` | did you mean `Arch`?");
  checkAll(compiledHere("sgm 1; import \"a.sgm\" as d; start A; rule A { d.Vault; }"),
           "1:47 unknown-name: `d` has no `Vault` | it has width, Arch");
  checkAll(compiledHere("sgm 1; import \"empty.sgm\" as d; start A; rule A { d.Vault; }"),
           "1:51 unknown-name: `d` has no `Vault` | it declares nothing");
}
