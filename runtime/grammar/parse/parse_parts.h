#pragma once
// The parts of a split, a comp, a treemap or a wfc: `part: statement` within braces.

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "grammar/parse/stmt_scope.h"

namespace sgm::parse {

/// Parts so far, and the statement of each.
struct Parts {
  std::vector<PartNode> nodes;
  std::vector<StmtId> bodies;
};

/// Adds a part that begins at `begin` and ends with the token that was taken last, unless an error has left it without
/// its statement.
void addPart(ParseContext& in, Parts& parts, PartNode part, StmtId body, const Span& begin);
/// Parses the brace behind parts; returns false, after an error at `begin`, if there is none.
bool parsePartsEnd(ParseContext& in, const Span& begin);
/// Adds the parts to the tree, and ends their statement.
StmtId finishParts(ParseContext& in, StmtScope& stmt, const Parts& parts);

/// 0 1 2 for x y z; nullopt after an error, whose message calls the letter `what`.
std::optional<uint32_t> parseAxis(TokenStream& tokens, std::string_view what);

}  // namespace sgm::parse
