// Parses statements that divide a scope into parts: split and comp.

#include <algorithm>

#include "grammar/parse/parse_expressions.h"
#include "grammar/parse/parse_parts.h"
#include "grammar/parse/parse_statements.h"
#include "grammar/syntax/keywords.h"
#include "grammar/text/codes.h"

namespace sgm::parse {

namespace {

void parseSplitParts(ParseContext& in, Parts& parts, bool repeated);

/// { PARTS }*
void parseSplitGroup(ParseContext& in, Parts& parts, bool repeated) {
  TokenStream& tokens = in.tokens;
  const Span group = tokens.here();
  const size_t first = parts.nodes.size();
  // The repeated group is parsed even after an error, so that the following text is not misread.
  if (repeated)
    in.sink.error(group, codes::kSyntax, "a repeated group holds no other group", "split its parts once more instead");
  else if (std::any_of(parts.nodes.begin(), parts.nodes.end(), [](const PartNode& p) { return p.repeated; }))
    in.sink.error(group, codes::kDuplicate, "this split has a second repeated group",
                  "put its parts into the first one, or split a part once more");
  Nested nested(tokens);
  if (!nested.fits()) return;
  tokens.take();
  const uint32_t errors = in.sink.errorCount();
  parseSplitParts(in, parts, true);
  if (!parsePartsEnd(in, group) || !tokens.expect(Tok::star, "`*` after the parts that are repeated")) return;
  if (parts.nodes.size() == first && in.sink.errorCount() == errors)
    in.sink.error(tokens.since(group), codes::kSyntax, "this repeated group has no parts", "such as `{ ~2m: Bay; }*`");
  for (size_t i = first; i < parts.nodes.size(); ++i) parts.nodes[i].group = tokens.since(group);
}

/// [~] SIZE : BODY
void parseSplitPart(ParseContext& in, Parts& parts, bool repeated) {
  PartNode part;
  const Span begin = in.tokens.here();
  part.repeated = repeated;
  part.flexible = in.tokens.accept(Tok::tilde);
  part.size = parseExpression(in);
  in.tokens.expect(Tok::colon, "`:` and what stands in this part");
  const StmtId body = parseBody(in, "this part");
  addPart(in, parts, part, body, begin);
}

void parseSplitParts(ParseContext& in, Parts& parts, bool repeated) {
  parseUntilBrace(in, [&] {
    if (in.tokens.at(Tok::open_brace))
      parseSplitGroup(in, parts, repeated);
    else
      parseSplitPart(in, parts, repeated);
  });
}

/// FACE : BODY
void parseCompPart(ParseContext& in, Parts& parts) {
  TokenStream& tokens = in.tokens;
  PartNode part;
  const Span begin = tokens.here();
  const auto words = boxPartTable();
  const auto word = std::find(words.begin(), words.end(), tokens.at(Tok::word) ? tokens.text() : std::string_view());
  if (word == words.end()) {
    if (!tokens.at(Tok::word) || tokens.peek(1).kind != Tok::colon)
      return tokens.failExpecting("a part of the box such as `front:`");
    Suggestion suggestion(tokens.text());
    for (const std::string_view known : words) suggestion.offer(known);
    return tokens.fail(begin, codes::kUnknownName, join({"a box has no part `", tokens.text(), "`"}),
                       suggestion.hintOr("it has front, back, left, right, side, top, bottom, edges, inside"));
  }
  part.of = static_cast<BoxPart>(word - words.begin());
  if (std::any_of(parts.nodes.begin(), parts.nodes.end(), [&](const PartNode& p) { return p.of == part.of; }))
    return tokens.fail(begin, codes::kDuplicate, join({"`", *word, "` stands twice in this comp"}),
                       "put both into one block after it");
  tokens.take();
  tokens.expect(Tok::colon, "`:`");
  const StmtId body = parseBody(in, "this part");
  addPart(in, parts, part, body, begin);
}

}  // namespace

StmtId parseSplit(ParseContext& in) {
  TokenStream& tokens = in.tokens;
  StmtScope stmt(in, StmtKind::split);
  const std::optional<uint32_t> axis = parseAxis(tokens, "x, y or z to split along");
  if (!axis) return kNoId;
  stmt->extra = *axis;
  if (tokens.acceptWord("snap")) stmt->amount = parseExpression(in);
  const Span open = tokens.here();
  if (!tokens.expect(Tok::open_brace, "`{`")) return kNoId;
  Parts parts;
  const uint32_t errors = in.sink.errorCount();
  parseSplitParts(in, parts, false);
  if (!parsePartsEnd(in, open)) return kNoId;
  if (parts.nodes.empty() && in.sink.errorCount() == errors)
    in.sink.error(tokens.since(stmt.begin()), codes::kSyntax, "this split has no parts",
                  "such as `split x { ~1m: Wall; }`");
  return finishParts(in, stmt, parts);
}

StmtId parseSnap(ParseContext& in) {
  TokenStream& tokens = in.tokens;
  StmtScope stmt(in, StmtKind::snap);
  const std::optional<uint32_t> axis = parseAxis(tokens, "x, y or z that the planes stand across");
  if (!axis) return kNoId;
  stmt->extra = *axis;
  stmt->expr = parseExpression(in);
  if (tokens.acceptWord("from")) stmt->amount = parseExpression(in);
  stmt->body = parseBody(in, stmt.word());
  return stmt.finish();
}

StmtId parseComp(ParseContext& in) {
  TokenStream& tokens = in.tokens;
  StmtScope stmt(in, StmtKind::comp);
  const Span open = tokens.here();
  if (!tokens.expect(Tok::open_brace, "`{`")) return kNoId;
  const uint32_t errors = in.sink.errorCount();
  Parts parts;
  parseUntilBrace(in, [&] { parseCompPart(in, parts); });
  if (!parsePartsEnd(in, open)) return kNoId;
  if (parts.nodes.empty() && in.sink.errorCount() == errors)
    in.sink.error(tokens.since(stmt.begin()), codes::kSyntax, "this comp names no part of the box",
                  "such as `comp { side: Wall; }`");
  return finishParts(in, stmt, parts);
}

}  // namespace sgm::parse
