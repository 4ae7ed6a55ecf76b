// Parses the domain and the layers of a world.

#include <string_view>
#include <utility>

#include "grammar/parse/parse_declarations.h"
#include "grammar/parse/parse_expressions.h"
#include "grammar/text/codes.h"

namespace sgm::parse {

namespace {

/// Parses the axes of the domain: a NAME made of x, y and z. word: the span of the word `axes` before it.
void parseAxes(TokenStream& tokens, DomainDecl& domain, const Span& word) {
  const std::string_view axes = tokens.text();
  bool good = tokens.at(Tok::word) && axes.size() <= 3 && !domain.axes_written;
  domain.axes = {false, false, false};
  for (const char c : axes) {
    if (c < 'x' || c > 'z' || domain.axes[static_cast<size_t>(c - 'x')])
      good = false;
    else
      domain.axes[static_cast<size_t>(c - 'x')] = true;
  }
  if (!good)
    tokens.fail(tokens.here(), codes::kSyntax, "expected axes such as xz",
                "write the axes along which there are cells");
  if (!domain.infinite)
    tokens.fail(word, codes::kDomain, "a finite domain has no axes", "write `domain infinite axes ...`");
  tokens.take();
  domain.axes_written = true;
}

/// Parses the filling of the domain: `solid [MATERIAL]` or `empty`.
void parseFilling(ParseContext& in, DomainDecl& domain) {
  TokenStream& tokens = in.tokens;
  if (domain.solid || domain.empty)
    tokens.fail(tokens.here(), codes::kDuplicate, "the domain has a second `solid` or `empty`", kRemoveOne);
  domain.solid = tokens.atWord("solid");
  domain.empty = !domain.solid;
  tokens.take();
  const bool clause = tokens.atWord("output") || tokens.atWord("axes") || tokens.atWord("box") ||
                      tokens.atWord("solid") || tokens.atWord("empty");
  if (domain.solid && tokens.at(Tok::word) && !clause) domain.material = parseNewName(in, "a material");
}

void parseBox(ParseContext& in, DomainDecl& domain) {
  TokenStream& tokens = in.tokens;
  const Span word = tokens.here();
  if (domain.infinite)
    tokens.fail(word, codes::kDomain, "an infinite domain has no box", "write `domain finite box(...)`");
  if (domain.box) tokens.fail(word, codes::kDuplicate, "the domain has a second `box`", kRemoveOne);
  tokens.take();
  domain.box = true;
  domain.box_args = addArguments(in, "box");
}

}  // namespace

void declareDomain(ParseContext& in) {
  TokenStream& tokens = in.tokens;
  const Span begin = tokens.last();
  DomainDecl domain;
  domain.present = true;
  if (tokens.acceptWord("infinite"))
    domain.infinite = true;
  else if (!tokens.acceptWord("finite"))
    tokens.failExpecting("`finite` or `infinite`");
  while (tokens.at(Tok::word)) {
    const Span word = tokens.here();
    if (tokens.acceptWord("axes")) {
      parseAxes(tokens, domain, word);
    } else if (tokens.atWord("solid") || tokens.atWord("empty")) {
      parseFilling(in, domain);
    } else if (tokens.acceptWord("output")) {
      tokens.expectWord("density");
      domain.density = true;
      if (tokens.acceptWord("edge")) domain.density_edge = parseExpression(in);
    } else if (tokens.atWord("box")) {
      parseBox(in, domain);
    } else {
      tokens.failExpecting("`solid`, `empty`, `axes`, `box`, `output` or `;`");
    }
  }
  tokens.expect(Tok::semicolon, "`;`");
  if (tokens.hasFailed()) return;
  domain.span = tokens.since(begin);
  if (in.syntax.domain.present) in.sink.error(domain.span, codes::kDuplicate, "`domain` is declared twice", kRemoveOne);
  in.syntax.domain = domain;
  addItem(in, ItemKind::domain, 0, begin);
}

void declareLayer(ParseContext& in) {
  TokenStream& tokens = in.tokens;
  const Span begin = tokens.last();
  LayerDecl layer;
  layer.span = tokens.here();
  layer.name = parseNewName(in, "the name of a layer");
  tokens.expectWord("cell");
  layer.cell = parseExpression(in);
  tokens.expectWord("reach");
  layer.reach = parseExpression(in);
  if (tokens.acceptWord("detail")) layer.detail = parseExpression(in);
  if (tokens.acceptWord("uses")) {
    do {
      const Span place = tokens.here();
      layer.uses.push_back({parseName(in, "the name of a layer"), place});
    } while (tokens.accept(Tok::comma));
  }
  layer.span = tokens.since(layer.span);
  tokens.expect(Tok::open_brace, "`{`");
  tokens.expectWord("start");
  layer.start = parseShapeCall(in, "the name of a rule");
  tokens.expect(Tok::semicolon, "`;`");
  tokens.expect(Tok::close_brace, "`}`");
  declare(in, ItemKind::layer, begin, in.syntax.layers, std::move(layer));
}

}  // namespace sgm::parse
