// Parses the statements `report` and `expect`, with which a grammar requests or checks measures of its own world.

#include <algorithm>
#include <array>
#include <string>

#include "grammar/parse/parse_declarations.h"
#include "grammar/parse/parse_expressions.h"
#include "grammar/syntax/keywords.h"
#include "grammar/text/codes.h"

namespace sgm::parse {

namespace {

/// Parses the name of a measure (one of measureTable()). Returns false after an error.
bool parseMeasure(TokenStream& tokens, Expectation& e) {
  const std::string_view measure = tokens.text();
  const std::span<const std::string_view> measures = measureTable();
  const auto known = std::find(measures.begin(), measures.end(), measure);
  if (!tokens.at(Tok::word) || known == measures.end()) {
    Suggestion suggestion(measure);
    for (const std::string_view m : measures) suggestion.offer(m);
    tokens.fail(tokens.here(), codes::kUnknownName, join({"unknown measure `", measure, "`"}),
                suggestion.hintOr("measures are watertight, components, volume, area, triangles, genus and anchors"));
    return false;
  }
  e.measure = static_cast<Measure>(known - measures.begin());
  tokens.take();
  return true;
}

/// Parses the condition behind a measure: first, optionally, `(air)`, `(solid)` or one of these with `above EXPR` in
/// the parentheses; then, optionally, a comparison operator with an EXPR.
void parseCondition(ParseContext& in, Expectation& e) {
  TokenStream& tokens = in.tokens;
  if (tokens.accept(Tok::open_paren)) {
    if (!tokens.atWord("air") && !tokens.atWord("solid")) tokens.failExpecting("`air` or `solid`");
    e.of = parseName(in, "`air` or `solid`");
    if (tokens.acceptWord("above")) e.above = parseExpression(in);
    tokens.expect(Tok::close_paren, "`)`");
  }
  const Tok sign = tokens.peek().kind;
  if (sign < Tok::less || sign > Tok::not_equal) return;
  constexpr std::array<BinaryOp, 6> kOps = {BinaryOp::less,          BinaryOp::less_equal, BinaryOp::greater,
                                            BinaryOp::greater_equal, BinaryOp::equal,      BinaryOp::not_equal};
  e.comparison = kOps[static_cast<size_t>(sign) - static_cast<size_t>(Tok::less)];
  e.compared = true;
  tokens.take();
  e.value = parseExpression(in);
}

/// Parses `(CELLS)` behind the word `block`, and returns CELLS, the edge of a block in cells. Returns 0 after an error.
int32_t parseBlockSize(TokenStream& tokens) {
  tokens.expect(Tok::open_paren, "`(`");
  const Token& cells = tokens.peek();
  if (cells.kind != Tok::number || !(cells.dim == kRatio) || cells.value < 1 || cells.value > 64 ||
      cells.value != static_cast<double>(static_cast<int32_t>(cells.value))) {
    tokens.fail(tokens.here(), codes::kValueRange, "a block has 1 to 64 cells along an edge", "such as block(8)");
    return 0;
  }
  const int32_t size = static_cast<int32_t>(cells.value);
  tokens.take();
  tokens.expect(Tok::close_paren, "`)`");
  return size;
}

/// Parses `in block(CELLS)`, `in LOW..HIGH` or `per RULE`.
void parseScope(ParseContext& in, Expectation& e) {
  TokenStream& tokens = in.tokens;
  const Token& next = tokens.peek(1);
  const bool block = next.kind == Tok::word && tokens.textOf(next) == "block";
  const bool twice = tokens.atWord("per") ? e.per_name != kNoId : block ? e.block != 0 : e.low != kNoId;
  if (twice) return tokens.fail(tokens.here(), codes::kDuplicate, "this stands here twice", kRemoveOne);
  if (tokens.acceptWord("per")) {
    e.per_name = parseName(in, "the name of a rule");
    return;
  }
  tokens.take();
  if (tokens.acceptWord("block")) {
    e.block = parseBlockSize(tokens);
  } else {
    e.low = parseExpression(in);
    tokens.expect(Tok::dots, "`..`");
    e.high = parseExpression(in);
  }
}

void parseExpectation(ParseContext& in, bool expect) {
  TokenStream& tokens = in.tokens;
  const Span begin = tokens.last();
  Expectation e;
  e.expect = expect;
  if (!parseMeasure(tokens, e)) return;
  parseCondition(in, e);
  while (tokens.atWord("in") || tokens.atWord("per")) parseScope(in, e);
  tokens.expect(Tok::semicolon, "`;`");
  e.span = tokens.since(begin);
  declare(in, ItemKind::expectation, begin, in.program.expectations, e);
}

}  // namespace

void declareReport(ParseContext& in) { parseExpectation(in, false); }
void declareExpectation(ParseContext& in) { parseExpectation(in, true); }

}  // namespace sgm::parse
