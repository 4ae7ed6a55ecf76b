// Parses the statement fit, which places an asset in a scope.

#include "grammar/parse/parse_expressions.h"
#include "grammar/parse/parse_parts.h"
#include "grammar/parse/parse_statements.h"

namespace sgm::parse {

StmtId parseFit(ParseContext& in) {
  TokenStream& tokens = in.tokens;
  StmtScope stmt(in, StmtKind::fit);
  FitNode fit;
  fit.name_span = tokens.here();
  stmt->name = parseNewName(in, "the name of an imported asset");
  std::vector<FitZoneNode> zones;
  while (tokens.atWord("stretch") || tokens.atWord("repeat")) {
    FitZoneNode zone;
    const Span begin = tokens.here();
    zone.repeats = tokens.textOf(tokens.take()) == "repeat";
    const std::optional<uint32_t> axis =
        parseAxis(tokens, zone.repeats ? "x, y or z to repeat along" : "x, y or z to stretch along");
    if (!axis) return kNoId;
    zone.axis = static_cast<uint8_t>(*axis);
    zone.from = parseExpression(in);
    tokens.expect(Tok::dots, "`..` and where the zone ends, such as `stretch x 1m..2m`");
    zone.to = parseExpression(in);
    zone.span = tokens.since(begin);
    zones.push_back(zone);
  }
  tokens.expect(Tok::semicolon, "`stretch`, `repeat` or `;`");
  if (tokens.hasFailed()) return kNoId;
  fit.zones = in.build.addRange(&Ast::fit_zones, zones);
  return stmt.finish(&Ast::fits, fit);
}

}  // namespace sgm::parse
