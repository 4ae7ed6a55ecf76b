#include <array>

#include "grammar/parse/parser.h"
#include "grammar/syntax/foreign_words.h"
#include "grammar/syntax/keywords.h"
#include "grammar/text/codes.h"

namespace sgm {

namespace {

constexpr std::array<std::string_view, 28> kStatements = {
    "union", "cut",   "meet",    "sum",       "morph",   "displace", "warp",  "repeat", "for",  "scatter",
    "let",   "field", "mat",     "tag",       "anchor",  "detail",   "inner", "smooth", "when", "split",
    "snap",  "comp",  "treemap", "footprint", "extrude", "roof",     "wfc",   "fit"};

}  // namespace

StmtId Parser::addStmt(StmtNode node, const Span& begin) {
  if (!nodeBudget()) return kNoId;
  node.span = since(begin);
  program_.ast.stmts.push_back(node);
  return static_cast<StmtId>(program_.ast.stmts.size() - 1);
}

StmtId Parser::block() {
  Deeper deeper(*this);
  if (!deeper.fits()) return kNoId;
  const Span begin = here();
  if (!expect(Tok::open_brace, "`{`")) return kNoId;
  std::vector<uint32_t> list;
  while (!at(Tok::close_brace) && !at(Tok::end)) {
    if (accept(Tok::semicolon)) continue;
    const size_t first = next_;
    const StmtId stmt = statement();
    if (panic_) {
      if (exhausted_ || sink_.full()) return kNoId;
      synchronise(false, first);
    } else if (stmt != kNoId) {
      list.push_back(stmt);
    }
  }
  if (!accept(Tok::close_brace)) {
    if (!panic_ && !exhausted_) fail(begin, codes::kSyntax, "this block is not closed", "a `}` is missing");
    return kNoId;
  }
  StmtNode node;
  node.kind = StmtKind::block;
  node.children = store(list);
  return addStmt(node, begin);
}

/// Parses one statement with its end: statements that end like calls need a ';', blocks do not.
StmtId Parser::statement() {
  Deeper deeper(*this);
  if (!deeper.fits()) return kNoId;
  if (at(Tok::open_brace)) return block();
  if (unavailable()) return kNoId;
  if (atXform()) return transformStatement();
  if (atWord("union")) return combiner(StmtKind::unite, true);
  if (atWord("cut")) return combiner(StmtKind::cut, true);
  if (atWord("meet")) return combiner(StmtKind::meet, true);
  if (atWord("sum")) return combiner(StmtKind::sum, false);
  if (atWord("morph")) return morphStatement();
  if (atWord("displace")) return displaceStatement(StmtKind::displace);
  if (atWord("warp")) return displaceStatement(StmtKind::warp);
  if (atWord("repeat")) return repeatStatement();
  if (atWord("for")) return forStatement();
  if (atWord("scatter")) return scatterStatement();
  if (atWord("let")) return letStatement();
  if (atWord("field")) return fieldStatement();
  if (atWord("mat")) return nameStatement(StmtKind::mat);
  if (atWord("tag")) return nameStatement(StmtKind::tag);
  if (atWord("anchor")) return nameStatement(StmtKind::anchor);
  if (atWord("split")) return splitStatement();
  if (atWord("snap")) return snapStatement();
  if (atWord("comp")) return compStatement();
  if (atWord("treemap")) return treemapStatement();
  if (atWord("wfc")) return wfcStatement();
  if (atWord("detail")) return detailStatement();
  if (atWord("footprint")) return footprintStatement();
  if (atWord("extrude")) return extrudeStatement();
  if (atWord("roof")) return roofStatement();
  if (atWord("fit")) return fitStatement();
  if (atWord("inner")) return innerStatement();
  return callStatement();
}

StmtId Parser::callStatement() {
  const Span begin = here();
  if (at(Tok::word) && peek().keyword) {
    if (startsDeclaration(textOf(peek())))
      fail(begin, codes::kSyntax, join({"expected a statement, found `", textOf(peek()), "`"}),
           "close the block before it with `}`");
    else
      unexpected("a statement");
    return kNoId;
  }
  if (at(Tok::word) && peek(1).kind != Tok::open_paren && peek(1).kind != Tok::semicolon && peek(1).kind != Tok::dot &&
      peek(1).kind != Tok::close_brace) {
    Suggestion suggestion(textOf(peek()));
    for (std::string_view word : kStatements) suggestion.offer(word);
    for (std::string_view word : transformTable()) suggestion.offer(word);
    if (!suggestion.best().empty()) {
      fail(begin, codes::kSyntax, join({"`", textOf(peek()), "` does not start a statement"}), suggestion.hint());
      return kNoId;
    }
  }
  const std::string_view word = textOf(peek());
  StmtNode node;
  node.kind = StmtKind::call;
  node.expr = callExpression("a shape, a rule or a statement");
  if (panic_) return kNoId;
  if (const std::string_view ours = wordFor(word); !ours.empty() && !at(Tok::semicolon)) {
    fail(begin, codes::kSyntax, join({"`", word, "` does not start a statement"}), join({"write `", ours, "`"}));
    return kNoId;
  }
  if (at(Tok::open_brace)) {
    fail(here(), codes::kSyntax, "a call takes no block", "end the call with `;`");
    return kNoId;
  }
  expect(Tok::semicolon, "`;`");
  return panic_ ? kNoId : addStmt(node, begin);
}

/// A block, or one statement.
StmtId Parser::bodyOf(std::string_view word) {
  if (at(Tok::semicolon) || at(Tok::close_brace)) {
    unexpected(join({"a block or a statement for `", word, "`"}));
    return kNoId;
  }
  return statement();
}

StmtId Parser::combiner(StmtKind kind, bool smooth) {
  const Span begin = here();
  const std::string_view word = textOf(take());
  StmtNode node;
  node.kind = kind;
  if (atWord("smooth")) {
    if (!smooth) fail(here(), codes::kSyntax, "a sum is smooth by itself", "its width follows the radii of its leaves");
    take();
    node.amount = expression();
  }
  const bool joins = kind == StmtKind::meet || kind == StmtKind::sum;
  joined_ += joins ? 1 : 0;
  node.body = bodyOf(word);
  joined_ -= joins ? 1 : 0;
  return panic_ ? kNoId : addStmt(node, begin);
}

StmtId Parser::morphOperand() {
  if (at(Tok::open_brace)) return block();
  const Span begin = here();
  StmtNode node;
  node.kind = StmtKind::call;
  node.expr = callExpression("a shape or a rule");
  return panic_ ? kNoId : addStmt(node, begin);
}

StmtId Parser::morphStatement() {
  const Span begin = here();
  take();
  StmtNode node;
  node.kind = StmtKind::morph;
  expect(Tok::open_paren, "`(`");
  const StmtId from = morphOperand();
  expect(Tok::comma, "`,`");
  const StmtId to = morphOperand();
  expect(Tok::comma, "`,` and how far to morph, 0 to 1");
  node.expr = expression();
  expect(Tok::close_paren, "`)`");
  if (acceptWord("power"))
    node.power = true;
  else
    acceptWord("lerp");
  expect(Tok::semicolon, "`;`");
  if (panic_) return kNoId;
  node.children = store({from, to});
  return addStmt(node, begin);
}

StmtId Parser::displaceStatement(StmtKind kind) {
  const Span begin = here();
  const std::string_view word = textOf(take());
  StmtNode node;
  node.kind = kind;
  node.expr = expression();
  if (acceptWord("amp")) node.amount = expression();
  node.body = bodyOf(word);
  return panic_ ? kNoId : addStmt(node, begin);
}

StmtId Parser::repeatStatement() {
  const Span begin = here();
  take();
  StmtNode node;
  node.kind = StmtKind::repeat;
  node.expr = expression();
  node.xforms = xforms();
  node.body = bodyOf("repeat");
  return panic_ ? kNoId : addStmt(node, begin);
}

StmtId Parser::forStatement() {
  const Span begin = here();
  take();
  StmtNode node;
  node.kind = StmtKind::for_each;
  node.name = declaredName("the name of a loop variable");
  expectWord("in");
  node.expr = rangeOrExpression();
  node.body = bodyOf("for");
  return panic_ ? kNoId : addStmt(node, begin);
}

StmtId Parser::scatterStatement() {
  const Span begin = here();
  take();
  ScatterNode scatter;
  const Span points = here();
  if (atWord("poisson") && peek(1).kind == Tok::open_paren) {
    take();
    take();
    scatter.poisson = true;
    scatter.count = expression();
    expect(Tok::close_paren, "`)`");
  } else {
    scatter.count = expression();
  }
  if (acceptWord("on")) {
    if (atWord("shell"))
      scatter.area = ScatterArea::shell;
    else if (atWord("box"))
      scatter.area = ScatterArea::box;
    else if (atWord("disc"))
      scatter.area = ScatterArea::disc;
    else
      unexpected("`shell`, `box` or `disc`");
    const std::string_view word = textOf(take());
    scatter.args = storeArgs(arguments(word));
  } else if (!scatter.poisson && !panic_) {
    unexpected("`on` and where to scatter, such as `on disc(5m)`");
  }
  if (acceptWord("probe")) {
    scatter.probe = atWord("up") ? 1 : atWord("down") ? -1 : 0;
    if (scatter.probe == 0) unexpected("`up` or `down`");
    take();
    scatter.distance = expression();
    expectWord("of");
    scatter.span = here();
    scatter.layer_name = wordName("the name of a layer");
    if (acceptWord("gap")) {
      scatter.gap = declaredName("the name of the open length behind a point");
      expectWord("within");
      scatter.within = expression();
    }
  } else {
    scatter.span = points;
    if (atWord("gap") && peek(1).kind == Tok::word && peek(2).kind == Tok::word)
      unexpected("`probe up` or `probe down` before the gap");
  }
  if (acceptWord("when")) scatter.when = expression();
  StmtNode node;
  node.kind = StmtKind::scatter;
  node.body = bodyOf("scatter");
  if (panic_) return kNoId;
  program_.ast.scatters.push_back(scatter);
  node.extra = static_cast<uint32_t>(program_.ast.scatters.size() - 1);
  return addStmt(node, begin);
}

StmtId Parser::letStatement() {
  const Span begin = here();
  take();
  StmtNode node;
  node.kind = StmtKind::let;
  node.name = declaredName("a name");
  if (at(Tok::open_paren))
    fail(here(), codes::kSyntax, "a let with parameters stands outside of rules", "move it to the top of the file");
  expect(Tok::assign, "`=`");
  node.expr = expression();
  expect(Tok::semicolon, "`;`");
  return panic_ ? kNoId : addStmt(node, begin);
}

StmtId Parser::fieldStatement() {
  const Span begin = here();
  take();
  StmtNode node;
  node.kind = StmtKind::field;
  node.extra = addField(true);
  return panic_ ? kNoId : addStmt(node, begin);
}

StmtId Parser::nameStatement(StmtKind kind) {
  const Span begin = here();
  take();
  StmtNode node;
  node.kind = kind;
  if (kind == StmtKind::mat) {
    node.name = declaredName("the name of a material");
  } else if (kind == StmtKind::tag) {
    node.name = textName("a text in quotes");
  } else {
    node.name = declaredName("the kind of an anchor");
    if (at(Tok::text)) node.name2 = textName("a text");
  }
  expect(Tok::semicolon, "`;`");
  return panic_ ? kNoId : addStmt(node, begin);
}

StmtId Parser::detailStatement() {
  const Span begin = here();
  take();
  StmtNode node;
  node.kind = StmtKind::detail;
  node.expr = expression();
  node.body = bodyOf("detail");
  return panic_ ? kNoId : addStmt(node, begin);
}

StmtId Parser::innerStatement() {
  const Span begin = here();
  take();
  if (!overriding_)
    fail(begin, codes::kWrongUse, "`inner` stands in overrides only", "it derives the block that an override replaces");
  StmtNode node;
  node.kind = StmtKind::inner;
  node.extra = inners_++;
  expect(Tok::semicolon, "`;`");
  return panic_ ? kNoId : addStmt(node, begin);
}

bool Parser::atXform() const {
  for (std::string_view word : transformTable())
    if (atWord(word)) return true;
  return false;
}

XformNode Parser::xform() {
  const Span begin = here();
  const std::string_view word = textOf(take());
  XformNode node;
  for (size_t i = 0; i < transformTable().size(); ++i)
    if (word == transformTable()[i]) node.kind = static_cast<XformKind>(i);
  node.args = storeArgs(arguments(word));
  node.span = since(begin);
  return node;
}

IdRange Parser::xforms() {
  std::vector<XformNode> list;
  while (atXform() && !panic_) list.push_back(xform());
  if (panic_) return {};
  const IdRange range{static_cast<uint32_t>(program_.ast.xforms.size()), static_cast<uint32_t>(list.size())};
  program_.ast.xforms.insert(program_.ast.xforms.end(), list.begin(), list.end());
  return range;
}

StmtId Parser::transformStatement() {
  const Span begin = here();
  StmtNode node;
  node.kind = StmtKind::transform;
  const std::string_view word = textOf(peek());
  node.xforms = xforms();
  node.body = bodyOf(word);
  return panic_ ? kNoId : addStmt(node, begin);
}

}  // namespace sgm
