// Parses the statement wfc, which fills a scope with a lattice of tiles.

#include <algorithm>

#include "grammar/parse/parse_expressions.h"
#include "grammar/parse/parse_parts.h"
#include "grammar/parse/parse_statements.h"
#include "grammar/syntax/keywords.h"
#include "grammar/text/codes.h"

namespace sgm::parse {

namespace {

/// Returns the words for the sides of a tile, which are the first of the words for the parts of a box.
std::span<const std::string_view> sideWords() { return boxPartTable().first(static_cast<size_t>(BoxPart::side) + 1); }

/// Parses LABEL { or LABEL }, and removes duplicates.
IdRange parseLabels(ParseContext& in) {
  std::vector<NameId> labels;
  do {
    const NameId label = parseNewName(in, "the label of a side");
    if (in.tokens.hasFailed()) return {};
    if (std::find(labels.begin(), labels.end(), label) == labels.end()) labels.push_back(label);
  } while (in.tokens.acceptWord("or"));
  return in.build.addIds(labels);
}

/// Parses a socket of a tile or of the border: a side and its labels, such as `left wall or gate` or `left plug meets
/// hole`. before: the sockets already parsed for the same tile or border.
std::optional<SocketNode> parseSocket(ParseContext& in, const std::vector<SocketNode>& before) {
  TokenStream& tokens = in.tokens;
  SocketNode out;
  const Span begin = tokens.here();
  const auto words = sideWords();
  const auto word = std::find(words.begin(), words.end(), tokens.at(Tok::word) ? tokens.text() : std::string_view());
  if (word == words.end()) {
    if (!tokens.at(Tok::word) || tokens.peek(1).kind != Tok::word) {
      tokens.failExpecting("a side and its label, such as `left wall`");
      return std::nullopt;
    }
    Suggestion suggestion(tokens.text());
    for (const std::string_view known : words) suggestion.offer(known);
    tokens.fail(begin, codes::kUnknownName, join({"a tile has no side `", tokens.text(), "`"}),
                suggestion.hintOr("it has front, back, left, right, side, top, bottom"));
    return std::nullopt;
  }
  out.of = static_cast<BoxPart>(word - words.begin());
  if (std::any_of(before.begin(), before.end(), [&](const SocketNode& s) { return s.of == out.of; })) {
    tokens.fail(begin, codes::kDuplicate, join({"`", *word, "` stands twice here"}),
                "join labels with `or`: `left wall or gate`");
    return std::nullopt;
  }
  tokens.take();
  out.labels = parseLabels(in);
  if (tokens.acceptWord("meets")) out.meets = parseLabels(in);
  if (tokens.hasFailed()) return std::nullopt;
  out.span = tokens.since(begin);
  return out;
}

uint32_t addTile(AstBuilder& build, bool turns, const std::vector<SocketNode>& sockets) {
  TileNode tile;
  tile.turns = turns;
  tile.sockets = build.addRange(&Ast::sockets, sockets);
  return build.add(&Ast::tiles, tile);
}

/// Parses a tile: NAME WEIGHT [turn] { , SOCKET } : BODY.
void parseTile(ParseContext& in, Parts& parts) {
  TokenStream& tokens = in.tokens;
  PartNode part;
  const Span begin = tokens.here();
  part.label = parseNewName(in, "the name of a tile");
  if (tokens.at(Tok::colon) || tokens.at(Tok::comma)) tokens.failExpecting("the weight of the tile, such as `wall 3`");
  part.size = parseExpression(in);
  const bool turns = tokens.acceptWord("turn");
  std::vector<SocketNode> sockets;
  while (tokens.accept(Tok::comma))
    if (const std::optional<SocketNode> one = parseSocket(in, sockets)) sockets.push_back(*one);
  tokens.expect(Tok::colon, "`:` and what stands in this tile");
  const StmtId body = parseBody(in, "this tile");
  part.tile = addTile(in.build, turns, sockets);
  addPart(in, parts, part, body, begin);
}

void parseWavePart(ParseContext& in, Parts& parts) {
  TokenStream& tokens = in.tokens;
  const auto sides = sideWords();
  const Token& second = tokens.peek(1);
  const bool side =
      second.kind == Tok::word && std::find(sides.begin(), sides.end(), tokens.textOf(second)) != sides.end();
  if (!tokens.atWord("border") || !side) return parseTile(in, parts);
  PartNode part;
  const Span begin = tokens.here();
  const StmtId body = parseBorder(in);
  if (body != kNoId) part.tile = in.program.stmt(body).extra;
  addPart(in, parts, part, body, begin);
}

}  // namespace

StmtId parseWfc(ParseContext& in) {
  TokenStream& tokens = in.tokens;
  StmtScope stmt(in, StmtKind::wfc);
  if (tokens.at(Tok::open_brace)) tokens.failExpecting("the size of a tile, such as `wfc 2m`");
  stmt->expr = parseExpression(in);
  const Span open = tokens.here();
  if (!tokens.expect(Tok::open_brace, "`{`")) return kNoId;
  Parts parts;
  parseUntilBrace(in, [&] { parseWavePart(in, parts); });
  if (!parsePartsEnd(in, open)) return kNoId;
  stmt->extra = in.build.add(&Ast::waves, WaveNode{});
  return finishParts(in, stmt, parts);
}

StmtId parseBorder(ParseContext& in) {
  TokenStream& tokens = in.tokens;
  StmtScope stmt(in, StmtKind::border);
  std::vector<SocketNode> sockets;
  do {
    if (const std::optional<SocketNode> one = parseSocket(in, sockets)) sockets.push_back(*one);
  } while (tokens.accept(Tok::comma));
  tokens.expect(Tok::semicolon, "`;`");
  if (tokens.hasFailed()) return kNoId;
  stmt->extra = addTile(in.build, false, sockets);
  return stmt.finish();
}

}  // namespace sgm::parse
