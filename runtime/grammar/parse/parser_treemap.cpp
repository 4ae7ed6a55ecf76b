// Floor plans: treemap and its links.

#include "grammar/parse/parser.h"

namespace sgm {

StmtId Parser::treemapStatement() {
  const Span begin = here();
  take();
  TreemapNode treemap;
  if (at(Tok::open_paren)) treemap.args = storeArgs(arguments("treemap"));
  StmtNode node;
  node.kind = StmtKind::treemap;
  const Span open = here();
  if (panic_ || !expect(Tok::open_brace, "`{`")) return kNoId;
  Parts parts;
  while (!at(Tok::close_brace) && !at(Tok::end)) {
    if (accept(Tok::semicolon)) continue;
    const size_t first = next_;
    floorPart(parts);
    if (!panic_) continue;
    if (exhausted_ || sink_.full()) return kNoId;
    synchronise(false, first);
  }
  if (!partsEnd(open)) return kNoId;
  program_.ast.treemaps.push_back(treemap);
  node.extra = static_cast<uint32_t>(program_.ast.treemaps.size() - 1);
  return addParts(node, parts, begin);
}

void Parser::floorPart(Parts& parts) {
  PartNode part;
  const Span begin = here();
  StmtId body = kNoId;
  const bool colon = peek(1).kind == Tok::colon;
  if (atWord("link")) {
    part.floor = FloorPart::link;
    body = linkStatement();
  } else {
    if (colon && atWord("corridor"))
      part.floor = FloorPart::corridor;
    else if (colon && atWord("facade"))
      part.floor = FloorPart::facade;
    if (part.floor == FloorPart::room) {
      part.label = declaredName("the name of a room");
      if (at(Tok::colon)) unexpected("the area of the room, such as `living 28:`");
      if (!panic_) part.size = expression();
    } else {
      take();
    }
    if (!panic_) expect(Tok::colon, "`:` and what stands in this room");
    if (!panic_) body = bodyOf("this room");
  }
  if (panic_ || body == kNoId) return;
  part.span = since(begin);
  parts.nodes.push_back(part);
  parts.bodies.push_back(body);
}

StmtId Parser::linkStatement() {
  const Span begin = here();
  take();
  StmtNode node;
  node.kind = StmtKind::link;
  for (NameId* name : {&node.name, &node.name2}) {
    if (panic_) return kNoId;
    if (at(Tok::word) && !peek().keyword)
      *name = wordName("the name of a room");
    else
      unexpected("the name of a room");
  }
  expectWord("by");
  expectWord("door");
  LinkNode link;
  if (!panic_ && at(Tok::open_paren)) link.args = storeArgs(arguments("door"));
  expect(Tok::semicolon, "`;`");
  if (panic_) return kNoId;
  program_.ast.links.push_back(link);
  node.extra = static_cast<uint32_t>(program_.ast.links.size() - 1);
  return addStmt(node, begin);
}

}  // namespace sgm
