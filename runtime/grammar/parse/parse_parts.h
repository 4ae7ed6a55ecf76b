#pragma once
// Parses the parts of a split, a comp, a treemap or a wfc: `part: statement` within braces.

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "grammar/parse/stmt_scope.h"

namespace sgm::parse {

/// The parts parsed so far: bodies[i] is the statement of the part nodes[i].
struct Parts {
  std::vector<PartNode> nodes;
  std::vector<StmtId> bodies;
};

/// Appends a part whose span reaches from `begin` to the last token taken. Does nothing if an error left the part
/// without a statement.
void addPart(ParseContext& in, Parts& parts, PartNode part, StmtId body, const Span& begin);
/// Parses the '}' behind the parts. If it is missing, reports an error at `begin` and returns false.
bool parsePartsEnd(ParseContext& in, const Span& begin);
/// Adds the parts to the tree, and finishes the statement that contains them.
StmtId finishParts(ParseContext& in, StmtScope& stmt, const Parts& parts);

/// Parses an axis letter and returns 0, 1 or 2 for x, y or z; nullopt after an error, whose message calls the letter
/// `what`.
std::optional<uint32_t> parseAxis(TokenStream& tokens, std::string_view what);

}  // namespace sgm::parse
