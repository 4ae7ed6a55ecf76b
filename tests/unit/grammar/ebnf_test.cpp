// Tests that the published grammar and the lexer's tables contain the same words.

#include <fstream>
#include <regex>
#include <set>
#include <sstream>

#include "catch.h"
#include "grammar/syntax/keywords.h"

using namespace sgm;

namespace {

std::string published() {
  std::ifstream file(SGM_SOURCE_DIR "/runtime/grammar/grammar.ebnf");
  REQUIRE(file);
  std::stringstream text;
  text << file.rdbuf();
  return std::regex_replace(text.str(), std::regex("\\(\\*[^]*?\\*\\)"), "");
}

}  // namespace

TEST_CASE("every word of the published grammar is in the keyword table, and the other way round", "[grammar][ebnf]") {
  const std::string text = published();
  std::set<std::string, std::less<>> written;
  const std::regex quoted("\"([a-z]+)\"");
  for (std::sregex_iterator i(text.begin(), text.end(), quoted), end; i != end; ++i) written.insert((*i)[1].str());
  std::set<std::string, std::less<>> known;
  for (std::string_view word : keywordTable()) known.emplace(word);
  for (std::string_view word : clauseWordTable()) known.emplace(word);
  for (const std::string& word : written) {
    INFO(word);
    CHECK(known.count(word) == 1);
  }
  for (const std::string& word : known) {
    INFO(word);
    CHECK(written.count(word) == 1);
  }
}

TEST_CASE("every name in the published grammar has a production", "[grammar][ebnf]") {
  const std::string text = std::regex_replace(published(), std::regex("\"[^\"]*\""), "");
  std::set<std::string> productions, used;
  const std::regex production("([a-z_]+)\\s*="), name("[a-z_]+");
  for (std::sregex_iterator i(text.begin(), text.end(), production), end; i != end; ++i)
    productions.insert((*i)[1].str());
  for (std::sregex_iterator i(text.begin(), text.end(), name), end; i != end; ++i) used.insert(i->str());
  CHECK(used == productions);
}
