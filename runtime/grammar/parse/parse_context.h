#pragma once
// The parser state for one file, and functions for names and for recovery after errors.
//
// Each parse function parses one construct from the current token on and adds it to the tree. After an error the token
// stream is in panic mode (token_stream.h): the parse functions return early, with kNoId for missing parts, to the
// innermost loop over statements, parts or declarations, which recovers.

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

/// The state that all parse functions for one file share.
struct ParseContext {
  TokenStream& tokens;
  AstBuilder& build;
  Program& program;  ///< receives the parsed declarations
  ModuleSyntax& syntax;
  DiagnosticSink& sink;
  std::map<NameId, uint32_t> rules{};  ///< the rules of this file: index in Program::rules by name
  /// within an override's block: the number of `inner` statements so far; nullopt elsewhere
  std::optional<uint32_t> inners{};
  uint32_t joined = 0;  ///< the number of `meet` and `sum` blocks that enclose the current token
};

/// Parse a word, or a text in quotes, and return its id. After an error return kNoId; the message calls the missing
/// word `of_what`.
NameId parseName(ParseContext& in, std::string_view of_what);
NameId parseText(ParseContext& in, std::string_view of_what);
/// Like parseName(), for the name in a declaration: words of the language are errors.
NameId parseNewName(ParseContext& in, std::string_view of_what);

/// Ends panic mode: skips the rest of the part of the text that contains the error. This part begins with the token at
/// index `first`.
void recover(ParseContext& in, Level level, size_t first);

/// Calls `parse_one()` for each statement or part up to the '}' or the end of the text, and recovers after errors.
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
