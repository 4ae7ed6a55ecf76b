#pragma once
// What the functions of the parser share while they parse one file, and what most of them need: names, recovery.
//
// Each function parses one construct from the current token on, and adds it to the tree. After an error it returns as
// it can, with kNoId for what it lacks: the stream has panicked then, and a loop over statements or declarations
// recovers.

#include <cstdint>
#include <map>
#include <optional>
#include <string_view>

#include "grammar/parse/ast_builder.h"
#include "grammar/parse/token_stream.h"
#include "grammar/syntax/program.h"
#include "grammar/syntax/syntax.h"
#include "grammar/text/sink.h"

namespace sgm::parse {

struct ParseContext {
  TokenStream& tokens;
  AstBuilder& build;
  Program& program;  ///< gets the declarations
  ModuleSyntax& syntax;
  DiagnosticSink& sink;
  std::map<NameId, uint32_t> rules{};  ///< of this file: indices in Program::rules
  std::optional<uint32_t> inners{};    ///< in the block of an override: the number of `inner` in it so far
  uint32_t joined = 0;                 ///< blocks of `meet` and `sum` around
};

/// Parse one word, or a text in quotes, and add it to the names. `of_what` stands for it in messages.
NameId wordName(ParseContext& in, std::string_view of_what);
NameId textName(ParseContext& in, std::string_view of_what);
/// The same for a new name: no word of the language.
NameId declaredName(ParseContext& in, std::string_view of_what);

/// Continues after an error, behind the part that begins with the token `first`.
void recover(ParseContext& in, Level level, size_t first);

/// Parses by `parse_one()` what stands within braces, up to the '}' or the end of the text; recovers after errors.
template <typename ParseOne>
void parseUntilBrace(ParseContext& in, const ParseOne& parse_one) {
  TokenStream& tokens = in.tokens;
  while (!tokens.at(Tok::close_brace) && !tokens.at(Tok::end)) {
    if (tokens.accept(Tok::semicolon)) continue;
    const size_t first = tokens.position();
    parse_one();
    if (!tokens.hasFailed()) continue;
    if (!tokens.canContinue()) return;
    recover(in, Level::statement, first);
  }
}

}  // namespace sgm::parse
