#pragma once
// Parses expressions, calls and their arguments.

#include <string_view>
#include <vector>

#include "grammar/parse/parse_context.h"

namespace sgm::parse {

ExprId parseExpression(ParseContext& in);
/// Parses an expression, or the range `low..high`.
ExprId parseRangeOrExpression(ParseContext& in);
/// Parses Rule, Rule(...) or module.Rule(...); creates a call node even without parentheses. what: the name of the
/// expected construct in messages.
ExprId parseShapeCall(ParseContext& in, std::string_view what);
/// Parses the arguments of a call in parentheses. callee: the word before the parentheses.
std::vector<ArgNode> parseArguments(ParseContext& in, std::string_view callee);
/// Like parseArguments(), but adds the arguments to Ast::args and returns their range.
IdRange addArguments(ParseContext& in, std::string_view callee);

}  // namespace sgm::parse
