#include <algorithm>
#include <array>
#include <span>

#include "grammar/parse/parser.h"
#include "grammar/syntax/keywords.h"
#include "grammar/text/codes.h"

namespace sgm {

namespace {

constexpr const char* kRemove = "remove one of them";

}  // namespace

void Parser::item(ItemKind kind, size_t index, const Span& begin, size_t sub) {
  if (panic_) return;
  out_.items.push_back({kind, static_cast<uint32_t>(index), static_cast<uint32_t>(sub), since(begin)});
}

void Parser::declaration() {
  const Span begin = here();
  if (unavailable()) return;
  if (acceptWord("import")) return importDeclaration();
  if (acceptWord("units")) {
    const Span word = here();
    const bool again = out_.unit != kNoId;
    const NameId unit = wordName("a unit of length");
    const std::string_view text = nameOf(unit);
    if (!panic_ && text != "m" && text != "cm" && text != "mm" && text != "km")
      fail(word, codes::kUnknownUnit, join({"unknown unit of length `", text, "`"}), "units are m, cm, mm and km");
    expect(Tok::semicolon, "`;`");
    if (panic_) return;
    if (again) sink_.error(since(begin), codes::kDuplicate, "`units` is declared twice", kRemove);
    out_.unit = unit;
    out_.unit_span = begin;
    return item(ItemKind::units, 0, begin);
  }
  if (acceptWord("param")) return paramDeclaration();
  if (acceptWord("seed")) {
    if (at(Tok::word) && peek(1).kind == Tok::semicolon)
      fail(here(), codes::kSyntax,
           join({"a seed is a whole number (0 or more) or a text, and `", textOf(peek()), "` is a name"}),
           join({"write it in quotes, \"", textOf(peek()), "\""}));
    const ExprId seed = expression();
    expect(Tok::semicolon, "`;`");
    if (panic_) return;
    if (out_.seed != kNoId) sink_.error(since(begin), codes::kDuplicate, "`seed` is declared twice", kRemove);
    out_.seed = seed;
    out_.seed_span = since(begin);
    return item(ItemKind::seed, 0, begin);
  }
  if (acceptWord("let")) return letDeclaration();
  if (acceptWord("field")) return fieldDeclaration();
  if (acceptWord("domain")) return domainDeclaration();
  if (acceptWord("layer")) return layerDeclaration();
  if (acceptWord("start")) return startDeclaration();
  if (acceptWord("rule")) return ruleDeclaration();
  if (acceptWord("morphic")) return morphicDeclaration();
  if (acceptWord("override")) return overrideDeclaration();
  if (acceptWord("report")) return expectation(false);
  if (acceptWord("expect")) return expectation(true);
  if (at(Tok::close_brace)) {
    fail(begin, codes::kSyntax, "this `}` has no `{`", "remove it");
    panic_ = false;
    take();
    return;
  }
  std::string hint;
  if (at(Tok::word)) {
    Suggestion suggestion(textOf(peek()));
    for (std::string_view word : declarationTable()) suggestion.offer(word);
    hint = suggestion.hint();
    if (hint.empty()) hint = "shapes stand in rules: rule Name { ... }";
  }
  fail(begin, codes::kSyntax, join({"expected a declaration, found `", textOf(peek()), "`"}), std::move(hint));
}

void Parser::importDeclaration() {
  Span begin = last_;
  ImportDecl import;
  import.path_span = here();
  import.path = textName("the path of a file in quotes");
  expectWord("as");
  import.alias_span = here();
  import.alias = declaredName("the name of an import");
  expect(Tok::semicolon, "`;`");
  if (panic_) return;
  out_.imports.push_back(import);
  item(ItemKind::import, out_.imports.size() - 1, begin);
}

void Parser::paramDeclaration() {
  const Span begin = last_;
  Param param;
  param.module = out_.module;
  param.span = here();
  param.name = declaredName("the name of a parameter");
  expect(Tok::assign, "`=`");
  param.value_expr = expression();
  if (acceptWord("in")) {
    param.low_expr = expression();
    expect(Tok::dots, "`..`");
    param.high_expr = expression();
    param.has_range = true;
  }
  param.animated = acceptWord("animated");
  if (at(Tok::text)) param.doc = textName("a text");
  expect(Tok::semicolon, "`;`");
  if (panic_) return;
  program_.params.push_back(param);
  item(ItemKind::param, program_.params.size() - 1, begin);
}

IdRange Parser::formals() {
  constexpr size_t kMostFormals = 16;
  std::vector<FormalNode> list;
  if (!accept(Tok::open_paren)) return {};
  while (!at(Tok::close_paren) && !panic_) {
    FormalNode formal;
    const Span begin = here();
    formal.name = declaredName("the name of a parameter");
    formal.slot = static_cast<uint32_t>(list.size());
    if (accept(Tok::assign)) formal.fallback = expression();
    if (acceptWord("in")) {
      formal.low_expr = expression();
      expect(Tok::dots, "`..`");
      formal.high_expr = expression();
      if (at(Tok::assign))
        fail(here(), codes::kSyntax, "a default stands before the range", "such as r = 2m in 1m..60m");
    }
    formal.span = since(begin);
    list.push_back(formal);
    if (list.size() > kMostFormals)
      fail(begin, codes::kTooLarge, "this has more than 16 parameters", "a vector holds three numbers in one");
    if (!accept(Tok::comma)) break;
  }
  expect(Tok::close_paren, "`)` or `,`");
  if (panic_) return {};
  const IdRange range{static_cast<uint32_t>(program_.ast.formals.size()), static_cast<uint32_t>(list.size())};
  program_.ast.formals.insert(program_.ast.formals.end(), list.begin(), list.end());
  return range;
}

void Parser::letDeclaration() {
  const Span begin = last_;
  Let let;
  let.module = out_.module;
  let.span = here();
  let.name = declaredName("a name");
  let.function = at(Tok::open_paren);
  let.formals = formals();
  let.slot_count = let.formals.count;
  expect(Tok::assign, "`=`");
  let.body = expression();
  expect(Tok::semicolon, "`;`");
  if (panic_) return;
  program_.lets.push_back(let);
  item(ItemKind::let, program_.lets.size() - 1, begin);
}

uint32_t Parser::addField(bool local) {
  Field field;
  field.module = out_.module;
  field.local = local;
  field.span = here();
  field.name = declaredName("the name of a field");
  field.formals = formals();
  field.slot_count = field.formals.count;
  expect(Tok::assign, "`=`");
  field.body = expression();
  expect(Tok::semicolon, "`;`");
  if (panic_) return kNoId;
  program_.fields.push_back(field);
  return static_cast<uint32_t>(program_.fields.size() - 1);
}

void Parser::fieldDeclaration() {
  const Span begin = last_;
  const uint32_t field = addField(false);
  item(ItemKind::field, field, begin);
}

void Parser::domainDeclaration() {
  const Span begin = last_;
  DomainDecl domain;
  domain.present = true;
  if (acceptWord("infinite"))
    domain.infinite = true;
  else if (!acceptWord("finite"))
    unexpected("`finite` or `infinite`");
  while (at(Tok::word) && !panic_) {
    const Span word = here();
    if (acceptWord("axes")) {
      const std::string_view axes = textOf(peek());
      bool good = at(Tok::word) && axes.size() <= 3 && !domain.axes_written;
      domain.axes = {false, false, false};
      for (char c : axes) {
        if (c < 'x' || c > 'z' || domain.axes[static_cast<size_t>(c - 'x')])
          good = false;
        else
          domain.axes[static_cast<size_t>(c - 'x')] = true;
      }
      if (!good) fail(here(), codes::kSyntax, "expected axes such as xz", "write the axes along which there are cells");
      if (!domain.infinite)
        fail(word, codes::kDomain, "a finite domain has no axes", "write `domain infinite axes ...`");
      take();
      domain.axes_written = true;
    } else if (atWord("solid") || atWord("empty")) {
      if (domain.solid || domain.empty)
        fail(word, codes::kDuplicate, "the domain has a second `solid` or `empty`", kRemove);
      domain.solid = atWord("solid");
      domain.empty = !domain.solid;
      take();
      if (domain.solid && at(Tok::word) && !atWord("output") && !atWord("axes") && !atWord("box") && !atWord("solid") &&
          !atWord("empty"))
        domain.material = declaredName("a material");
    } else if (acceptWord("output")) {
      expectWord("density");
      domain.density = true;
      if (acceptWord("edge")) domain.density_edge = expression();
    } else if (atWord("box")) {
      if (domain.infinite)
        fail(word, codes::kDomain, "an infinite domain has no box", "write `domain finite box(...)`");
      if (domain.box) fail(word, codes::kDuplicate, "the domain has a second `box`", kRemove);
      take();
      domain.box = true;
      domain.box_args = storeArgs(arguments("box"));
    } else {
      unexpected("`solid`, `empty`, `axes`, `box`, `output` or `;`");
    }
  }
  expect(Tok::semicolon, "`;`");
  if (panic_) return;
  domain.span = since(begin);
  if (out_.domain.present) sink_.error(domain.span, codes::kDuplicate, "`domain` is declared twice", kRemove);
  out_.domain = domain;
  item(ItemKind::domain, 0, begin);
}

void Parser::layerDeclaration() {
  const Span begin = last_;
  LayerDecl layer;
  layer.span = here();
  layer.name = declaredName("the name of a layer");
  expectWord("cell");
  layer.cell = expression();
  expectWord("reach");
  layer.reach = expression();
  if (acceptWord("detail")) layer.detail = expression();
  if (acceptWord("uses")) {
    do {
      const Span place = here();
      layer.uses.push_back({wordName("the name of a layer"), place});
    } while (accept(Tok::comma));
  }
  if (!panic_) layer.span = since(layer.span);
  expect(Tok::open_brace, "`{`");
  expectWord("start");
  layer.start = callExpression("the name of a rule");
  expect(Tok::semicolon, "`;`");
  expect(Tok::close_brace, "`}`");
  if (panic_) return;
  out_.layers.push_back(std::move(layer));
  item(ItemKind::layer, out_.layers.size() - 1, begin);
}

void Parser::startDeclaration() {
  const Span begin = last_;
  const ExprId start = callExpression("the name of a rule");
  expect(Tok::semicolon, "`;`");
  if (panic_) return;
  if (out_.start != kNoId)
    sink_.error(since(begin), codes::kDuplicate, "`start` is declared twice", "call both rules in one, and start that");
  out_.start = start;
  out_.start_span = since(begin);
  item(ItemKind::start, 0, begin);
}

void Parser::expectation(bool expect_it) {
  const Span begin = last_;
  Expectation e;
  e.expect = expect_it;
  const Span word = here();
  const std::string_view measure = textOf(peek());
  const std::span<const std::string_view> measures = measureTable();
  const auto known = std::find(measures.begin(), measures.end(), measure);
  if (!at(Tok::word) || known == measures.end()) {
    Suggestion suggestion(measure);
    for (std::string_view m : measures) suggestion.offer(m);
    const std::string hint = suggestion.hint();
    fail(word, codes::kUnknownName, join({"unknown measure `", measure, "`"}),
         hint.empty() ? "measures are watertight, components, volume, area, triangles, genus and anchors" : hint);
    return;
  }
  e.measure = static_cast<Measure>(known - measures.begin());
  take();
  if (accept(Tok::open_paren)) {
    if (!atWord("air") && !atWord("solid")) unexpected("`air` or `solid`");
    e.of = wordName("`air` or `solid`");
    if (acceptWord("above")) e.above = expression();
    expect(Tok::close_paren, "`)`");
  }
  const Tok sign = peek().kind;
  if (sign >= Tok::less && sign <= Tok::not_equal) {
    constexpr std::array<BinaryOp, 6> kOps = {BinaryOp::less,          BinaryOp::less_equal, BinaryOp::greater,
                                              BinaryOp::greater_equal, BinaryOp::equal,      BinaryOp::not_equal};
    e.comparison = kOps[static_cast<size_t>(sign) - static_cast<size_t>(Tok::less)];
    e.compared = true;
    take();
    e.value = expression();
  }
  while (!panic_ && (atWord("in") || atWord("per"))) {
    const bool block = peek(1).kind == Tok::word && textOf(peek(1)) == "block";
    const bool twice = atWord("per") ? e.per_name != kNoId : block ? e.block != 0 : e.low != kNoId;
    if (twice) return fail(here(), codes::kDuplicate, "this stands here twice", kRemove);
    if (acceptWord("per")) {
      e.span = here();
      e.per_name = wordName("the name of a rule");
    } else {
      take();
      if (acceptWord("block")) {
        expect(Tok::open_paren, "`(`");
        const Token& cells = peek();
        if (cells.kind != Tok::number || !(cells.dim == kRatio) || cells.value < 1 || cells.value > 64 ||
            cells.value != static_cast<double>(static_cast<int32_t>(cells.value)))
          fail(here(), codes::kValueRange, "a block has 1 to 64 cells along an edge", "such as block(8)");
        e.block = static_cast<int32_t>(cells.value);
        take();
        expect(Tok::close_paren, "`)`");
      } else {
        e.low = expression();
        expect(Tok::dots, "`..`");
        e.high = expression();
      }
    }
  }
  expect(Tok::semicolon, "`;`");
  if (panic_) return;
  e.span = since(begin);
  program_.expectations.push_back(e);
  item(ItemKind::expectation, program_.expectations.size() - 1, begin);
}

}  // namespace sgm
