// Tests that every message of the compiler and of derivation occurs in a test, word for word.

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "catch.h"

namespace {

struct Literal {
  int line;  ///< line on which the literal starts
  std::string text;
};

/// The string literals in C++ source, with adjacent literals joined. Omits the names of included files.
std::vector<Literal> literalsOf(std::string_view source) {
  std::vector<Literal> out;
  int line = 1;
  bool adjacent = false;  // whether only blanks separate this literal from the previous one
  for (size_t i = 0; i < source.size(); ++i) {
    const std::string_view rest = source.substr(i);
    std::string text;
    size_t size = 1;
    if (rest.starts_with("//") || rest.starts_with("#include")) {
      size = std::min(rest.find('\n'), rest.size());
    } else if (rest.starts_with('\'') && (i == 0 || !std::isdigit(static_cast<unsigned char>(source[i - 1])))) {
      size = rest.find('\'', rest[1] == '\\' ? 3 : 2) + 1;
    } else if (rest.starts_with("R\"")) {
      const size_t open = rest.find('(');
      const std::string close = ")" + std::string(rest.substr(2, open - 2)) + "\"";
      size = rest.find(close, open) + close.size();
      text = rest.substr(open + 1, size - close.size() - open - 1);
    } else if (rest.starts_with('"')) {
      while (rest[size] != '"') {
        if (rest[size] == '\\') ++size;
        text += rest[size++];
      }
      ++size;
    } else {
      adjacent = adjacent && (rest[0] == ' ' || rest[0] == '\n');
      line += rest[0] == '\n' ? 1 : 0;
      continue;
    }
    const bool literal = rest[0] == 'R' || rest[0] == '"';
    if (literal && adjacent)
      out.back().text += text;
    else if (literal)
      out.push_back({line, text});
    adjacent = literal;
    line += static_cast<int>(std::count(rest.begin(), rest.begin() + static_cast<std::ptrdiff_t>(size), '\n'));
    i += size - 1;
  }
  return out;
}

/// Whether a text contains at least two words, as messages do, unlike words of the language.
bool readsLikeMessage(std::string_view text) {
  const auto letter = [](char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0; };
  for (size_t i = 1; i + 1 < text.size(); ++i)
    if (text[i] == ' ' && letter(text[i - 1]) && letter(text[i + 1])) return true;
  return false;
}

std::string textOf(const std::filesystem::path& path) {
  std::ifstream file(path);
  std::stringstream text;
  text << file.rdbuf();
  return text.str();
}

std::vector<std::filesystem::path> filesIn(const std::string& folder, std::initializer_list<const char*> endings) {
  std::vector<std::filesystem::path> out;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(std::string(SGM_SOURCE_DIR "/") + folder))
    if (std::find(endings.begin(), endings.end(), entry.path().extension()) != endings.end())
      out.push_back(entry.path());
  std::sort(out.begin(), out.end());
  return out;
}

/// The literals in the source that read like messages, but do not occur in the tests.
std::vector<Literal> untested(const std::string& source, const std::string& tests) {
  std::vector<Literal> out;
  for (Literal& literal : literalsOf(source)) {
    if (!readsLikeMessage(literal.text)) continue;
    literal.text.erase(0, literal.text.find_first_not_of(' '));
    literal.text.erase(literal.text.find_last_not_of(' ') + 1);
    if (tests.find(literal.text) == std::string::npos) out.push_back(literal);
  }
  return out;
}

}  // namespace

TEST_CASE("every message stands word for word in a test", "[grammar][messages]") {
  std::string tests;
  for (const char* folder : {"tests/unit/grammar", "tests/unit/derive", "tests/unit/asset"})
    for (const auto& path : filesIn(folder, {".cpp", ".h"}))
      for (const Literal& literal : literalsOf(textOf(path))) tests += literal.text + "\n";
  for (const auto& path : filesIn("tests/cli", {".sh"})) tests += textOf(path);
  int sources = 0;
  for (const char* folder : {"runtime/grammar", "runtime/derive", "runtime/asset"})
    for (const auto& path : filesIn(folder, {".cpp", ".h"})) {
      // word_help.cpp is left out, because it has descriptions of words instead of messages.
      if (path.filename() == "word_help.cpp") continue;
      ++sources;
      for (const Literal& literal : untested(textOf(path), tests))
        FAIL_CHECK(folder << "/" << path.filename().string() << ":" << literal.line << ": no test has \""
                          << literal.text << "\"");
    }
  CHECK(sources > 80);
}

TEST_CASE("a message without a test is found, with its line", "[grammar][messages]") {
  const std::string source =
      "#include \"two words.h\"\n"
      "// \"not code\", it's a comment\n"
      "f('\"', \"one\", join({\"`\", name, \"` hums a\\\"b \"\n"
      "        \"tune\"}));\n"
      "g(\"sings well\"); h(R\"(whistles a \"tune\" )\");\n";
  const auto missing = untested(source, "`Wren` hums a\"b tune");
  REQUIRE(missing.size() == 2);
  CHECK(missing[0].line == 5);
  CHECK(missing[0].text == "sings well");
  CHECK(missing[1].text == "whistles a \"tune\"");
  CHECK(untested(source, "` hums a\"b tune, sings well, whistles a \"tune\"").empty());
  CHECK(untested(source, "sings well, whistles a \"tune\"").at(0).line == 3);
}
