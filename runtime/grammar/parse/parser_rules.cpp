#include "base/hash.h"
#include "grammar/parse/parser.h"
#include "grammar/text/codes.h"

namespace sgm {

uint32_t Parser::ruleNamed(NameId name, bool morphic, const Span& span) {
  const auto found = rules_.find(name);
  if (found != rules_.end()) {
    if (morphic || program_.rules[found->second].morphic)
      sink_.error(span, codes::kDuplicate, join({"`", nameOf(name), "` is declared twice"}),
                  "a morphic rule has one head and no alternatives");
    return found->second;
  }
  Rule rule(program_.rules.get_allocator().resource());
  rule.name = name;
  rule.module = out_.module;
  rule.morphic = morphic;
  rule.name_hash = hashText(nameOf(name));
  rule.span = span;
  program_.rules.push_back(std::move(rule));
  const uint32_t index = static_cast<uint32_t>(program_.rules.size() - 1);
  rules_.emplace(name, index);
  return index;
}

void Parser::ruleDeclaration() {
  const Span begin = last_;
  const Span name_span = here();
  Alternative head;
  const NameId name = declaredName("the name of a rule");
  head.formals = formals();
  bool more = true;
  while (more && !panic_) {
    const Span clause = here();
    const std::string_view word = textOf(peek());
    auto once = [&](bool there) {
      if (there) fail(clause, codes::kDuplicate, join({"this head has a second `", word, "`"}), "remove one of them");
      take();
    };
    auto guard = [&] {
      if (head.guard != Guard::none)
        fail(clause, codes::kDuplicate, "a head has one `when`, or `else`",
             "join conditions with `and`; `else` stands in a head of its own");
      take();
    };
    if (atWord("when")) {
      guard();
      head.guard = Guard::when;
      head.when = expression();
    } else if (atWord("else")) {
      guard();
      head.guard = Guard::otherwise;
    } else if (atWord("weight")) {
      once(head.weight != kNoId);
      head.weight = expression();
    } else if (atWord("depth")) {
      once(head.depth != kNoId);
      head.depth = expression();
      expect(Tok::arrow, "`->` and what to derive instead");
      head.depth_call = callExpression("a shape or a rule to derive instead");
    } else if (atWord("minsize")) {
      once(head.minsize != kNoId);
      head.minsize = expression();
      expect(Tok::arrow, "`->` and what to derive instead");
      head.minsize_call = callExpression("a shape or a rule to derive instead");
    } else if (atWord("lod")) {
      once(head.lod != kNoId);
      if (atWord("far") || atWord("mid") || atWord("near"))
        fail(here(), codes::kSyntax, "lod takes the edge of the smallest cells that use this head", "such as `lod 2m`");
      head.lod = expression();
    } else {
      more = false;
    }
  }
  head.span = panic_ ? name_span : since(begin);
  if (!at(Tok::open_brace)) {
    unexpected("`{`, or `when`, `else`, `weight`, `depth`, `minsize` or `lod`");
    return;
  }
  head.body = block();
  if (panic_) return;
  const uint32_t rule = ruleNamed(name, false, name_span);
  program_.rules[rule].alternatives.push_back(head);
  item(ItemKind::alternative, rule, begin, program_.rules[rule].alternatives.size() - 1);
}

void Parser::morphicDeclaration() {
  const Span begin = last_;
  const Span name_span = here();
  Alternative head;
  const NameId name = declaredName("the name of a rule");
  head.formals = formals();
  head.span = panic_ ? name_span : since(begin);
  expect(Tok::colon, "`:`");
  StmtNode morph;
  morph.kind = StmtKind::morph;
  const Span morph_span = here();
  const StmtId from = morphOperand();
  expect(Tok::arrow, "`->`");
  const StmtId to = morphOperand();
  expectWord("by");
  morph.expr = expression();
  if (acceptWord("power"))
    morph.power = true;
  else
    acceptWord("lerp");
  if (panic_) return;
  morph.children = store({from, to});
  const StmtId inner = addStmt(morph, morph_span);
  StmtNode body;
  body.kind = StmtKind::block;
  body.children = store({inner});
  head.body = addStmt(body, morph_span);
  expect(Tok::semicolon, "`;`");
  if (panic_) return;
  const uint32_t rule = ruleNamed(name, true, name_span);
  program_.rules[rule].alternatives.push_back(head);
  item(ItemKind::alternative, rule, begin, program_.rules[rule].alternatives.size() - 1);
}

void Parser::overrideDeclaration() {
  const Span begin = last_;
  Override edit;
  edit.by_tag = acceptWord("tag");
  edit.address_span = here();
  edit.address = textName(edit.by_tag ? "a tag in quotes" : "a derivation path in quotes, or `tag`");
  overriding_ = true;
  inners_ = 0;
  edit.body = block();
  overriding_ = false;
  if (panic_) return;
  edit.span = since(begin);
  program_.overrides.push_back(edit);
  item(ItemKind::overriding, program_.overrides.size() - 1, begin);
}

}  // namespace sgm
