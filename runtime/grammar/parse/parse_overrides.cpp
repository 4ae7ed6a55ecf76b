// Parses overrides, and `inner` in their blocks.

#include "grammar/parse/parse_declarations.h"
#include "grammar/parse/parse_statements.h"
#include "grammar/parse/stmt_scope.h"
#include "grammar/text/codes.h"

namespace sgm::parse {

void declareOverride(ParseContext& in) {
  TokenStream& tokens = in.tokens;
  const Span begin = tokens.last();
  Override edit;
  edit.by_tag = tokens.acceptWord("tag");
  edit.address_span = tokens.here();
  edit.address = parseText(in, edit.by_tag ? "a tag in quotes" : "a derivation path in quotes, or `tag`");
  in.inners = 0;
  edit.body = parseBlock(in);
  in.inners.reset();
  edit.span = tokens.since(begin);
  declare(in, ItemKind::overriding, begin, in.program.overrides, edit);
}

StmtId parseInner(ParseContext& in) {
  StmtScope stmt(in, StmtKind::inner);
  if (!in.inners)
    in.tokens.fail(stmt.begin(), codes::kWrongUse, "`inner` stands in overrides only",
                   "it derives the block that an override replaces");
  else
    stmt->extra = (*in.inners)++;
  in.tokens.expect(Tok::semicolon, "`;`");
  return stmt.finish();
}

}  // namespace sgm::parse
