#include "grammar/parse/parse_module.h"

#include "grammar/parse/parse_declarations.h"
#include "grammar/text/codes.h"

namespace sgm {

namespace parse {

namespace {

/// Parses `sgm 1;`. Returns false if the text is for another version of the language.
bool parseVersion(ParseContext& in) {
  TokenStream& tokens = in.tokens;
  const Span first = tokens.here();
  if (!tokens.acceptWord("sgm")) {
    if (!in.sink.full())
      in.sink.error(first, codes::kVersion, "a grammar starts with the version of its language",
                    "write `sgm 1;` first");
    return true;
  }
  if (tokens.at(Tok::number) && !tokens.peek().broken && tokens.text() != "1") {
    tokens.fail(tokens.here(), codes::kVersion, join({"this is version 1 of the language, not ", tokens.text()}),
                "write `sgm 1;`");
    return false;
  }
  tokens.expect(Tok::number, "the version number 1");
  tokens.expect(Tok::semicolon, "`;`");
  if (tokens.hasFailed())
    recover(in, Level::declaration, 0);
  else
    addItem(in, ItemKind::version, 0, first);
  return true;
}

}  // namespace

}  // namespace parse

ModuleSyntax parseModule(Program& program, NameTable& names, uint32_t module, const CompileLimits& limits,
                         DiagnosticSink& sink) {
  parse::TokenStream tokens(program.modules[module].text, module, limits, sink,
                            program.modules.get_allocator().resource());
  program.modules[module].comments = tokens.comments();
  parse::AstBuilder build(program.ast, names, tokens, limits.nodes);
  ModuleSyntax syntax;
  syntax.module = module;
  parse::ParseContext in{tokens, build, program, syntax, sink};
  syntax.readable = tokens.isReadable() && parse::parseVersion(in);
  if (!syntax.readable) syntax.complete = false;
  while (syntax.readable && !tokens.at(Tok::end) && !sink.full()) parse::parseDeclaration(in);
  return syntax;
}

}  // namespace sgm
