#include "grammar/parse/parse_statements.h"

#include <vector>

#include "grammar/parse/parse_declarations.h"
#include "grammar/parse/parse_expressions.h"
#include "grammar/parse/stmt_scope.h"
#include "grammar/syntax/foreign_words.h"
#include "grammar/syntax/keywords.h"
#include "grammar/text/codes.h"

namespace sgm::parse {

namespace {

/// The syntax of a kind of statement.
struct StmtForm {
  std::string_view word;  ///< the keyword that starts such a statement in a block; empty: none
  StmtId (*parse)(ParseContext&) = nullptr;
};

/// Maps each kind to its syntax. Without a default case, the compiler reports a kind that is missing here.
constexpr StmtForm formOf(StmtKind kind) {
  switch (kind) {
    case StmtKind::block:
      return {"", parseBlock};
    case StmtKind::call:
      return {"", parseCall};
    case StmtKind::unite:
      return {"union", parseUnion};
    case StmtKind::cut:
      return {"cut", parseCut};
    case StmtKind::meet:
      return {"meet", parseMeet};
    case StmtKind::sum:
      return {"sum", parseSum};
    case StmtKind::morph:
      return {"morph", parseMorph};
    case StmtKind::displace:
      return {"displace", parseDisplace};
    case StmtKind::warp:
      return {"warp", parseWarp};
    case StmtKind::transform:
      return {"", parseTransform};
    case StmtKind::repeat:
      return {"repeat", parseRepeat};
    case StmtKind::for_each:
      return {"for", parseFor};
    case StmtKind::scatter:
      return {"scatter", parseScatter};
    case StmtKind::let:
      return {"let", parseLet};
    case StmtKind::field:
      return {"field", parseField};
    case StmtKind::mat:
      return {"mat", parseMaterial};
    case StmtKind::tag:
      return {"tag", parseTag};
    case StmtKind::anchor:
      return {"anchor", parseAnchor};
    case StmtKind::split:
      return {"split", parseSplit};
    case StmtKind::snap:
      return {"snap", parseSnap};
    case StmtKind::comp:
      return {"comp", parseComp};
    case StmtKind::treemap:
      return {"treemap", parseTreemap};
    case StmtKind::link:
      return {"", parseLink};
    case StmtKind::detail:
      return {"detail", parseDetail};
    case StmtKind::footprint:
      return {"footprint", parseFootprint};
    case StmtKind::extrude:
      return {"extrude", parseExtrude};
    case StmtKind::roof:
      return {"roof", parseRoof};
    case StmtKind::inner:
      return {"inner", parseInner};
    case StmtKind::fit:
      return {"fit", parseFit};
    case StmtKind::wfc:
      return {"wfc", parseWfc};
    case StmtKind::border:
      return {"", parseBorder};
  }
  return {};
}

/// Calls `visit(form)` for each kind of statement until a call returns true, and returns that form. If no call returns
/// true, returns the empty form that marks the end of the kinds.
template <typename Visit>
StmtForm findForm(const Visit& visit) {
  for (uint8_t kind = 0;; ++kind) {
    const StmtForm form = formOf(static_cast<StmtKind>(kind));
    if (form.parse == nullptr || visit(form)) return form;
  }
}

/// Fails if the current word is probably a misspelling of a word that starts a statement.
void failIfMisspelt(TokenStream& tokens) {
  const Tok next = tokens.peek(1).kind;
  if (!tokens.at(Tok::word) || next == Tok::open_paren || next == Tok::semicolon || next == Tok::dot ||
      next == Tok::close_brace)
    return;
  Suggestion suggestion(tokens.text());
  findForm([&](const StmtForm& form) {
    suggestion.offer(form.word);
    return false;
  });
  for (const std::string_view word : {"smooth", "when"}) suggestion.offer(word);
  for (const std::string_view word : transformTable()) suggestion.offer(word);
  if (!suggestion.best().empty())
    tokens.fail(tokens.here(), codes::kSyntax, join({"`", tokens.text(), "` does not start a statement"}),
                suggestion.hint());
}

/// Parses [smooth WIDTH] BODY.
StmtId parseCombiner(ParseContext& in, StmtKind kind) {
  TokenStream& tokens = in.tokens;
  StmtScope stmt(in, kind);
  if (tokens.atWord("smooth")) {
    if (kind == StmtKind::sum)
      tokens.fail(tokens.here(), codes::kSyntax, "a sum is smooth by itself",
                  "its width follows the radii of its leaves");
    tokens.take();
    stmt->amount = parseExpression(in);
  }
  const bool joins = kind == StmtKind::meet || kind == StmtKind::sum;
  in.joined += joins ? 1 : 0;
  stmt->body = parseBody(in, stmt.word());
  in.joined -= joins ? 1 : 0;
  return stmt.finish();
}

}  // namespace

StmtId parseStatement(ParseContext& in) {
  TokenStream& tokens = in.tokens;
  Nested nested(tokens);
  if (!nested.fits()) return kNoId;
  if (tokens.at(Tok::open_brace)) return parseBlock(in);
  if (tokens.failIfUnavailable()) return kNoId;
  if (isAtTransform(tokens)) return parseTransform(in);
  const StmtForm form = findForm([&](const StmtForm& candidate) { return tokens.atWord(candidate.word); });
  return form.parse == nullptr ? parseCall(in) : form.parse(in);
}

StmtId parseBlock(ParseContext& in) {
  TokenStream& tokens = in.tokens;
  Nested nested(tokens);
  if (!nested.fits()) return kNoId;
  const Span begin = tokens.here();
  if (!tokens.expect(Tok::open_brace, "`{`")) return kNoId;
  std::vector<StmtId> list;
  parseUntilBrace(in, [&] {
    const StmtId stmt = parseStatement(in);
    if (!tokens.hasFailed() && stmt != kNoId) list.push_back(stmt);
  });
  if (!tokens.accept(Tok::close_brace)) {
    tokens.fail(begin, codes::kSyntax, "this block is not closed", "a `}` is missing");
    return kNoId;
  }
  StmtNode node;
  node.kind = StmtKind::block;
  node.children = in.build.addIds(list);
  return in.build.addStmt(node, begin);
}

StmtId parseBody(ParseContext& in, std::string_view word) {
  if (in.tokens.at(Tok::semicolon) || in.tokens.at(Tok::close_brace)) {
    in.tokens.failExpecting(join({"a block or a statement for `", word, "`"}));
    return kNoId;
  }
  return parseStatement(in);
}

StmtId parseCall(ParseContext& in) {
  TokenStream& tokens = in.tokens;
  const Span begin = tokens.here();
  const std::string_view word = tokens.text();
  if (tokens.at(Tok::word) && tokens.peek().keyword) {
    if (startsDeclaration(word))
      tokens.fail(begin, codes::kSyntax, join({"expected a statement, found `", word, "`"}),
                  "close the block before it with `}`");
    else
      tokens.failExpecting("a statement");
    return kNoId;
  }
  failIfMisspelt(tokens);
  if (tokens.hasFailed()) return kNoId;
  StmtNode node;
  node.kind = StmtKind::call;
  node.expr = parseShapeCall(in, "a shape, a rule or a statement");
  if (tokens.hasFailed()) return kNoId;
  if (const std::string_view ours = wordFor(word); !ours.empty() && !tokens.at(Tok::semicolon)) {
    tokens.fail(begin, codes::kSyntax, join({"`", word, "` does not start a statement"}), join({"write `", ours, "`"}));
    return kNoId;
  }
  if (tokens.at(Tok::open_brace)) {
    tokens.fail(tokens.here(), codes::kSyntax, "a call takes no block", "end the call with `;`");
    return kNoId;
  }
  tokens.expect(Tok::semicolon, "`;`");
  return tokens.hasFailed() ? kNoId : in.build.addStmt(node, begin);
}

StmtId parseUnion(ParseContext& in) { return parseCombiner(in, StmtKind::unite); }
StmtId parseCut(ParseContext& in) { return parseCombiner(in, StmtKind::cut); }
StmtId parseMeet(ParseContext& in) { return parseCombiner(in, StmtKind::meet); }
StmtId parseSum(ParseContext& in) { return parseCombiner(in, StmtKind::sum); }

StmtId parseMorphOperand(ParseContext& in) {
  if (in.tokens.at(Tok::open_brace)) return parseBlock(in);
  const Span begin = in.tokens.here();
  StmtNode node;
  node.kind = StmtKind::call;
  node.expr = parseShapeCall(in, "a shape or a rule");
  return in.tokens.hasFailed() ? kNoId : in.build.addStmt(node, begin);
}

bool parseMorphPower(TokenStream& tokens) {
  if (tokens.acceptWord("power")) return true;
  tokens.acceptWord("lerp");
  return false;
}

StmtId parseMorph(ParseContext& in) {
  TokenStream& tokens = in.tokens;
  StmtScope stmt(in, StmtKind::morph);
  tokens.expect(Tok::open_paren, "`(`");
  const StmtId from = parseMorphOperand(in);
  tokens.expect(Tok::comma, "`,`");
  const StmtId to = parseMorphOperand(in);
  tokens.expect(Tok::comma, "`,` and how far to morph, 0 to 1");
  stmt->expr = parseExpression(in);
  tokens.expect(Tok::close_paren, "`)`");
  stmt->power = parseMorphPower(tokens);
  tokens.expect(Tok::semicolon, "`;`");
  if (tokens.hasFailed()) return kNoId;
  stmt->children = in.build.addIds({from, to});
  return stmt.finish();
}

StmtId parseLet(ParseContext& in) {
  TokenStream& tokens = in.tokens;
  StmtScope stmt(in, StmtKind::let);
  stmt->name = parseNewName(in, "a name");
  if (tokens.at(Tok::open_paren))
    tokens.fail(tokens.here(), codes::kSyntax, "a let with parameters stands outside of rules",
                "move it to the top of the file");
  tokens.expect(Tok::assign, "`=`");
  stmt->expr = parseExpression(in);
  tokens.expect(Tok::semicolon, "`;`");
  return stmt.finish();
}

StmtId parseField(ParseContext& in) {
  StmtScope stmt(in, StmtKind::field);
  stmt->extra = addField(in, true);
  return stmt.finish();
}

StmtId parseMaterial(ParseContext& in) {
  StmtScope stmt(in, StmtKind::mat);
  stmt->name = parseNewName(in, "the name of a material");
  in.tokens.expect(Tok::semicolon, "`;`");
  return stmt.finish();
}

StmtId parseTag(ParseContext& in) {
  StmtScope stmt(in, StmtKind::tag);
  stmt->name = parseText(in, "a text in quotes");
  in.tokens.expect(Tok::semicolon, "`;`");
  return stmt.finish();
}

StmtId parseAnchor(ParseContext& in) {
  StmtScope stmt(in, StmtKind::anchor);
  stmt->name = parseNewName(in, "the kind of an anchor");
  if (in.tokens.at(Tok::text)) stmt->name2 = parseText(in, "a text");
  in.tokens.expect(Tok::semicolon, "`;`");
  return stmt.finish();
}

StmtId parseDetail(ParseContext& in) {
  StmtScope stmt(in, StmtKind::detail);
  stmt->expr = parseExpression(in);
  stmt->body = parseBody(in, stmt.word());
  return stmt.finish();
}

}  // namespace sgm::parse
