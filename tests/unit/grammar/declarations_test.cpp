// Tests the information about names and words that editors show: it must agree with the compiler, also in unfinished
// texts.

#include <filesystem>
#include <fstream>
#include <random>
#include <sstream>

#include "catch.h"
#include "compile_text.h"
#include "grammar/help/declarations.h"
#include "grammar/help/word_help.h"
#include "grammar/syntax/builtins.h"
#include "grammar/syntax/keywords.h"
#include "rounds.h"
#include "seed.h"

using namespace sgm;
using namespace sgm::test;

namespace {

/// Sample texts, and the folders that contain them.
std::vector<std::pair<std::string, std::filesystem::path>> sampleTexts() {
  std::vector<std::pair<std::string, std::filesystem::path>> texts;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(SGM_SOURCE_DIR "/samples/grammars")) {
    if (entry.path().extension() != ".sgm") continue;
    std::stringstream text;
    text << std::ifstream(entry.path()).rdbuf();
    texts.emplace_back(text.str(), entry.path().parent_path());
  }
  return texts;
}

/// The kinds of declaration to which a resolved name may refer; nullopt for built-in names.
std::optional<std::vector<NameKind>> kindsOf(Ref ref) {
  using Kinds = std::vector<NameKind>;
  switch (ref) {
    case Ref::parameter:
      return Kinds{NameKind::parameter};
    case Ref::let:
      return Kinds{NameKind::let};
    case Ref::field:
      return Kinds{NameKind::field, NameKind::local};
    case Ref::rule:
      return Kinds{NameKind::rule, NameKind::morphic};
    case Ref::local:
      return Kinds{NameKind::local};
    default:
      return std::nullopt;
  }
}

void checkRanges(const Declarations& declarations, std::string_view text) {
  for (const DeclaredName& name : declarations.names) {
    const auto size = static_cast<uint32_t>(text.size());
    CHECK((name.at.begin < name.at.end && name.at.end <= size));
    CHECK((name.whole.begin <= name.at.begin && name.at.end <= name.whole.end && name.whole.end <= size));
    CHECK(name.known.end <= size);
    CHECK(text.substr(name.at.begin, name.at.end - name.at.begin) == name.name);
  }
}

}  // namespace

TEST_CASE("names of the samples are declared where the compiler finds them", "[grammar][editor][costly]") {
  size_t checked = 0;
  for (const auto& [text, folder] : sampleTexts()) {
    FolderResolver files(folder);
    const CompileResult compiled = compileText(text, &files);
    REQUIRE(compiled.program);
    const Declarations declarations = declarationsOf(text);
    checkRanges(declarations, text);
    for (const ExprNode& n : compiled.program->ast.exprs) {
      const auto kinds = kindsOf(n.ref);
      if (!kinds || n.span.file != 0 || n.qualifier != kNoId || n.name == kNoId) continue;
      const auto word = wordAt(text, n.span.begin);
      REQUIRE(word);
      // In the call of a method, the span begins with the value on which the method is called, not with the method's
      // name: skip these calls.
      if (word->word != compiled.program->text(n.name)) continue;
      INFO(text.substr(n.span.begin, n.span.end - n.span.begin) << " in line " << n.span.line);
      const auto found = declarations.find(word->word, n.span.begin);
      REQUIRE_FALSE(found.empty());
      for (const DeclaredName* name : found) CHECK(std::find(kinds->begin(), kinds->end(), name->kind) != kinds->end());
      ++checked;
    }
  }
  CHECK(checked > 500);
}

TEST_CASE("texts that are not done have declarations too", "[grammar][editor]") {
  const unsigned seed = testSeed();
  CAPTURE(seed);
  std::mt19937 random(seed);
  const auto texts = sampleTexts();
  for (unsigned round = 0; round < rounds(400); ++round) {
    std::string text = texts[random() % texts.size()].first;
    for (unsigned edit = static_cast<unsigned>(random() % 4); edit > 0; --edit) {
      const size_t at = random() % text.size();
      if (random() % 2 == 0)
        text.erase(at, random() % 20);
      else
        text.insert(at, 1, "{}()\";/.\n\xF0x"[random() % 11]);
    }
    if (random() % 2 == 0) text.resize(random() % text.size());
    CAPTURE(round);
    checkRanges(declarationsOf(text), text);
    for (int k = 0; k < 20; ++k) {
      const auto offset = static_cast<uint32_t>(random() % (text.size() + 1));
      const auto word = wordAt(text, offset);
      if (!word) continue;
      CHECK((word->at.begin <= offset && offset <= word->at.end && word->at.end <= text.size()));
      CHECK(text.substr(word->at.begin, word->at.end - word->at.begin) == word->word);
    }
  }
}

TEST_CASE("heads and comments are told with a name", "[grammar][editor]") {
  const std::string text =
      "sgm 1;\n// Not of it.\n\n// How wet\n// it is.\nparam wet = 50% in 0%..100% \"wetness\";\n// A hall\n// of "
      "rock.\n"
      "rule Hall(r, s = 2m)\n  when r > 1m weight 3 {\n  let t = 2*r; for i in 0..3 { sphere(t*i); }\n}\nrule Hall(r, "
      "s) "
      "else { box(r); }\nlet f(a) = 2*a;";
  const Declarations declarations = declarationsOf(text);
  const auto heads = declarations.find("Hall", 0);
  REQUIRE(heads.size() == 2);
  CHECK(heads[0]->head == "rule Hall(r, s = 2m) when r > 1m weight 3");
  CHECK(heads[0]->doc == "A hall\nof rock.");
  CHECK(heads[1]->head == "rule Hall(r, s) else");
  CHECK(heads[1]->doc.empty());
  CHECK(declarations.find("wet", 0)[0]->doc == "wetness");
  const auto inside = static_cast<uint32_t>(text.find("sphere(t"));
  CHECK(declarations.find("t", inside)[0]->head == "let t = 2*r");
  CHECK(declarations.find("i", inside)[0]->head == "for i in 0..3");
  CHECK(declarations.find("s", inside)[0]->head == "parameter s = 2m");
  CHECK(declarations.find("t", static_cast<uint32_t>(text.find("box(r"))).empty());
  CHECK(declarations.find("a", static_cast<uint32_t>(text.size()) - 1).size() == 1);
}

TEST_CASE("every word of the language has a line of help", "[grammar][editor]") {
  for (const auto table : {keywordTable(), clauseWordTable()})
    for (const std::string_view word : table) {
      INFO(word);
      CHECK_FALSE(wordHelp(word).empty());
    }
  for (const BuiltinInfo& builtin : builtinTable()) {
    INFO(builtin.name);
    CHECK_FALSE(wordHelp(builtin.name).empty());
    CHECK(callForms(builtin.name).starts_with(std::string(builtin.name) + "("));
  }
  for (const PrimitiveInfo& primitive : primitiveTable()) {
    INFO(primitive.name);
    CHECK_FALSE(wordHelp(primitive.name).empty());
  }
  CHECK(callForms("rand") == "rand(a, b)\nrand(key, a, b)");
  CHECK(callForms("tube") == "tube(a, b, r, bend = 0)");
  CHECK(wordHelp("nonsense").empty());
}
