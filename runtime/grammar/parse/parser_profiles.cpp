// Footprints, their extrusions, and roofs.

#include "grammar/parse/parser.h"

namespace sgm {

StmtId Parser::footprintStatement() {
  const Span begin = here();
  take();
  FootprintNode footprint;
  if (acceptWord("merge")) footprint.count = expression();
  if (atWord("rect"))
    footprint.outline = Outline::rect;
  else if (atWord("regular"))
    footprint.outline = Outline::regular;
  else if (atWord("polygon"))
    footprint.outline = Outline::polygon;
  else
    unexpected("`rect`, `regular` or `polygon`");
  const Span outline = here();
  const std::string_view word = textOf(take());
  footprint.args = storeArgs(arguments(word));
  footprint.span = since(outline);
  expectWord("as");
  StmtNode node;
  node.kind = StmtKind::footprint;
  node.name = declaredName("the name of a plan");
  expect(Tok::semicolon, "`;`");
  if (panic_) return kNoId;
  program_.ast.footprints.push_back(footprint);
  node.extra = static_cast<uint32_t>(program_.ast.footprints.size() - 1);
  return addStmt(node, begin);
}

ExprId Parser::planName() {
  const Span begin = here();
  ExprNode node;
  node.kind = ExprKind::name;
  node.name = declaredName("the name of a plan");
  return panic_ ? kNoId : addExpr(node, begin);
}

StmtId Parser::extrudeStatement() {
  const Span begin = here();
  take();
  StmtNode node;
  node.kind = StmtKind::extrude;
  node.expr = expression();
  expectWord("of");
  node.plan = planName();
  if (at(Tok::open_brace))
    node.body = block();
  else
    expect(Tok::semicolon, "`;` or a block");
  return panic_ ? kNoId : addStmt(node, begin);
}

StmtId Parser::roofStatement() {
  const Span begin = here();
  take();
  RoofNode roof;
  if (atWord("flat"))
    roof.form = RoofForm::flat;
  else if (atWord("gable"))
    roof.form = RoofForm::gable;
  else if (atWord("hip"))
    roof.form = RoofForm::hip;
  else
    unexpected("`flat`, `gable` or `hip`");
  const std::string_view word = textOf(take());
  roof.args = storeArgs(arguments(word));
  StmtNode node;
  node.kind = StmtKind::roof;
  if (acceptWord("of")) node.plan = planName();
  expect(Tok::semicolon, "`;`");
  if (panic_) return kNoId;
  program_.ast.roofs.push_back(roof);
  node.extra = static_cast<uint32_t>(program_.ast.roofs.size() - 1);
  return addStmt(node, begin);
}

}  // namespace sgm
