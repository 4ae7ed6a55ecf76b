// Parses rules and morphic rules.

#include "base/hash.h"
#include "grammar/parse/parse_declarations.h"
#include "grammar/parse/parse_expressions.h"
#include "grammar/parse/parse_statements.h"
#include "grammar/text/codes.h"

namespace sgm::parse {

namespace {

/// Returns the index of the file's rule with this name; adds the rule if it is new. span: of the head's name.
uint32_t ruleNamed(ParseContext& in, NameId name, bool morphic, const Span& span) {
  auto& rules = in.program.rules;
  const std::string_view text = in.program.text(name);
  const auto found = in.rules.find(name);
  if (found != in.rules.end()) {
    if (morphic || rules[found->second].morphic)
      in.sink.error(span, codes::kDuplicate, join({"`", text, "` is declared twice"}),
                    "a morphic rule has one head and no alternatives");
    return found->second;
  }
  Rule rule(rules.get_allocator().resource());
  rule.name = name;
  rule.module = in.syntax.module;
  rule.morphic = morphic;
  rule.name_hash = hashText(text);
  rule.span = span;
  rules.push_back(std::move(rule));
  const uint32_t index = static_cast<uint32_t>(rules.size() - 1);
  in.rules.emplace(name, index);
  return index;
}

/// Adds a head to the file's rule of that name. begin: the span of the head's first word.
void addHead(ParseContext& in, NameId name, bool morphic, const Span& name_span, const Alternative& head,
             const Span& begin) {
  if (in.tokens.hasFailed()) return;
  const uint32_t index = ruleNamed(in, name, morphic, name_span);
  auto& alternatives = in.program.rules[index].alternatives;
  alternatives.push_back(head);
  addItem(in, ItemKind::alternative, index, begin, alternatives.size() - 1);
}

/// Consumes the first word of a clause, for example `weight`. repeated: whether the head already has such a clause,
/// which is an error.
void takeClause(TokenStream& tokens, bool repeated) {
  if (repeated)
    tokens.fail(tokens.here(), codes::kDuplicate, join({"this head has a second `", tokens.text(), "`"}), kRemoveOne);
  tokens.take();
}

void takeGuard(TokenStream& tokens, Alternative& head, Guard guard) {
  if (head.guard != Guard::none)
    tokens.fail(tokens.here(), codes::kDuplicate, "a head has one `when`, or `else`",
                "join conditions with `and`; `else` stands in a head of its own");
  tokens.take();
  head.guard = guard;
}

/// Parses LIMIT -> CALL, behind `depth` or `minsize`.
void parseLimit(ParseContext& in, ExprId& limit, ExprId& call) {
  takeClause(in.tokens, limit != kNoId);
  limit = parseExpression(in);
  in.tokens.expect(Tok::arrow, "`->` and what to derive instead");
  call = parseShapeCall(in, "a shape or a rule to derive instead");
}

/// Parses one clause of a head. Returns false if no clause starts here.
bool parseClause(ParseContext& in, Alternative& head) {
  TokenStream& tokens = in.tokens;
  if (tokens.atWord("when")) {
    takeGuard(tokens, head, Guard::when);
    head.when = parseExpression(in);
  } else if (tokens.atWord("else")) {
    takeGuard(tokens, head, Guard::otherwise);
  } else if (tokens.atWord("weight")) {
    takeClause(tokens, head.weight != kNoId);
    head.weight = parseExpression(in);
  } else if (tokens.atWord("depth")) {
    parseLimit(in, head.depth, head.depth_call);
  } else if (tokens.atWord("minsize")) {
    parseLimit(in, head.minsize, head.minsize_call);
  } else if (tokens.atWord("lod")) {
    takeClause(tokens, head.lod != kNoId);
    if (tokens.atWord("far") || tokens.atWord("mid") || tokens.atWord("near"))
      tokens.fail(tokens.here(), codes::kSyntax, "lod takes the edge of the smallest cells that use this head",
                  "such as `lod 2m`");
    head.lod = parseExpression(in);
  } else {
    return false;
  }
  return true;
}

}  // namespace

void declareRule(ParseContext& in) {
  TokenStream& tokens = in.tokens;
  const Span begin = tokens.last();
  const Span name_span = tokens.here();
  Alternative head;
  const NameId name = parseNewName(in, "the name of a rule");
  head.formals = parseFormals(in);
  while (parseClause(in, head)) {
  }
  head.span = tokens.since(begin);
  if (!tokens.at(Tok::open_brace))
    return tokens.failExpecting("`{`, or `when`, `else`, `weight`, `depth`, `minsize` or `lod`");
  head.body = parseBlock(in);
  addHead(in, name, false, name_span, head, begin);
}

void declareMorphicRule(ParseContext& in) {
  TokenStream& tokens = in.tokens;
  const Span begin = tokens.last();
  const Span name_span = tokens.here();
  Alternative head;
  const NameId name = parseNewName(in, "the name of a rule");
  head.formals = parseFormals(in);
  head.span = tokens.since(begin);
  tokens.expect(Tok::colon, "`:`");
  StmtNode morph;
  morph.kind = StmtKind::morph;
  const Span morph_span = tokens.here();
  const StmtId from = parseMorphOperand(in);
  tokens.expect(Tok::arrow, "`->`");
  const StmtId to = parseMorphOperand(in);
  tokens.expectWord("by");
  morph.expr = parseExpression(in);
  morph.power = parseMorphPower(tokens);
  if (tokens.hasFailed()) return;
  morph.children = in.build.addIds({from, to});
  const StmtId inner = in.build.addStmt(morph, morph_span);
  StmtNode body;
  body.kind = StmtKind::block;
  body.children = in.build.addIds({inner});
  head.body = in.build.addStmt(body, morph_span);
  tokens.expect(Tok::semicolon, "`;`");
  addHead(in, name, true, name_span, head, begin);
}

}  // namespace sgm::parse
