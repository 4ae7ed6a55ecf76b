// Lattices of tiles: wfc.

#include <algorithm>

#include "grammar/parse/parser.h"
#include "grammar/syntax/keywords.h"
#include "grammar/text/codes.h"

namespace sgm {

namespace {

/// The sides of a tile among the parts of a box.
std::span<const std::string_view> sideWords() { return boxPartTable().first(static_cast<size_t>(BoxPart::side) + 1); }

}  // namespace

StmtId Parser::wfcStatement() {
  const Span begin = here();
  take();
  StmtNode node;
  node.kind = StmtKind::wfc;
  if (at(Tok::open_brace)) unexpected("the size of a tile, such as `wfc 2m`");
  if (!panic_) node.expr = expression();
  const Span open = here();
  if (panic_ || !expect(Tok::open_brace, "`{`")) return kNoId;
  Parts parts;
  while (!at(Tok::close_brace) && !at(Tok::end)) {
    if (accept(Tok::semicolon)) continue;
    const size_t first = next_;
    wavePart(parts);
    if (!panic_) continue;
    if (exhausted_ || sink_.full()) return kNoId;
    synchronise(false, first);
  }
  if (!partsEnd(open)) return kNoId;
  program_.ast.waves.emplace_back();
  node.extra = static_cast<uint32_t>(program_.ast.waves.size() - 1);
  return addParts(node, parts, begin);
}

void Parser::wavePart(Parts& parts) {
  PartNode part;
  const Span begin = here();
  StmtId body = kNoId;
  const auto sides = sideWords();
  const bool side = peek(1).kind == Tok::word && std::find(sides.begin(), sides.end(), textOf(peek(1))) != sides.end();
  if (atWord("border") && side) {
    body = borderStatement(part.tile);
  } else {
    part.label = declaredName("the name of a tile");
    if (at(Tok::colon) || at(Tok::comma)) unexpected("the weight of the tile, such as `wall 3`");
    if (!panic_) part.size = expression();
    const bool turns = !panic_ && acceptWord("turn");
    std::vector<SocketNode> sockets;
    while (!panic_ && accept(Tok::comma))
      if (const std::optional<SocketNode> one = socket(sockets)) sockets.push_back(*one);
    if (!panic_) expect(Tok::colon, "`:` and what stands in this tile");
    if (!panic_) body = bodyOf("this tile");
    part.tile = addTile(turns, sockets);
  }
  if (panic_ || body == kNoId) return;
  part.span = since(begin);
  parts.nodes.push_back(part);
  parts.bodies.push_back(body);
}

StmtId Parser::borderStatement(uint32_t& tile) {
  const Span begin = here();
  take();
  std::vector<SocketNode> sockets;
  do {
    if (const std::optional<SocketNode> one = socket(sockets)) sockets.push_back(*one);
  } while (!panic_ && accept(Tok::comma));
  expect(Tok::semicolon, "`;`");
  if (panic_) return kNoId;
  StmtNode node;
  node.kind = StmtKind::border;
  node.extra = tile = addTile(false, sockets);
  return addStmt(node, begin);
}

uint32_t Parser::addTile(bool turns, const std::vector<SocketNode>& sockets) {
  TileNode tile;
  tile.turns = turns;
  tile.sockets = {static_cast<uint32_t>(program_.ast.sockets.size()), static_cast<uint32_t>(sockets.size())};
  program_.ast.sockets.insert(program_.ast.sockets.end(), sockets.begin(), sockets.end());
  program_.ast.tiles.push_back(tile);
  return static_cast<uint32_t>(program_.ast.tiles.size() - 1);
}

/// A side and its labels: `left wall or gate`, `left plug meets hole`.
std::optional<SocketNode> Parser::socket(const std::vector<SocketNode>& before) {
  SocketNode out;
  const Span begin = here();
  const auto words = sideWords();
  const auto word = std::find(words.begin(), words.end(), at(Tok::word) ? textOf(peek()) : std::string_view());
  if (word == words.end()) {
    if (!at(Tok::word) || peek(1).kind != Tok::word) {
      unexpected("a side and its label, such as `left wall`");
      return std::nullopt;
    }
    Suggestion suggestion(textOf(peek()));
    for (const std::string_view known : words) suggestion.offer(known);
    fail(begin, codes::kUnknownName, join({"a tile has no side `", textOf(peek()), "`"}),
         suggestion.hintOr("it has front, back, left, right, side, top, bottom"));
    return std::nullopt;
  }
  out.of = static_cast<BoxPart>(word - words.begin());
  if (std::any_of(before.begin(), before.end(), [&](const SocketNode& s) { return s.of == out.of; })) {
    fail(begin, codes::kDuplicate, join({"`", *word, "` stands twice here"}),
         "join labels with `or`: `left wall or gate`");
    return std::nullopt;
  }
  take();
  out.labels = socketLabels();
  if (!panic_ && acceptWord("meets")) out.meets = socketLabels();
  if (panic_) return std::nullopt;
  out.span = since(begin);
  return out;
}

IdRange Parser::socketLabels() {
  std::vector<uint32_t> labels;
  do {
    const NameId label = declaredName("the label of a side");
    if (panic_) return {};
    if (std::find(labels.begin(), labels.end(), label) == labels.end()) labels.push_back(label);
  } while (acceptWord("or"));
  return store(labels);
}

}  // namespace sgm
