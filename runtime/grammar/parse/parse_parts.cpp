#include "grammar/parse/parse_parts.h"

#include "grammar/text/codes.h"

namespace sgm::parse {

void addPart(ParseContext& in, Parts& parts, PartNode part, StmtId body, const Span& begin) {
  if (in.tokens.hasFailed() || body == kNoId) return;
  part.span = in.tokens.since(begin);
  parts.nodes.push_back(part);
  parts.bodies.push_back(body);
}

bool parsePartsEnd(ParseContext& in, const Span& begin) {
  if (in.tokens.accept(Tok::close_brace)) return true;
  in.tokens.fail(begin, codes::kSyntax, "these parts are not closed", "a `}` is missing");
  return false;
}

StmtId finishParts(ParseContext& in, StmtScope& stmt, const Parts& parts) {
  stmt->parts = in.build.addRange(&Ast::parts, parts.nodes);
  stmt->children = in.build.addIds(parts.bodies);
  return stmt.finish();
}

std::optional<uint32_t> parseAxis(TokenStream& tokens, std::string_view what) {
  const bool letter = tokens.at(Tok::word) && tokens.text().size() == 1;
  const size_t axis = letter ? std::string_view("xyz").find(tokens.text()) : std::string_view::npos;
  if (axis == std::string_view::npos) {
    tokens.failExpecting(what);
    return std::nullopt;
  }
  tokens.take();
  return static_cast<uint32_t>(axis);
}

}  // namespace sgm::parse
