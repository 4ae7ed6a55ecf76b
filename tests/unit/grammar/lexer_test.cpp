#include "grammar/syntax/lexer.h"

#include <memory_resource>

#include "catch.h"
#include "grammar/syntax/keywords.h"

using namespace sgm;

namespace {

LexResult lexed(std::string_view text, DiagnosticSink& sink) {
  return lex(text, 0, 1000, sink, std::pmr::get_default_resource());
}

}  // namespace

TEST_CASE("numbers carry their units", "[grammar][lexer]") {
  struct Number {
    const char* text;
    double value;
    Dim dim;
  };
  const Number numbers[] = {
      {"5", 5, kRatio},        {"2.5m", 2.5, kLength},  {"25cm", 0.25, kLength},
      {"3mm", 0.003, kLength}, {"6km", 6000, kLength},  {"30%", 0.3, kRatio},
      {"1e3", 1000, kRatio},   {"2e-1m", 0.2, kLength}, {"1.5rad", 1.5, kAngle},
      {"800m3", 800, kVolume}, {"4cm2", 0.0004, kArea}, {"180deg", 3.14159265358979323846, kAngle}};
  for (const Number& n : numbers) {
    INFO(n.text);
    DiagnosticSink sink(10);
    const LexResult result = lexed(n.text, sink);
    REQUIRE(result.tokens.size() == 2);
    CHECK(result.tokens[0].kind == Tok::number);
    CHECK(result.tokens[0].value == n.value);
    CHECK(result.tokens[0].dim == n.dim);
    CHECK(sink.errorCount() == 0);
  }
}

TEST_CASE("a range is no decimal point", "[grammar][lexer]") {
  DiagnosticSink sink(10);
  const LexResult result = lexed("0..2 800m3..60000m3 cell.x", sink);
  std::vector<Tok> kinds;
  for (const Token& token : result.tokens) kinds.push_back(token.kind);
  CHECK(kinds == std::vector<Tok>{Tok::number, Tok::dots, Tok::number, Tok::number, Tok::dots, Tok::number, Tok::word,
                                  Tok::dot, Tok::word, Tok::end});
}

TEST_CASE("spans count lines and bytes from 1", "[grammar][lexer]") {
  DiagnosticSink sink(10);
  const LexResult result = lexed("a // x\r\n\n  \"\xC3\xA4\" b", sink);
  REQUIRE(result.tokens.size() == 4);
  CHECK(result.tokens[1].span.line == 3);
  CHECK(result.tokens[1].span.column == 3);
  CHECK(result.tokens[1].span.end_column == 7);
  CHECK(result.tokens[2].span.column == 8);
  REQUIRE(result.comments.size() == 1);
  CHECK_FALSE(result.comments[0].own_line);
  CHECK(result.comments[0].end - result.comments[0].begin == 4);
}

TEST_CASE("texts keep their quotes through a round", "[grammar][lexer]") {
  for (const char* content : {"", "a", "\"", "\\", "a\\\"b", "\xE2\x82\xAC"})
    CHECK(textContent(quoteText(content)) == content);
}

TEST_CASE("unavailable words are no keywords", "[grammar][lexer]") {
  for (std::string_view word : unavailableTable()) {
    CHECK(isUnavailable(word));
    CHECK_FALSE(isKeyword(word));
  }
}
