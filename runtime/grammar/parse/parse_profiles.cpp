// Parses footprints, their extrusions, and roofs.

#include "grammar/parse/parse_expressions.h"
#include "grammar/parse/parse_statements.h"
#include "grammar/parse/stmt_scope.h"

namespace sgm::parse {

namespace {

ExprId parsePlanName(ParseContext& in) {
  const Span begin = in.tokens.here();
  ExprNode node;
  node.kind = ExprKind::name;
  node.name = parseNewName(in, "the name of a plan");
  return in.tokens.hasFailed() ? kNoId : in.build.addExpr(node, begin);
}

}  // namespace

StmtId parseFootprint(ParseContext& in) {
  TokenStream& tokens = in.tokens;
  StmtScope stmt(in, StmtKind::footprint);
  FootprintNode footprint;
  if (tokens.acceptWord("merge")) footprint.count = parseExpression(in);
  if (tokens.atWord("rect"))
    footprint.outline = Outline::rect;
  else if (tokens.atWord("regular"))
    footprint.outline = Outline::regular;
  else if (tokens.atWord("polygon"))
    footprint.outline = Outline::polygon;
  else
    tokens.failExpecting("`rect`, `regular` or `polygon`");
  const Span outline = tokens.here();
  footprint.args = addArguments(in, tokens.textOf(tokens.take()));
  footprint.span = tokens.since(outline);
  tokens.expectWord("as");
  stmt->name = parseNewName(in, "the name of a plan");
  tokens.expect(Tok::semicolon, "`;`");
  return stmt.finish(&Ast::footprints, footprint);
}

StmtId parseExtrude(ParseContext& in) {
  TokenStream& tokens = in.tokens;
  StmtScope stmt(in, StmtKind::extrude);
  stmt->expr = parseExpression(in);
  tokens.expectWord("of");
  stmt->plan = parsePlanName(in);
  if (tokens.at(Tok::open_brace))
    stmt->body = parseBlock(in);
  else
    tokens.expect(Tok::semicolon, "`;` or a block");
  return stmt.finish();
}

StmtId parseRoof(ParseContext& in) {
  TokenStream& tokens = in.tokens;
  StmtScope stmt(in, StmtKind::roof);
  RoofNode roof;
  if (tokens.atWord("flat"))
    roof.form = RoofForm::flat;
  else if (tokens.atWord("gable"))
    roof.form = RoofForm::gable;
  else if (tokens.atWord("hip"))
    roof.form = RoofForm::hip;
  else
    tokens.failExpecting("`flat`, `gable` or `hip`");
  roof.args = addArguments(in, tokens.textOf(tokens.take()));
  if (tokens.acceptWord("of")) stmt->plan = parsePlanName(in);
  tokens.expect(Tok::semicolon, "`;`");
  return stmt.finish(&Ast::roofs, roof);
}

}  // namespace sgm::parse
