// Tests the hash of a program's meaning: two programs have equal hashes if and only if their printed meanings are
// equal.

#include <random>
#include <unordered_map>

#include "base/hash.h"
#include "compile_text.h"
#include "grammar/identity/former_hash.h"
#include "grammar/identity/hash_meaning.h"
#include "grammar/print/printer.h"
#include "parsed_text.h"
#include "rounds.h"
#include "seed.h"

using namespace sgm;
using namespace sgm::test;

namespace {

/// Checks for all texts that were passed to hear() that equal printed meanings have equal hashes, and that equal hashes
/// have equal printed meanings.
class Judge {
 public:
  /// Adds a text to the comparison. Returns false if the text has errors.
  bool hear(const std::string& text) {
    const Parsed file = parsed(text);
    if (!file.program) return false;
    const uint64_t hash = hashMeaning(*file.program, file.syntax);
    const std::string printed = printMeaning(*file.program, file.syntax);
    const auto [of_text, is_new_text] = hashes_.try_emplace(hashText(printed), hash);
    const auto [of_hash, is_new_hash] = texts_.try_emplace(hash, hashText(printed));
    if (of_text->second != hash || of_hash->second != hashText(printed)) {
      UNSCOPED_INFO("printed " << printed << "\nof " << text);
      CHECK(of_text->second == hash);
      CHECK(of_hash->second == hashText(printed));
    }
    ++heard_;
    return true;
  }
  size_t heard() const { return heard_; }
  size_t meanings() const { return hashes_.size(); }

 private:
  std::unordered_map<uint64_t, uint64_t> hashes_, texts_;
  size_t heard_ = 0;
};

/// Changes one word or sign of a text; some changes keep the text's meaning.
class Mutator {
 public:
  explicit Mutator(uint32_t seed) : random_(seed) {}

  std::string changed(const std::string& text) {
    DiagnosticSink unread(1);
    const LexResult lexed = lex(text, 0, 1u << 20, unread, std::pmr::get_default_resource());
    const auto wordAt = [&](size_t i) {
      const Span& span = lexed.tokens[i].span;
      return text.substr(span.begin, span.end - span.begin);
    };
    const size_t count = lexed.tokens.size() - 1;
    const size_t i = draw(count);
    size_t other = draw(count);
    for (int tries = 0; tries < 20 && lexed.tokens[other].kind != lexed.tokens[i].kind; ++tries) other = draw(count);
    const bool number = lexed.tokens[i].kind == Tok::number;
    std::string word = wordAt(i);
    switch (draw(12)) {
      case 0:
      case 10:
      case 11:
        word = wordAt(other);
        break;
      case 1:
        word.clear();
        break;
      case 2:
        word += ' ' + word;
        break;
      case 3:
        word += " // a comment\n";
        break;
      case 4:
        word = number ? "(" + word + ")" : word + "\n\n  ";
        break;
      case 5:
        if (number && word.find('.') != std::string::npos && word.back() == 'm') word.insert(word.size() - 1, "0");
        break;
      case 6:
        word = std::to_string(draw(9)) + (number ? "m" : "");
        break;
      case 7:
        word += ";";
        break;
      case 8:
        word += lexed.tokens[i].kind == Tok::word ? "_" : " " + wordAt(other);
        break;
      default: {
        static constexpr std::string_view kWords[] = {
            "power", "lerp", "smooth 1m", "amp 2m", "turn", "snap 1m", "from 1m", "when true", "weight 2", "lod 4m",
            "~",     "()",   "animated",  "\"t\"",  "tag",  "inner;",  "top a",   "up",        "not",      "-"};
        word += ' ';
        word += kWords[draw(std::size(kWords))];
        word += ' ';
      }
    }
    const Span& span = lexed.tokens[i].span;
    return text.substr(0, span.begin) + word + text.substr(span.end);
  }

 private:
  size_t draw(size_t below) { return random_() % below; }
  std::mt19937 random_;
};

}  // namespace

