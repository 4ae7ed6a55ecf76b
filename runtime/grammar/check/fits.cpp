// Checks the statement fit, which places an asset in a scope.

#include "grammar/check/leaf_statements.h"
#include "grammar/text/codes.h"

namespace sgm {

void checkFit(CheckContext& check, Symbols& symbols, Types& types, const StmtNode& s) {
  FitNode& fit = check.program.ast.fits[s.extra];
  for (uint32_t i = 0; i < fit.zones.count; ++i) {
    const FitZoneNode& zone = check.program.ast.fit_zones[fit.zones.first + i];
    types.require(zone.from, ValueKind::number, kLength, "the beginning of a zone");
    types.require(zone.to, ValueKind::number, kLength, "the end of a zone");
  }
  const uint32_t module = types.scope().module;
  const Symbol* const found = symbols.find(module, s.name);
  if (found != nullptr && found->asset) {
    fit.asset = found->id;
    return;
  }
  if (found == nullptr ? symbols.mayBeLost(module, s.name)
                       : found->import && found->id == kNoId && symbols.mayBeLost(kNoId, s.name))
    return;
  if (found != nullptr) {
    check.sink.error(fit.name_span, codes::kWrongUse, join({"`", check.text(s.name), "` is not an asset"}),
                     "`fit` takes an asset that is imported from a .glb file, such as `import \"bay.glb\" as bay;`");
    return;
  }
  Suggestion suggestion(check.text(s.name));
  for (const auto& [name, symbol] : symbols.of(module))
    if (symbol.asset) suggestion.offer(check.text(name));
  check.sink.error(
      fit.name_span, codes::kUnknownName, join({"there is no asset `", check.text(s.name), "`"}),
      suggestion.hintOr(join({"import it: `import \"", check.text(s.name), ".glb\" as ", check.text(s.name), ";`"})));
}

}  // namespace sgm
