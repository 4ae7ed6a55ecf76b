// Parts of scopes: split and comp.

#include <algorithm>

#include "grammar/parse/parser.h"
#include "grammar/syntax/keywords.h"
#include "grammar/text/codes.h"

namespace sgm {

StmtId Parser::addParts(StmtNode node, const Parts& parts, const Span& begin) {
  node.parts = {static_cast<uint32_t>(program_.ast.parts.size()), static_cast<uint32_t>(parts.nodes.size())};
  program_.ast.parts.insert(program_.ast.parts.end(), parts.nodes.begin(), parts.nodes.end());
  node.children = store(parts.bodies);
  return addStmt(node, begin);
}

bool Parser::partsEnd(const Span& begin) {
  if (accept(Tok::close_brace)) return true;
  if (!panic_ && !exhausted_) fail(begin, codes::kSyntax, "these parts are not closed", "a `}` is missing");
  return false;
}

std::optional<uint32_t> Parser::axisLetter(std::string_view what) {
  const bool letter = at(Tok::word) && textOf(peek()).size() == 1;
  const size_t axis = letter ? std::string_view("xyz").find(textOf(peek())) : std::string_view::npos;
  if (axis == std::string_view::npos) {
    unexpected(what);
    return std::nullopt;
  }
  take();
  return static_cast<uint32_t>(axis);
}

StmtId Parser::splitStatement() {
  const Span begin = here();
  take();
  StmtNode node;
  node.kind = StmtKind::split;
  const std::optional<uint32_t> axis = axisLetter("x, y or z to split along");
  if (!axis) return kNoId;
  node.extra = *axis;
  if (acceptWord("snap")) node.amount = expression();
  const Span open = here();
  if (panic_ || !expect(Tok::open_brace, "`{`")) return kNoId;
  Parts parts;
  const uint32_t errors = sink_.errorCount();
  splitParts(parts, false);
  if (!partsEnd(open)) return kNoId;
  if (parts.nodes.empty() && sink_.errorCount() == errors)
    sink_.error(since(begin), codes::kSyntax, "this split has no parts", "such as `split x { ~1m: Wall; }`");
  return addParts(node, parts, begin);
}

StmtId Parser::snapStatement() {
  const Span begin = here();
  take();
  StmtNode node;
  node.kind = StmtKind::snap;
  const std::optional<uint32_t> axis = axisLetter("x, y or z that the planes stand across");
  if (!axis) return kNoId;
  node.extra = *axis;
  node.expr = expression();
  if (!panic_ && acceptWord("from")) node.amount = expression();
  node.body = panic_ ? kNoId : bodyOf("snap");
  return panic_ ? kNoId : addStmt(node, begin);
}

void Parser::splitParts(Parts& parts, bool repeated) {
  while (!at(Tok::close_brace) && !at(Tok::end)) {
    if (accept(Tok::semicolon)) continue;
    const size_t first = next_;
    if (at(Tok::open_brace))
      splitGroup(parts, repeated);
    else
      splitPart(parts, repeated);
    if (!panic_) continue;
    if (exhausted_ || sink_.full()) return;
    synchronise(false, first);
  }
}

void Parser::splitGroup(Parts& parts, bool repeated) {
  const Span group = here();
  const size_t first = parts.nodes.size();
  // Parse it despite the error, so that the following text is not misread.
  if (repeated)
    sink_.error(group, codes::kSyntax, "a repeated group holds no other group", "split its parts once more instead");
  else if (std::any_of(parts.nodes.begin(), parts.nodes.end(), [](const PartNode& p) { return p.repeated; }))
    sink_.error(group, codes::kDuplicate, "this split has a second repeated group",
                "put its parts into the first one, or split a part once more");
  Deeper deeper(*this);
  if (!deeper.fits()) return;
  take();
  const uint32_t errors = sink_.errorCount();
  splitParts(parts, true);
  if (!partsEnd(group) || !expect(Tok::star, "`*` after the parts that are repeated")) return;
  if (parts.nodes.size() == first && sink_.errorCount() == errors)
    sink_.error(since(group), codes::kSyntax, "this repeated group has no parts", "such as `{ ~2m: Bay; }*`");
  for (size_t i = first; i < parts.nodes.size(); ++i) parts.nodes[i].group = since(group);
}

void Parser::splitPart(Parts& parts, bool repeated) {
  PartNode part;
  const Span begin = here();
  part.repeated = repeated;
  part.flexible = accept(Tok::tilde);
  part.size = expression();
  expect(Tok::colon, "`:` and what stands in this part");
  const StmtId body = bodyOf("this part");
  if (panic_ || body == kNoId) return;
  part.span = since(begin);
  parts.nodes.push_back(part);
  parts.bodies.push_back(body);
}

StmtId Parser::compStatement() {
  const Span begin = here();
  take();
  StmtNode node;
  node.kind = StmtKind::comp;
  const Span open = here();
  if (!expect(Tok::open_brace, "`{`")) return kNoId;
  const uint32_t errors = sink_.errorCount();
  Parts parts;
  while (!at(Tok::close_brace) && !at(Tok::end)) {
    if (accept(Tok::semicolon)) continue;
    const size_t first = next_;
    compPart(parts);
    if (!panic_) continue;
    if (exhausted_ || sink_.full()) return kNoId;
    synchronise(false, first);
  }
  if (!partsEnd(open)) return kNoId;
  if (parts.nodes.empty() && sink_.errorCount() == errors)
    sink_.error(since(begin), codes::kSyntax, "this comp names no part of the box", "such as `comp { side: Wall; }`");
  return addParts(node, parts, begin);
}

void Parser::compPart(Parts& parts) {
  PartNode part;
  const Span begin = here();
  const auto words = boxPartTable();
  const auto word = std::find(words.begin(), words.end(), at(Tok::word) ? textOf(peek()) : std::string_view());
  if (word == words.end()) {
    if (!at(Tok::word) || peek(1).kind != Tok::colon) return unexpected("a part of the box such as `front:`");
    Suggestion suggestion(textOf(peek()));
    for (const std::string_view known : words) suggestion.offer(known);
    return fail(begin, codes::kUnknownName, join({"a box has no part `", textOf(peek()), "`"}),
                suggestion.best().empty() ? "it has front, back, left, right, side, top, bottom, edges, inside"
                                          : suggestion.hint());
  }
  part.of = static_cast<BoxPart>(word - words.begin());
  if (std::any_of(parts.nodes.begin(), parts.nodes.end(), [&](const PartNode& p) { return p.of == part.of; }))
    return fail(begin, codes::kDuplicate, join({"`", *word, "` stands twice in this comp"}),
                "put both into one block after it");
  take();
  expect(Tok::colon, "`:`");
  const StmtId body = bodyOf("this part");
  if (panic_ || body == kNoId) return;
  part.span = since(begin);
  parts.nodes.push_back(part);
  parts.bodies.push_back(body);
}

}  // namespace sgm