TEST_CASE("texts have equal hashes exactly if their printed meanings are equal", "[grammar][identity]") {
  const unsigned seed = testSeed();
  CAPTURE(seed);
  Mutator mutator(seed);
  Judge judge;
  size_t whole = 0, tried = 0;
  for (const std::string& text : grammarTexts()) {
    CHECK(judge.hear(text));
    ++whole;
    // Long texts get fewer changes, because each takes longer.
    const unsigned often = rounds(text.size() < 4000 ? 120 : 24);
    for (unsigned i = 0; i < often; ++i, ++tried) {
      std::string other = mutator.changed(text);
      if (!judge.hear(other)) continue;
      if (i % 4 == 0) judge.hear(mutator.changed(other));
    }
  }
  CAPTURE(tried, judge.heard(), judge.meanings());
  CHECK(judge.heard() > whole + tried / 4);       // many changed texts are valid programs
  CHECK(judge.meanings() > judge.heard() / 4);    // many changed texts have a new meaning
  CHECK(judge.heard() > judge.meanings() + 200);  // many changed texts have the meaning of an earlier text
}

TEST_CASE("each member of a statement is a part of the meaning", "[grammar][identity]") {
  // Variants of one statement with different meanings; a variant that begins with "=" means the same as an earlier one.
  const std::vector<std::vector<std::string>> statements = {
      {"A;", "=A();", "B;", "a.A;", "A(1);", "A(x 1);", "A(y 1);", "A(1, 1);", "A(1m);", "A(1deg);", "A(true);"},
      {"union A;", "cut A;", "meet A;", "union smooth 1m A;", "union smooth 2m A;", "union { A; }", "sum A;"},
      {"morph(A, B, 1);", "=morph(A, B, 1) lerp;", "morph(A, B, 1) power;", "morph(B, A, 1);", "morph(A, B, 2);",
       "morph({ A; }, B, 1);"},
      {"displace f A;", "displace g A;", "displace f amp 1m A;", "displace f amp 2m A;", "displace f B;", "warp f A;"},
      {"at(1m, 0, 0) A;", "at(2m, 0, 0) A;", "rot(x, 1deg) A;", "at(x 1m) A;", "at(1m, 0, 0) at(1m, 0, 0) A;",
       "at(1m, 0, 0) { at(1m, 0, 0) A; }"},
      {"repeat 2 A;", "repeat 3 A;", "repeat 2 at(1m, 0, 0) A;", "repeat 2 { at(1m, 0, 0) A; }"},
      {"for i in 0..2 A;", "for j in 0..2 A;", "for i in 1..2 A;", "for i in c A;", "for i in 0..2 B;"},
      {"scatter 2 on disc(1m) A;", "scatter 3 on disc(1m) A;", "scatter 2 on shell(1m) A;", "scatter 2 on disc(2m) A;",
       "scatter poisson(2) on disc(1m) A;", "scatter poisson(2) A;", "scatter 2 on disc(1m) probe up 1m of n A;",
       "scatter 2 on disc(1m) probe down 1m of n A;", "scatter 2 on disc(1m) probe up 2m of n A;",
       "scatter 2 on disc(1m) probe up 1m of k A;", "scatter 2 on disc(1m) probe up 1m of n gap g within 1m A;",
       "scatter 2 on disc(1m) probe up 1m of n gap h within 1m A;",
       "scatter 2 on disc(1m) probe up 1m of n gap g within 2m A;", "scatter 2 on disc(1m) when true A;",
       "scatter 2 on disc(1m) when false A;", "scatter 2 on disc(1m) B;"},
      {"let a = 1;", "let b = 1;", "let a = 2;", "=let a = 100%;", "field a = 1;", "field a(b) = 1;",
       "=field a(b in 1..2) = 1;", "field a(b = 1) = 1;", "field a = 2;"},
      {"mat a;", "mat b;", "tag \"a\";", "tag \"b\";", "anchor a;", "anchor b;", "anchor a \"a\";", "anchor a \"\";"},
      {"split x { 1m: A; }", "split y { 1m: A; }", "split x snap 1m { 1m: A; }", "split x snap 2m { 1m: A; }",
       "split x { 2m: A; }", "split x { ~1m: A; }", "split x { { 1m: A; }* }", "split x { 1m: B; }",
       "split x { 1m: A; 1m: A; }", "split x { { 1m: A; }* 1m: A; }"},
      {"snap x 1m A;", "snap y 1m A;", "snap x 2m A;", "snap x 1m from 1m A;", "snap x 1m from 2m A;", "snap x 1m B;"},
      {"comp { front: A; }", "comp { back: A; }", "comp { front: B; }", "comp { front: A; back: A; }"},
      {"treemap { a 1: A; }", "=treemap() { a 1: A; }", "treemap(wall 1m) { a 1: A; }", "treemap { b 1: A; }",
       "treemap { a 2: A; }", "treemap { a 1: A; corridor: A; }", "treemap { a 1: A; facade: A; }",
       "treemap { a 1: A; link a b by door; }", "treemap { a 1: A; link b a by door; }",
       "treemap { a 1: A; link a b by door(1m); }"},
      {"detail 1m A;", "detail 2m A;", "detail 1m B;"},
      {"footprint rect(1m, 1m) as a;", "footprint regular(1m, 1m) as a;", "footprint rect(2m, 1m) as a;",
       "footprint rect(1m, 1m) as b;", "footprint merge 2 rect(1m, 1m) as a;", "footprint merge 3 rect(1m, 1m) as a;"},
      {"extrude 1m of a;", "extrude 2m of a;", "extrude 1m of b;", "extrude 1m of a { }", "extrude 1m of a { A; }"},
      {"roof flat(1m);", "roof hip(1m);", "roof flat(2m);", "roof flat(1m) of a;", "roof flat(1m) of b;"},
      {"fit a;", "fit b;", "fit a stretch x 1m..2m;", "fit a repeat x 1m..2m;", "fit a stretch y 1m..2m;",
       "fit a stretch x 0m..2m;", "fit a stretch x 1m..3m;", "fit a stretch x 1m..2m stretch y 1m..2m;"},
      {"wfc 1m { a 1: A; }", "wfc 2m { a 1: A; }", "wfc 1m { b 1: A; }", "wfc 1m { a 2: A; }",
       "wfc 1m { a 1 turn: A; }", "wfc 1m { a 1, left b: A; }", "wfc 1m { a 1, right b: A; }",
       "wfc 1m { a 1, left c: A; }", "wfc 1m { a 1, left b or c: A; }", "wfc 1m { a 1, left b meets c: A; }",
       "wfc 1m { a 1: A; border left b; }", "wfc 1m { a 1: A; border right b; }", "wfc 1m { a 1: B; }"},
      {"{ }", "{ A; }", "{ { A; } }", "{ A; A; }"}};
  Judge judge;
  for (const std::vector<std::string>& variants : statements) {
    size_t known = judge.meanings();
    for (const std::string& variant : variants) {
      CAPTURE(variant);
      const bool is_same = variant.front() == '=';
      CHECK(judge.hear("sgm 1; rule R { " + variant.substr(is_same) + " }"));
      known += is_same ? 0 : 1;
      CHECK(judge.meanings() == known);
    }
  }
}

