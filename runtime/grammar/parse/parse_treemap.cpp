// Parses the statement treemap, a floor plan, and the links between its rooms.

#include "grammar/parse/parse_expressions.h"
#include "grammar/parse/parse_parts.h"
#include "grammar/parse/parse_statements.h"

namespace sgm::parse {

namespace {

/// Parses ROOM AREA : BODY, corridor : BODY or facade : BODY.
void parseRoom(ParseContext& in, Parts& parts) {
  TokenStream& tokens = in.tokens;
  PartNode part;
  const Span begin = tokens.here();
  const bool colon = tokens.peek(1).kind == Tok::colon;
  if (colon && tokens.atWord("corridor"))
    part.floor = FloorPart::corridor;
  else if (colon && tokens.atWord("facade"))
    part.floor = FloorPart::facade;
  if (part.floor == FloorPart::room) {
    part.label = parseNewName(in, "the name of a room");
    if (tokens.at(Tok::colon)) tokens.failExpecting("the area of the room, such as `living 28:`");
    part.size = parseExpression(in);
  } else {
    tokens.take();
  }
  tokens.expect(Tok::colon, "`:` and what stands in this room");
  const StmtId body = parseBody(in, "this room");
  addPart(in, parts, part, body, begin);
}

void parseFloorPart(ParseContext& in, Parts& parts) {
  if (!in.tokens.atWord("link")) return parseRoom(in, parts);
  PartNode part;
  const Span begin = in.tokens.here();
  part.floor = FloorPart::link;
  const StmtId body = parseLink(in);
  addPart(in, parts, part, body, begin);
}

}  // namespace

StmtId parseTreemap(ParseContext& in) {
  TokenStream& tokens = in.tokens;
  StmtScope stmt(in, StmtKind::treemap);
  TreemapNode treemap;
  if (tokens.at(Tok::open_paren)) treemap.args = addArguments(in, stmt.word());
  const Span open = tokens.here();
  if (!tokens.expect(Tok::open_brace, "`{`")) return kNoId;
  Parts parts;
  parseUntilBrace(in, [&] { parseFloorPart(in, parts); });
  if (!parsePartsEnd(in, open)) return kNoId;
  stmt->extra = in.build.add(&Ast::treemaps, treemap);
  return finishParts(in, stmt, parts);
}

StmtId parseLink(ParseContext& in) {
  TokenStream& tokens = in.tokens;
  StmtScope stmt(in, StmtKind::link);
  for (NameId* name : {&stmt->name, &stmt->name2}) {
    if (tokens.at(Tok::word) && !tokens.peek().keyword)
      *name = parseName(in, "the name of a room");
    else
      tokens.failExpecting("the name of a room");
  }
  tokens.expectWord("by");
  tokens.expectWord("door");
  LinkNode link;
  if (tokens.at(Tok::open_paren)) link.args = addArguments(in, "door");
  tokens.expect(Tok::semicolon, "`;`");
  return stmt.finish(&Ast::links, link);
}

}  // namespace sgm::parse
