#include <optional>

#include "grammar/parse/parser.h"
#include "grammar/syntax/precedence.h"
#include "grammar/text/codes.h"

namespace sgm {

namespace {

constexpr uint16_t kDeepestTree = 128;  // for trees built by loops, a + b + c ...

std::optional<BinaryOp> operatorOf(Tok kind, std::string_view text) {
  switch (kind) {
    case Tok::plus:
      return BinaryOp::add;
    case Tok::minus:
      return BinaryOp::subtract;
    case Tok::star:
      return BinaryOp::multiply;
    case Tok::slash:
      return BinaryOp::divide;
    case Tok::less:
      return BinaryOp::less;
    case Tok::less_equal:
      return BinaryOp::less_equal;
    case Tok::greater:
      return BinaryOp::greater;
    case Tok::greater_equal:
      return BinaryOp::greater_equal;
    case Tok::equal:
      return BinaryOp::equal;
    case Tok::not_equal:
      return BinaryOp::not_equal;
    case Tok::word:
      break;
    default:
      return std::nullopt;
  }
  if (text == "or") return BinaryOp::logical_or;
  if (text == "and") return BinaryOp::logical_and;
  return std::nullopt;
}

}  // namespace

ExprId Parser::addExpr(ExprNode node, const Span& begin) {
  if (!nodeBudget()) return kNoId;
  node.span = since(begin);
  uint16_t depth = 0;
  auto include = [&](ExprId child) {
    if (child != kNoId && child >= first_expr_) depth = std::max(depth, depth_[child - first_expr_]);
  };
  for (uint32_t i = 0; i < node.children.count; ++i) include(program_.ast.ids[node.children.first + i]);
  for (uint32_t i = 0; i < node.args.count; ++i) include(program_.ast.args[node.args.first + i].value);
  if (++depth > kDeepestTree) {
    fail(node.span, codes::kTooDeep, join({"the expression has more than ", std::to_string(kDeepestTree), " steps"}),
         "name a part of it with let");
    depth = kDeepestTree;
  }
  program_.ast.exprs.push_back(node);
  depth_.push_back(depth);
  return static_cast<ExprId>(program_.ast.exprs.size() - 1);
}

ExprId Parser::expression() {
  Deeper deeper(*this);
  if (!deeper.fits()) return kNoId;
  if (!atWord("if")) return binaryLevel(1);
  const Span begin = here();
  take();
  const ExprId condition = expression();
  expectWord("then");
  const ExprId yes = expression();
  expectWord("else");
  const ExprId no = expression();
  if (panic_) return kNoId;
  ExprNode node;
  node.kind = ExprKind::conditional;
  node.children = store({condition, yes, no});
  return addExpr(node, begin);
}

ExprId Parser::rangeOrExpression() {
  const Span begin = here();
  const ExprId low = expression();
  if (!accept(Tok::dots)) return low;
  const ExprId high = expression();
  if (panic_) return kNoId;
  ExprNode node;
  node.kind = ExprKind::range;
  node.children = store({low, high});
  return addExpr(node, begin);
}

ExprId Parser::binaryLevel(int lowest) {
  const Span begin = here();
  ExprId left = unary();
  for (;;) {
    const std::optional<BinaryOp> op = operatorOf(peek().kind, textOf(peek()));
    if (panic_ || !op || precedenceOf(*op) < lowest) return left;
    const Span sign = here();
    take();
    const ExprId right = binaryLevel(precedenceOf(*op) + 1);
    if (panic_) return kNoId;
    ExprNode node;
    node.kind = ExprKind::binary;
    node.binary = *op;
    node.children = store({left, right});
    left = addExpr(node, begin);
    const std::optional<BinaryOp> next = operatorOf(peek().kind, textOf(peek()));
    if (precedenceOf(*op) == kComparison && next && precedenceOf(*next) == kComparison)
      fail(sign, codes::kSyntax, "comparisons do not chain", "join two comparisons with `and`");
  }
}

ExprId Parser::unary() {
  const Span begin = here();
  const bool minus = at(Tok::minus), negation = atWord("not");
  if (!minus && !negation) return postfix();
  Deeper deeper(*this);
  if (!deeper.fits()) return kNoId;
  take();
  // `not a < b` negates the comparison; a minus applies to the next operand.
  const ExprId operand = negation ? binaryLevel(kComparison) : unary();
  if (panic_) return kNoId;
  ExprNode node;
  node.kind = minus ? ExprKind::negate : ExprKind::logical_not;
  node.children = store({operand});
  return addExpr(node, begin);
}

ExprId Parser::postfix() {
  const Span begin = here();
  ExprId value = primary();
  while (!panic_ && (at(Tok::dot) || at(Tok::open_paren))) {
    if (value == kNoId) return kNoId;
    const ExprKind kind = program_.ast.exprs[value].kind;
    if (at(Tok::dot)) {
      take();
      ExprNode node;
      node.kind = ExprKind::member;
      node.name = wordName("a name after the point");
      if (panic_) return kNoId;
      node.children = store({value});
      value = addExpr(node, begin);
      continue;
    }
    if (kind != ExprKind::name && kind != ExprKind::member) return value;
    // The call takes over the name, and the receiver if there is one.
    ExprNode node = program_.ast.exprs[value];
    node.kind = ExprKind::call;
    const std::vector<ArgNode> args = arguments(nameOf(node.name));
    if (panic_) return kNoId;
    node.args = storeArgs(args);
    value = addExpr(node, begin);
  }
  return value;
}

ExprId Parser::primary() {
  const Span begin = here();
  ExprNode node;
  switch (peek().kind) {
    case Tok::number:
      node.kind = ExprKind::number;
      node.value = peek().value;
      if (!peek().broken) node.type = {ValueKind::number, peek().dim, false, false};
      node.name = intern(textOf(peek()));
      take();
      return addExpr(node, begin);
    case Tok::text:
      node.kind = ExprKind::text;
      node.type.kind = ValueKind::text;
      node.name = textName("a text");
      return addExpr(node, begin);
    case Tok::open_paren:
      return parenthesised();
    case Tok::word:
      break;
    default:
      unexpected("an expression");
      return kNoId;
  }
  if (unavailable()) return kNoId;
  const std::string_view word = textOf(peek());
  if (word == "true" || word == "false") {
    node.kind = ExprKind::number;
    node.value = word == "true" ? 1 : 0;
    node.type.kind = ValueKind::boolean;
    node.name = intern(word);
    take();
    return addExpr(node, begin);
  }
  if (word == "if") return expression();
  if (word == "query") return query();
  if (peek().keyword && peek(1).kind != Tok::open_paren) {
    unexpected("an expression");
    return kNoId;
  }
  if (peek().keyword) {
    fail(here(), codes::kSyntax, join({"`", word, "` starts a statement and gives no value"}),
         "a value is a number, a name or a function such as max(a, b)");
    return kNoId;
  }
  node.kind = ExprKind::name;
  node.name = intern(word);
  take();
  return addExpr(node, begin);
}

/// query clear of LAYER, query inside RADIUS of LAYER.
ExprId Parser::query() {
  const Span begin = here();
  take();
  ExprNode node;
  node.kind = ExprKind::query;
  node.inside = atWord("inside");
  if (!node.inside && !atWord("clear")) {
    unexpected("`clear` or `inside`");
    return kNoId;
  }
  take();
  if (!atWord("of")) {
    const ExprId radius = expression();
    if (panic_) return kNoId;
    node.children = store({radius});
  }
  expectWord("of");
  node.name = wordName("the name of a layer");
  if (panic_) return kNoId;
  return addExpr(node, begin);
}

/// ( a ), the pair ( a, b ) and the vector ( a, b, c ).
ExprId Parser::parenthesised() {
  Deeper deeper(*this);
  if (!deeper.fits()) return kNoId;
  const Span begin = here();
  take();
  std::vector<uint32_t> parts{expression()};
  while (!panic_ && accept(Tok::comma)) parts.push_back(expression());
  expect(Tok::close_paren, "`)`");
  if (panic_) return kNoId;
  if (parts.size() == 1) {
    if (parts[0] != kNoId) program_.ast.exprs[parts[0]].parenthesised = true;
    return parts[0];
  }
  if (parts.size() > 3) {
    fail(since(begin), codes::kSyntax, "a vector has three parts, a pair two", "such as (1m, 2m, 3m)");
    return kNoId;
  }
  ExprNode node;
  node.kind = ExprKind::vector;
  node.children = store(parts);
  return addExpr(node, begin);
}

/// `name value`: a word before the start of an expression. Before a minus it is a name only if the callee has such a
/// parameter and the minus touches its operand: `halfspace(below -2m)`, `at(y -2m)`; otherwise write `name = -2m`.
bool Parser::namedArgumentAhead(std::string_view callee) const {
  if (peek().kind != Tok::word) return false;
  const std::string_view word = textOf(peek());
  if (word == "if" || word == "not" || word == "true" || word == "false" || word == "query") return false;
  const Token& next = peek(1);
  switch (next.kind) {
    case Tok::number:
    case Tok::text:
    case Tok::assign:
      return true;
    case Tok::word:
      return !operatorOf(next.kind, textOf(next)) && textOf(next) != "then" && textOf(next) != "else";
    case Tok::open_paren:
    case Tok::minus:
      break;
    default:
      return false;
  }
  if (!next.space_before || (next.kind == Tok::minus && peek(2).space_before)) return false;
  return namesArgument(callee, word);
}

std::vector<ArgNode> Parser::arguments(std::string_view callee) {
  constexpr size_t kMostArguments = 80;
  std::vector<ArgNode> args;
  if (!expect(Tok::open_paren, "`(`")) return args;
  while (!at(Tok::close_paren) && !panic_) {
    const Span begin = here();
    ArgNode arg;
    if (namedArgumentAhead(callee)) {
      arg.name = wordName("a name");
      accept(Tok::assign);
    }
    arg.value = expression();
    arg.span = since(begin);
    args.push_back(arg);
    if (args.size() > kMostArguments)
      fail(begin, codes::kTooLarge, "the call has more than 80 arguments", "split them among several shapes");
    if (!accept(Tok::comma)) break;
  }
  expect(Tok::close_paren, "`)` or `,`");
  return args;
}

/// Rule, rule(...) or module.Rule(...): always a call, with or without arguments.
ExprId Parser::callExpression(std::string_view what) {
  const Span begin = here();
  if (!at(Tok::word) || peek().keyword) {
    unexpected(what);
    return kNoId;
  }
  const ExprId callee = postfix();
  if (panic_ || callee == kNoId) return kNoId;
  ExprNode node = program_.ast.exprs[callee];
  if (node.kind == ExprKind::call) {
    program_.ast.exprs[callee].shape = true;
    return callee;
  }
  node.kind = ExprKind::call;
  node.shape = true;
  return addExpr(node, begin);
}

}  // namespace sgm
