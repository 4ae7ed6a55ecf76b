#pragma once
// Parses statements. Each function parses one kind of statement completely and adds it to the tree; returns kNoId after
// an error.

#include <string_view>

#include "grammar/parse/parse_context.h"

namespace sgm::parse {

// Defined in parse_statements.cpp:

/// Parses any statement, chosen by its first token.
StmtId parseStatement(ParseContext& in);
/// Parses statements in braces.
StmtId parseBlock(ParseContext& in);
/// Parses a block or a single statement, as the body of the statement that is called `word` in messages.
StmtId parseBody(ParseContext& in, std::string_view word);
/// Parses a block, or a call without ';'.
StmtId parseMorphOperand(ParseContext& in);
/// Parses [ lerp | power ] of a morph; returns whether it is `power`.
bool parseMorphPower(TokenStream& tokens);

StmtId parseCall(ParseContext& in);
StmtId parseUnion(ParseContext& in);
StmtId parseCut(ParseContext& in);
StmtId parseMeet(ParseContext& in);
StmtId parseSum(ParseContext& in);
StmtId parseMorph(ParseContext& in);
StmtId parseLet(ParseContext& in);
StmtId parseField(ParseContext& in);
StmtId parseMaterial(ParseContext& in);
StmtId parseTag(ParseContext& in);
StmtId parseAnchor(ParseContext& in);
StmtId parseDetail(ParseContext& in);

// Defined in parse_transforms.cpp:

/// Whether the current token starts a transform.
bool isAtTransform(const TokenStream& tokens);
StmtId parseTransform(ParseContext& in);
StmtId parseRepeat(ParseContext& in);
StmtId parseFor(ParseContext& in);
StmtId parseScatter(ParseContext& in);
StmtId parseDisplace(ParseContext& in);
StmtId parseWarp(ParseContext& in);

// Defined in parse_split.cpp, parse_treemap.cpp and parse_wfc.cpp:

StmtId parseSplit(ParseContext& in);
StmtId parseSnap(ParseContext& in);
StmtId parseComp(ParseContext& in);
StmtId parseTreemap(ParseContext& in);
/// Parses the `link` statement of a `treemap`: a link between two rooms.
StmtId parseLink(ParseContext& in);
StmtId parseWfc(ParseContext& in);
/// Parses the `border` statement of a `wfc`.
StmtId parseBorder(ParseContext& in);

// Defined in parse_profiles.cpp, parse_fit.cpp and parse_overrides.cpp:

StmtId parseFootprint(ParseContext& in);
StmtId parseExtrude(ParseContext& in);
StmtId parseRoof(ParseContext& in);
StmtId parseFit(ParseContext& in);
StmtId parseInner(ParseContext& in);

}  // namespace sgm::parse
