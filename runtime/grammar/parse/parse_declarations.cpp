#include "grammar/parse/parse_declarations.h"

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "grammar/parse/parse_expressions.h"
#include "grammar/syntax/keywords.h"
#include "grammar/text/codes.h"

namespace sgm::parse {

namespace {

/// The syntax of a kind of declaration.
struct DeclarationForm {
  std::string_view word;  ///< the word that starts the declaration
  void (*declare)(ParseContext&);
  /// true: the declaration may bound shapes, so if it fails to parse, shapes may wrongly seem unbounded
  bool may_bound;
};

constexpr std::array<DeclarationForm, 14> kForms = {{
    {"import", declareImport, false},
    {"units", declareUnits, true},
    {"param", declareParam, true},
    {"seed", declareSeed, true},
    {"let", declareLet, false},
    {"field", declareField, false},
    {"domain", declareDomain, true},
    {"layer", declareLayer, true},
    {"start", declareStart, true},
    {"rule", declareRule, false},
    {"morphic", declareMorphicRule, false},
    {"override", declareOverride, true},
    {"report", declareReport, true},
    {"expect", declareExpectation, true},
}};

/// Reports that no declaration starts with the current token.
void failAtUnknown(TokenStream& tokens) {
  if (tokens.failIfUnavailable()) return;
  if (tokens.at(Tok::close_brace)) {
    tokens.report(tokens.here(), codes::kSyntax, "this `}` has no `{`", "remove it");
    tokens.take();
    return;
  }
  std::string hint;
  if (tokens.at(Tok::word)) {
    Suggestion suggestion(tokens.text());
    for (const std::string_view word : declarationTable()) suggestion.offer(word);
    hint = suggestion.hintOr("shapes stand in rules: rule Name { ... }");
  }
  tokens.fail(tokens.here(), codes::kSyntax, join({"expected a declaration, found `", tokens.text(), "`"}),
              std::move(hint));
}

}  // namespace

void parseDeclaration(ParseContext& in) {
  TokenStream& tokens = in.tokens;
  const size_t first = tokens.position();
  const auto form = std::find_if(kForms.begin(), kForms.end(),
                                 [&](const DeclarationForm& candidate) { return tokens.atWord(candidate.word); });
  if (form != kForms.end()) {
    tokens.take();
    form->declare(in);
  } else {
    failAtUnknown(tokens);
  }
  if (!tokens.hasFailed()) return;
  recover(in, Level::declaration, first);
  if (form == kForms.end() || form->may_bound) in.syntax.bounded = false;
}

void addItem(ParseContext& in, ItemKind kind, size_t index, const Span& begin, size_t sub) {
  if (in.tokens.hasFailed()) return;
  in.syntax.items.push_back({kind, static_cast<uint32_t>(index), static_cast<uint32_t>(sub), in.tokens.since(begin)});
}

IdRange parseFormals(ParseContext& in) {
  constexpr size_t kMaxFormals = 16;
  TokenStream& tokens = in.tokens;
  std::vector<FormalNode> list;
  if (!tokens.accept(Tok::open_paren)) return {};
  while (!tokens.at(Tok::close_paren) && !tokens.hasFailed()) {
    FormalNode formal;
    const Span begin = tokens.here();
    formal.name = parseNewName(in, "the name of a parameter");
    formal.slot = static_cast<uint32_t>(list.size());
    if (tokens.accept(Tok::assign)) formal.fallback = parseExpression(in);
    if (tokens.acceptWord("in")) {
      formal.low_expr = parseExpression(in);
      tokens.expect(Tok::dots, "`..`");
      formal.high_expr = parseExpression(in);
      if (tokens.at(Tok::assign))
        tokens.fail(tokens.here(), codes::kSyntax, "a default stands before the range", "such as r = 2m in 1m..60m");
    }
    formal.span = tokens.since(begin);
    list.push_back(formal);
    if (list.size() > kMaxFormals)
      tokens.fail(begin, codes::kTooLarge, "this has more than 16 parameters", "a vector holds three numbers in one");
    if (!tokens.accept(Tok::comma)) break;
  }
  tokens.expect(Tok::close_paren, "`)` or `,`");
  return tokens.hasFailed() ? IdRange{} : in.build.addRange(&Ast::formals, list);
}

void declareImport(ParseContext& in) {
  TokenStream& tokens = in.tokens;
  const Span begin = tokens.last();
  ImportDecl import;
  import.path_span = tokens.here();
  import.path = parseText(in, "the path of a file in quotes");
  tokens.expectWord("as");
  import.alias_span = tokens.here();
  import.alias = parseNewName(in, "the name of an import");
  tokens.expect(Tok::semicolon, "`;`");
  declare(in, ItemKind::import, begin, in.syntax.imports, import);
}

void declareUnits(ParseContext& in) {
  TokenStream& tokens = in.tokens;
  const Span begin = tokens.last();
  const Span word = tokens.here();
  const NameId unit = parseName(in, "a unit of length");
  const std::string_view text = in.program.text(unit);
  if (text != "m" && text != "cm" && text != "mm" && text != "km")
    tokens.fail(word, codes::kUnknownUnit, join({"unknown unit of length `", text, "`"}), "units are m, cm, mm and km");
  tokens.expect(Tok::semicolon, "`;`");
  if (tokens.hasFailed()) return;
  if (in.syntax.unit != kNoId)
    in.sink.error(tokens.since(begin), codes::kDuplicate, "`units` is declared twice", kRemoveOne);
  in.syntax.unit = unit;
  in.syntax.unit_span = begin;
  addItem(in, ItemKind::units, 0, begin);
}

void declareParam(ParseContext& in) {
  TokenStream& tokens = in.tokens;
  const Span begin = tokens.last();
  Param param;
  param.module = in.syntax.module;
  param.span = tokens.here();
  param.name = parseNewName(in, "the name of a parameter");
  tokens.expect(Tok::assign, "`=`");
  param.value_expr = parseExpression(in);
  if (tokens.acceptWord("in")) {
    param.low_expr = parseExpression(in);
    tokens.expect(Tok::dots, "`..`");
    param.high_expr = parseExpression(in);
    param.has_range = true;
  }
  param.animated = tokens.acceptWord("animated");
  if (tokens.at(Tok::text)) param.doc = parseText(in, "a text");
  tokens.expect(Tok::semicolon, "`;`");
  declare(in, ItemKind::param, begin, in.program.params, param);
}

void declareSeed(ParseContext& in) {
  TokenStream& tokens = in.tokens;
  const Span begin = tokens.last();
  if (tokens.at(Tok::word) && tokens.peek(1).kind == Tok::semicolon)
    tokens.fail(tokens.here(), codes::kSyntax,
                join({"a seed is a whole number (0 or more) or a text, and `", tokens.text(), "` is a name"}),
                join({"write it in quotes, \"", tokens.text(), "\""}));
  const ExprId seed = parseExpression(in);
  tokens.expect(Tok::semicolon, "`;`");
  if (tokens.hasFailed()) return;
  if (in.syntax.seed != kNoId)
    in.sink.error(tokens.since(begin), codes::kDuplicate, "`seed` is declared twice", kRemoveOne);
  in.syntax.seed = seed;
  in.syntax.seed_span = tokens.since(begin);
  addItem(in, ItemKind::seed, 0, begin);
}

void declareLet(ParseContext& in) {
  TokenStream& tokens = in.tokens;
  const Span begin = tokens.last();
  Let let;
  let.module = in.syntax.module;
  let.span = tokens.here();
  let.name = parseNewName(in, "a name");
  let.function = tokens.at(Tok::open_paren);
  let.formals = parseFormals(in);
  let.slot_count = let.formals.count;
  tokens.expect(Tok::assign, "`=`");
  let.body = parseExpression(in);
  tokens.expect(Tok::semicolon, "`;`");
  declare(in, ItemKind::let, begin, in.program.lets, let);
}

uint32_t addField(ParseContext& in, bool local) {
  TokenStream& tokens = in.tokens;
  Field field;
  field.module = in.syntax.module;
  field.local = local;
  field.span = tokens.here();
  field.name = parseNewName(in, "the name of a field");
  field.formals = parseFormals(in);
  field.slot_count = field.formals.count;
  tokens.expect(Tok::assign, "`=`");
  field.body = parseExpression(in);
  tokens.expect(Tok::semicolon, "`;`");
  if (tokens.hasFailed()) return kNoId;
  in.program.fields.push_back(field);
  return static_cast<uint32_t>(in.program.fields.size() - 1);
}

void declareField(ParseContext& in) {
  const Span begin = in.tokens.last();
  const uint32_t field = addField(in, false);
  addItem(in, ItemKind::field, field, begin);
}

void declareStart(ParseContext& in) {
  TokenStream& tokens = in.tokens;
  const Span begin = tokens.last();
  const ExprId start = parseShapeCall(in, "the name of a rule");
  tokens.expect(Tok::semicolon, "`;`");
  if (tokens.hasFailed()) return;
  if (in.syntax.start != kNoId)
    in.sink.error(tokens.since(begin), codes::kDuplicate, "`start` is declared twice",
                  "call both rules in one, and start that");
  in.syntax.start = start;
  in.syntax.start_span = tokens.since(begin);
  addItem(in, ItemKind::start, 0, begin);
}

}  // namespace sgm::parse
