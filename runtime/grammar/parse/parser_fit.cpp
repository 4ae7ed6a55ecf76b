// Assets in scopes: fit.

#include "grammar/parse/parser.h"

namespace sgm {

StmtId Parser::fitStatement() {
  const Span begin = here();
  take();
  StmtNode node;
  node.kind = StmtKind::fit;
  FitNode fit;
  fit.name_span = here();
  node.name = declaredName("the name of an imported asset");
  std::vector<FitZoneNode> zones;
  while (!panic_ && (atWord("stretch") || atWord("repeat"))) {
    FitZoneNode zone;
    const Span zone_begin = here();
    zone.repeats = textOf(take()) == "repeat";
    const std::optional<uint32_t> axis =
        axisLetter(zone.repeats ? "x, y or z to repeat along" : "x, y or z to stretch along");
    if (!axis) return kNoId;
    zone.axis = static_cast<uint8_t>(*axis);
    zone.from = expression();
    if (!panic_) expect(Tok::dots, "`..` and where the zone ends, such as `stretch x 1m..2m`");
    if (!panic_) zone.to = expression();
    zone.span = since(zone_begin);
    zones.push_back(zone);
  }
  if (!panic_) expect(Tok::semicolon, "`stretch`, `repeat` or `;`");
  if (panic_) return kNoId;
  fit.zones = {static_cast<uint32_t>(program_.ast.fit_zones.size()), static_cast<uint32_t>(zones.size())};
  program_.ast.fit_zones.insert(program_.ast.fit_zones.end(), zones.begin(), zones.end());
  program_.ast.fits.push_back(fit);
  node.extra = static_cast<uint32_t>(program_.ast.fits.size() - 1);
  return addStmt(node, begin);
}

}  // namespace sgm
