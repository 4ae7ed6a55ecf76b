#pragma once
// The state that the functions of the parser share while they parse one file; names; recovery after errors.
//
// Each function parses one construct from the current token on and adds it to the tree. After an error the stream
// panics, so that the functions return soon, with kNoId for missing parts; the innermost loop over statements, parts or
// declarations recovers.

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

/// The tokens of a file, the tree and the declarations so far, and the constructs around the current token.
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

/// Parse one word, or a text in quotes, and return its id; kNoId after an error, whose message calls it `of_what`.
NameId parseName(ParseContext& in, std::string_view of_what);
NameId parseText(ParseContext& in, std::string_view of_what);
/// The same for a new name, which must not be a word of the language.
NameId parseNewName(ParseContext& in, std::string_view of_what);

/// Ends the panic: parsing continues behind the part that begins with the token `first` and holds the error.
void recover(ParseContext& in, Level level, size_t first);

/// Calls `parse_one()` for each statement or part before the '}', or before the end of the text; recovers after errors.
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
