// Parses statements that place their body or move its surface: transforms, loops, scatter, displace and warp.

#include <vector>

#include "grammar/parse/parse_expressions.h"
#include "grammar/parse/parse_statements.h"
#include "grammar/parse/stmt_scope.h"
#include "grammar/syntax/keywords.h"

namespace sgm::parse {

namespace {

XformNode parseXform(ParseContext& in) {
  const Span begin = in.tokens.here();
  const std::string_view word = in.tokens.textOf(in.tokens.take());
  XformNode node;
  for (size_t i = 0; i < transformTable().size(); ++i)
    if (word == transformTable()[i]) node.kind = static_cast<XformKind>(i);
  node.args = addArguments(in, word);
  node.span = in.tokens.since(begin);
  return node;
}

/// Parses all consecutive transforms.
IdRange parseXforms(ParseContext& in) {
  std::vector<XformNode> list;
  while (isAtTransform(in.tokens)) list.push_back(parseXform(in));
  return in.tokens.hasFailed() ? IdRange{} : in.build.addRange(&Ast::xforms, list);
}

/// Parses EXPR [amp EXPR] BODY, behind `displace` or `warp`.
StmtId parseMovedSurface(ParseContext& in, StmtKind kind) {
  StmtScope stmt(in, kind);
  stmt->expr = parseExpression(in);
  if (in.tokens.acceptWord("amp")) stmt->amount = parseExpression(in);
  stmt->body = parseBody(in, stmt.word());
  return stmt.finish();
}

/// Parses the points of a scatter: COUNT on AREA(...), or poisson(DISTANCE) [on AREA(...)].
void parsePoints(ParseContext& in, ScatterNode& scatter) {
  TokenStream& tokens = in.tokens;
  if (tokens.atWord("poisson") && tokens.peek(1).kind == Tok::open_paren) {
    tokens.take();
    tokens.take();
    scatter.poisson = true;
    scatter.count = parseExpression(in);
    tokens.expect(Tok::close_paren, "`)`");
  } else {
    scatter.count = parseExpression(in);
  }
  if (tokens.acceptWord("on")) {
    if (tokens.atWord("shell"))
      scatter.area = ScatterArea::shell;
    else if (tokens.atWord("box"))
      scatter.area = ScatterArea::box;
    else if (tokens.atWord("disc"))
      scatter.area = ScatterArea::disc;
    else
      tokens.failExpecting("`shell`, `box` or `disc`");
    const std::string_view word = tokens.textOf(tokens.take());
    scatter.args = addArguments(in, word);
  } else if (!scatter.poisson) {
    tokens.failExpecting("`on` and where to scatter, such as `on disc(5m)`");
  }
}

/// Parses the probe of a scatter: [up | down] DISTANCE of LAYER [gap NAME within LENGTH].
void parseProbe(ParseContext& in, ScatterNode& scatter) {
  TokenStream& tokens = in.tokens;
  scatter.probe = tokens.atWord("up") ? 1 : tokens.atWord("down") ? -1 : 0;
  if (scatter.probe == 0) tokens.failExpecting("`up` or `down`");
  tokens.take();
  scatter.distance = parseExpression(in);
  tokens.expectWord("of");
  scatter.span = tokens.here();
  scatter.layer_name = parseName(in, "the name of a layer");
  if (!tokens.acceptWord("gap")) return;
  scatter.gap = parseNewName(in, "the name of the open length behind a point");
  tokens.expectWord("within");
  scatter.within = parseExpression(in);
}

}  // namespace

bool isAtTransform(const TokenStream& tokens) {
  for (const std::string_view word : transformTable())
    if (tokens.atWord(word)) return true;
  return false;
}

StmtId parseTransform(ParseContext& in) {
  const Span begin = in.tokens.here();
  const std::string_view word = in.tokens.text();
  StmtNode node;
  node.kind = StmtKind::transform;
  node.xforms = parseXforms(in);
  node.body = parseBody(in, word);
  return in.tokens.hasFailed() ? kNoId : in.build.addStmt(node, begin);
}

StmtId parseRepeat(ParseContext& in) {
  StmtScope stmt(in, StmtKind::repeat);
  stmt->expr = parseExpression(in);
  stmt->xforms = parseXforms(in);
  stmt->body = parseBody(in, stmt.word());
  return stmt.finish();
}

StmtId parseFor(ParseContext& in) {
  StmtScope stmt(in, StmtKind::for_each);
  stmt->name = parseNewName(in, "the name of a loop variable");
  in.tokens.expectWord("in");
  stmt->expr = parseRangeOrExpression(in);
  stmt->body = parseBody(in, stmt.word());
  return stmt.finish();
}

StmtId parseScatter(ParseContext& in) {
  TokenStream& tokens = in.tokens;
  StmtScope stmt(in, StmtKind::scatter);
  ScatterNode scatter;
  scatter.span = tokens.here();
  parsePoints(in, scatter);
  if (tokens.acceptWord("probe"))
    parseProbe(in, scatter);
  else if (tokens.atWord("gap") && tokens.peek(1).kind == Tok::word && tokens.peek(2).kind == Tok::word)
    tokens.failExpecting("`probe up` or `probe down` before the gap");
  if (tokens.acceptWord("when")) scatter.when = parseExpression(in);
  stmt->body = parseBody(in, stmt.word());
  return stmt.finish(&Ast::scatters, scatter);
}

StmtId parseDisplace(ParseContext& in) { return parseMovedSurface(in, StmtKind::displace); }
StmtId parseWarp(ParseContext& in) { return parseMovedSurface(in, StmtKind::warp); }

}  // namespace sgm::parse
