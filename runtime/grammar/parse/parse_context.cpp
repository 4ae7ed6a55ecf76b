#include "grammar/parse/parse_context.h"

#include <string>

#include "grammar/text/codes.h"

namespace sgm::parse {

NameId parseName(ParseContext& in, std::string_view of_what) {
  if (!in.tokens.at(Tok::word)) {
    in.tokens.failExpecting(of_what);
    return kNoId;
  }
  return in.build.addName(in.tokens.textOf(in.tokens.take()));
}

NameId parseText(ParseContext& in, std::string_view of_what) {
  if (!in.tokens.at(Tok::text)) {
    in.tokens.failExpecting(of_what);
    return kNoId;
  }
  return in.build.addName(textContent(in.tokens.textOf(in.tokens.take())));
}

NameId parseNewName(ParseContext& in, std::string_view of_what) {
  const Token& token = in.tokens.peek();
  if (token.kind == Tok::word && (token.keyword || token.unavailable)) {
    const std::string_view word = in.tokens.textOf(token);
    in.tokens.fail(token.span, codes::kReservedWord,
                   join({"`", word, "` is a word of the language and cannot be ", of_what}),
                   join({"choose another name, such as `", word, "_`"}));
    return kNoId;
  }
  return parseName(in, of_what);
}

void recover(ParseContext& in, Level level, size_t first) {
  in.syntax.complete = false;
  if (in.joined > 0) in.syntax.bounded = false;
  // Words in the skipped part may be the names of declarations, so uses of these names are not reported as unknown.
  for (const Token& token : in.tokens.skipFailed(level, first))
    if (token.kind == Tok::word) in.syntax.in_doubt.insert(in.build.addName(in.tokens.textOf(token)));
}

}  // namespace sgm::parse