TEST_CASE("each part of a declaration that changes what is derived is a part of the meaning", "[grammar][identity]") {
  const std::vector<std::string> declarations = {
      "",
      "=units m;",
      "=expect volume in 1m3..2m3;",
      "import \"a.sgm\" as a;",
      "import \"b.sgm\" as a;",
      "import \"a.sgm\" as b;",
      "param a = 1;",
      "=param a = 1 animated \"text\";",
      "=param a = (100%);",
      "param b = 1;",
      "param a = 2;",
      "param a = 1 in 0..1;",
      "param a = 1 in 0..2;",
      "param a = 1 in 1..1;",
      "seed 1;",
      "seed 2;",
      "seed \"1\";",
      "let a = 1;",
      "let b = 1;",
      "let a = 2;",
      "let a() = 1;",
      "let a(b) = 1;",
      "let a(c) = 1;",
      "let a(b = 1) = 1;",
      "field a = 1;",
      "=field a() = 1;",
      "field a(b) = 1;",
      "domain infinite;",
      "domain finite;",
      "domain infinite axes xz;",
      "=domain infinite axes zx;",
      "domain infinite axes xyz;",
      "domain infinite solid;",
      "domain infinite empty;",
      "domain infinite solid a;",
      "domain infinite solid b;",
      "domain infinite output density;",
      "domain infinite output density edge 1m;",
      "domain infinite output density edge 2m;",
      "domain finite box(1m);",
      "domain finite box(2m);",
      "domain finite box();",
      "layer a cell 1m reach 1m { start A; }",
      "layer b cell 1m reach 1m { start A; }",
      "layer a cell 2m reach 1m { start A; }",
      "layer a cell 1m reach 2m { start A; }",
      "layer a cell 1m reach 1m { start B; }",
      "layer a cell 1m reach 1m detail 1m { start A; }",
      "layer a cell 1m reach 1m detail 2m { start A; }",
      "layer a cell 1m reach 1m uses b { start A; }",
      "layer a cell 1m reach 1m uses c { start A; }",
      "layer a cell 1m reach 1m uses b, c { start A; }",
      "start A;",
      "start B;",
      "rule A { }",
      "=rule A() { }",
      "rule B { }",
      "rule A(a) { }",
      "=rule A(a in 1..2) { }",
      "rule A(a = 1) { }",
      "rule A { B; }",
      "rule A else { }",
      "rule A when true { }",
      "rule A when false { }",
      "rule A weight 1 { }",
      "rule A weight 2 { }",
      "rule A depth 1 -> B { }",
      "rule A depth 2 -> B { }",
      "rule A depth 1 -> C { }",
      "rule A minsize 1 -> B { }",
      "rule A minsize 2 -> B { }",
      "rule A minsize 1 -> C { }",
      "rule A lod 1m { }",
      "rule A lod 2m { }",
      "rule A lod 2m weight 1 { }",
      "=rule A weight 1 lod 2m { }",
      "rule A { morph(B, C, 1); }",
      "morphic A : B -> C by 1;",
      "=morphic A : B -> C by 1 lerp;",
      "morphic A : B -> C by 1 power;",
      "morphic A(a) : B -> C by 1;",
      "override \"A\" { }",
      "override \"B\" { }",
      "override tag \"A\" { }",
      "override \"A\" { inner; }",
      "override \"A\" { inner; inner; }",
      "let a = b + c + d;",
      "=let a = (b + c) + d;",
      "let a = b + (c + d);",
      "let a = b - c;",
      "let a = c - b;",
      "let a = -b;",
      "let a = not b;",
      "let a = if b then c else d;",
      "let a = if b then d else c;",
      "let a = (b, c);",
      "let a = (b, c, d);",
      "let a = b.x;",
      "let a = b.y;",
      "let a = b.x();",
      "let a = b(c);",
      "let a = b(d c);",
      "let a = query clear of n;",
      "let a = query inside of n;",
      "let a = query inside 1m of n;",
      "let a = query inside 2m of n;",
      "let a = query inside of k;",
      "let a = \"b\";",
  };
  Judge judge;
  size_t known = 0;
  for (const std::string& declaration : declarations) {
    CAPTURE(declaration);
    const bool is_same = !declaration.empty() && declaration.front() == '=';
    CHECK(judge.hear("sgm 1; " + declaration.substr(is_same)));
    known += is_same ? 0 : 1;
    CHECK(judge.meanings() == known);
  }
}

TEST_CASE("a program has the hash of version 0.2 still", "[grammar][identity]") {
  // The expected hashes were printed by `sgm check --json` of version 0.2.
  MapResolver resolver;
  resolver.files["parts/a.sgm"] = "sgm 1;\nlet thick = 25cm;\nrule Wall(h in 1m..9m) { box(thick, h, 2m); }\n";
  const CompileResult small = compileText("sgm 1;\nstart A;\nrule A { sphere(1m); }\n");
  const CompileResult larger = compileText(
      "sgm 1;\nimport \"parts/a.sgm\" as a;\nparam h = 3m in 2m..4m animated \"height\";\nstart House;\n"
      "rule House { repeat 4 rot(y, 90deg) at(2m, 0m, 0m) a.Wall(h); mat brick; }\nexpect watertight;\n",
      &resolver);
  REQUIRE(small.program);
  REQUIRE(larger.program);
  CHECK(formerHash(*small.program) == 0x765a13d6e73ba433u);
  CHECK(formerHash(*larger.program) == 0xc2300d1966c31feau);
  CHECK(formerHash(*larger.program) == 0xc2300d1966c31feau);
  CHECK(small.program->hash != formerHash(*small.program));
  CHECK(small.program->hash != larger.program->hash);
}
