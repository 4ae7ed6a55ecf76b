#include "grammar/parse/parse_expressions.h"

#include <optional>

#include "grammar/syntax/precedence.h"
#include "grammar/text/codes.h"

namespace sgm::parse {

namespace {

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

std::optional<BinaryOp> operatorAt(const TokenStream& tokens) { return operatorOf(tokens.peek().kind, tokens.text()); }

/// Adds a node with these children; returns kNoId in panic mode.
ExprId addOperation(ParseContext& in, ExprNode node, const std::vector<ExprId>& children, const Span& begin) {
  if (in.tokens.hasFailed()) return kNoId;
  node.children = in.build.addIds(children);
  return in.build.addExpr(node, begin);
}

ExprNode nodeOf(ExprKind kind) {
  ExprNode node;
  node.kind = kind;
  return node;
}

/// Parses ( a ), the pair ( a, b ) or the vector ( a, b, c ).
ExprId parseParenthesised(ParseContext& in) {
  TokenStream& tokens = in.tokens;
  Nested nested(tokens);
  if (!nested.fits()) return kNoId;
  const Span begin = tokens.here();
  tokens.take();
  std::vector<ExprId> parts{parseExpression(in)};
  while (tokens.accept(Tok::comma)) parts.push_back(parseExpression(in));
  tokens.expect(Tok::close_paren, "`)`");
  if (tokens.hasFailed()) return kNoId;
  if (parts.size() == 1) {
    if (parts[0] != kNoId) in.build.expr(parts[0]).parenthesised = true;
    return parts[0];
  }
  if (parts.size() > 3) {
    tokens.fail(tokens.since(begin), codes::kSyntax, "a vector has three parts, a pair two", "such as (1m, 2m, 3m)");
    return kNoId;
  }
  return addOperation(in, nodeOf(ExprKind::vector), parts, begin);
}

/// Parses `query clear RADIUS of LAYER` or `query inside RADIUS of LAYER`. RADIUS may be omitted.
ExprId parseQuery(ParseContext& in) {
  TokenStream& tokens = in.tokens;
  const Span begin = tokens.here();
  tokens.take();
  ExprNode node = nodeOf(ExprKind::query);
  node.inside = tokens.atWord("inside");
  if (!node.inside && !tokens.atWord("clear")) {
    tokens.failExpecting("`clear` or `inside`");
    return kNoId;
  }
  tokens.take();
  if (!tokens.atWord("of")) {
    const ExprId radius = parseExpression(in);
    if (tokens.hasFailed()) return kNoId;
    node.children = in.build.addIds({radius});
  }
  tokens.expectWord("of");
  node.name = parseName(in, "the name of a layer");
  return tokens.hasFailed() ? kNoId : in.build.addExpr(node, begin);
}

/// Parses true, false, a name, or an expression that starts with a keyword.
ExprId parseWord(ParseContext& in) {
  TokenStream& tokens = in.tokens;
  if (tokens.failIfUnavailable()) return kNoId;
  const Span begin = tokens.here();
  const std::string_view word = tokens.text();
  ExprNode node;
  if (word == "true" || word == "false") {
    node.kind = ExprKind::number;
    node.value = word == "true" ? 1 : 0;
    node.type.kind = ValueKind::boolean;
    node.name = in.build.addName(word);
    tokens.take();
    return in.build.addExpr(node, begin);
  }
  if (word == "if") return parseExpression(in);
  if (word == "query") return parseQuery(in);
  if (tokens.peek().keyword && tokens.peek(1).kind != Tok::open_paren) {
    tokens.failExpecting("an expression");
    return kNoId;
  }
  if (tokens.peek().keyword) {
    tokens.fail(begin, codes::kSyntax, join({"`", word, "` starts a statement and gives no value"}),
                "a value is a number, a name or a function such as max(a, b)");
    return kNoId;
  }
  node.kind = ExprKind::name;
  node.name = in.build.addName(word);
  tokens.take();
  return in.build.addExpr(node, begin);
}

ExprId parsePrimary(ParseContext& in) {
  TokenStream& tokens = in.tokens;
  const Span begin = tokens.here();
  const Token& token = tokens.peek();
  ExprNode node;
  switch (token.kind) {
    case Tok::number:
      node.kind = ExprKind::number;
      node.value = token.value;
      if (!token.broken) node.type = {ValueKind::number, token.dim, false, false};
      node.name = in.build.addName(tokens.textOf(token));
      tokens.take();
      return in.build.addExpr(node, begin);
    case Tok::text:
      node.kind = ExprKind::text;
      node.type.kind = ValueKind::text;
      node.name = parseText(in, "a text");
      return in.build.addExpr(node, begin);
    case Tok::open_paren:
      return parseParenthesised(in);
    case Tok::word:
      return parseWord(in);
    default:
      tokens.failExpecting("an expression");
      return kNoId;
  }
}

/// Parses a primary expression with the members and calls behind it.
ExprId parsePostfix(ParseContext& in) {
  TokenStream& tokens = in.tokens;
  const Span begin = tokens.here();
  ExprId value = parsePrimary(in);
  while (tokens.at(Tok::dot) || tokens.at(Tok::open_paren)) {
    if (value == kNoId) return kNoId;
    if (tokens.accept(Tok::dot)) {
      ExprNode node = nodeOf(ExprKind::member);
      node.name = parseName(in, "a name after the point");
      value = addOperation(in, node, {value}, begin);
      continue;
    }
    // Converts the name node before the parentheses to a call node, with its receiver if it has one.
    ExprNode node = in.build.expr(value);
    if (node.kind != ExprKind::name && node.kind != ExprKind::member) return value;
    node.kind = ExprKind::call;
    const std::vector<ArgNode> args = parseArguments(in, in.program.text(node.name));
    if (tokens.hasFailed()) return kNoId;
    node.args = in.build.addRange(&Ast::args, args);
    value = in.build.addExpr(node, begin);
  }
  return value;
}

/// Parses an expression of operators that bind at least as tightly as `lowest` (Precedence).
ExprId parseBinary(ParseContext& in, int lowest);

ExprId parseUnary(ParseContext& in) {
  TokenStream& tokens = in.tokens;
  const Span begin = tokens.here();
  const bool minus = tokens.at(Tok::minus), negation = tokens.atWord("not");
  if (!minus && !negation) return parsePostfix(in);
  Nested nested(tokens);
  if (!nested.fits()) return kNoId;
  tokens.take();
  // `not a < b` negates the whole comparison, whereas a minus applies only to the next operand.
  const ExprId operand = negation ? parseBinary(in, kComparison) : parseUnary(in);
  return addOperation(in, nodeOf(minus ? ExprKind::negate : ExprKind::logical_not), {operand}, begin);
}

ExprId parseBinary(ParseContext& in, int lowest) {
  TokenStream& tokens = in.tokens;
  const Span begin = tokens.here();
  ExprId left = parseUnary(in);
  for (;;) {
    const std::optional<BinaryOp> op = operatorAt(tokens);
    if (!op || precedenceOf(*op) < lowest) return left;
    const Span sign = tokens.here();
    tokens.take();
    const ExprId right = parseBinary(in, precedenceOf(*op) + 1);
    ExprNode node = nodeOf(ExprKind::binary);
    node.binary = *op;
    left = addOperation(in, node, {left, right}, begin);
    const std::optional<BinaryOp> next = operatorAt(tokens);
    if (precedenceOf(*op) == kComparison && next && precedenceOf(*next) == kComparison)
      tokens.fail(sign, codes::kSyntax, "comparisons do not chain", "join two comparisons with `and`");
  }
}

/// Whether a named argument `name value` starts here: a word before the start of an expression. Before a minus, the
/// word is a name only if the callee has such a parameter and the minus touches its operand: `halfspace(below -2m)`,
/// `at(y -2m)`; otherwise write `name = -2m`.
bool isNamedArgumentAhead(const TokenStream& tokens, std::string_view callee) {
  if (!tokens.at(Tok::word)) return false;
  const std::string_view word = tokens.text();
  if (word == "if" || word == "not" || word == "true" || word == "false" || word == "query") return false;
  const Token& next = tokens.peek(1);
  switch (next.kind) {
    case Tok::number:
    case Tok::text:
    case Tok::assign:
      return true;
    case Tok::word: {
      const std::string_view second = tokens.textOf(next);
      return !operatorOf(next.kind, second) && second != "then" && second != "else";
    }
    case Tok::open_paren:
    case Tok::minus:
      break;
    default:
      return false;
  }
  if (!next.space_before || (next.kind == Tok::minus && tokens.peek(2).space_before)) return false;
  return namesArgument(callee, word);
}

}  // namespace

ExprId parseExpression(ParseContext& in) {
  TokenStream& tokens = in.tokens;
  Nested nested(tokens);
  if (!nested.fits()) return kNoId;
  if (!tokens.atWord("if")) return parseBinary(in, kOr);
  const Span begin = tokens.here();
  tokens.take();
  const ExprId condition = parseExpression(in);
  tokens.expectWord("then");
  const ExprId yes = parseExpression(in);
  tokens.expectWord("else");
  const ExprId no = parseExpression(in);
  return addOperation(in, nodeOf(ExprKind::conditional), {condition, yes, no}, begin);
}

ExprId parseRangeOrExpression(ParseContext& in) {
  const Span begin = in.tokens.here();
  const ExprId low = parseExpression(in);
  if (!in.tokens.accept(Tok::dots)) return low;
  const ExprId high = parseExpression(in);
  return addOperation(in, nodeOf(ExprKind::range), {low, high}, begin);
}

std::vector<ArgNode> parseArguments(ParseContext& in, std::string_view callee) {
  constexpr size_t kMaxArguments = 80;
  TokenStream& tokens = in.tokens;
  std::vector<ArgNode> args;
  if (!tokens.expect(Tok::open_paren, "`(`")) return args;
  while (!tokens.at(Tok::close_paren) && !tokens.hasFailed()) {
    const Span begin = tokens.here();
    ArgNode arg;
    if (isNamedArgumentAhead(tokens, callee)) {
      arg.name = parseName(in, "a name");
      tokens.accept(Tok::assign);
    }
    arg.value = parseExpression(in);
    arg.span = tokens.since(begin);
    args.push_back(arg);
    if (args.size() > kMaxArguments)
      tokens.fail(begin, codes::kTooLarge, "the call has more than 80 arguments", "split them among several shapes");
    if (!tokens.accept(Tok::comma)) break;
  }
  tokens.expect(Tok::close_paren, "`)` or `,`");
  return args;
}

IdRange addArguments(ParseContext& in, std::string_view callee) {
  return in.build.addRange(&Ast::args, parseArguments(in, callee));
}

ExprId parseShapeCall(ParseContext& in, std::string_view what) {
  TokenStream& tokens = in.tokens;
  const Span begin = tokens.here();
  if (!tokens.at(Tok::word) || tokens.peek().keyword) {
    tokens.failExpecting(what);
    return kNoId;
  }
  const ExprId callee = parsePostfix(in);
  if (tokens.hasFailed() || callee == kNoId) return kNoId;
  ExprNode node = in.build.expr(callee);
  if (node.kind == ExprKind::call) {
    in.build.expr(callee).shape = true;
    return callee;
  }
  node.kind = ExprKind::call;
  node.shape = true;
  return in.build.addExpr(node, begin);
}

}  // namespace sgm::parse
