#pragma once
// Expressions, calls and arguments.

#include <string_view>
#include <vector>

#include "grammar/parse/parse_context.h"

namespace sgm::parse {

ExprId parseExpression(ParseContext& in);
/// An expression, or the range `low..high`.
ExprId parseRangeOrExpression(ParseContext& in);
/// Rule, rule(...) or module.Rule(...): always a call, with or without arguments. Messages call it
/// `what`.
ExprId parseShapeCall(ParseContext& in, std::string_view what);
/// The arguments of a call in parentheses; callee: the word before them.
std::vector<ArgNode> parseArguments(ParseContext& in, std::string_view callee);
/// The same, added to the tree.
IdRange addArguments(ParseContext& in, std::string_view callee);

}  // namespace sgm::parse
