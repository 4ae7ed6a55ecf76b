// Assets in scopes: fit.

#include "grammar/check/check.h"
#include "grammar/text/codes.h"

namespace sgm {

void Checker::assetMaterials() {
  for (Asset& asset : program_.assets)
    for (const std::pmr::string& name : asset.material_names)
      asset.materials.push_back(name.empty() ? uint16_t{0} : tableIndex(program_.materials, names_.intern(name), {}));
}

void Checker::assetMisused(const Span& span, NameId name) {
  sink_.error(span, codes::kWrongUse, join({"`", text(name), "` is an asset"}),
              join({"put it into a scope: `fit ", text(name), ";`"}));
}

void Checker::fit(const StmtNode& s) {
  FitNode& fit = program_.ast.fits[s.extra];
  for (uint32_t i = 0; i < fit.zones.count; ++i) {
    const FitZoneNode& zone = program_.ast.fit_zones[fit.zones.first + i];
    demand(zone.from, ValueKind::number, kLength, "the beginning of a zone");
    demand(zone.to, ValueKind::number, kLength, "the end of a zone");
  }
  const auto& table = symbols_[scope_.module];
  const auto found = table.find(s.name);
  if (found != table.end() && found->second.asset) {
    fit.asset = found->second.id;
    return;
  }
  if (found == table.end() ? mayBeLost(scope_.module, s.name)
                           : found->second.import && found->second.id == kNoId && mayBeLost(kNoId, s.name))
    return;
  if (found != table.end()) {
    sink_.error(fit.name_span, codes::kWrongUse, join({"`", text(s.name), "` is not an asset"}),
                "`fit` takes an asset that is imported from a .glb file, such as `import \"bay.glb\" as bay;`");
    return;
  }
  Suggestion suggestion(text(s.name));
  for (const auto& [name, symbol] : table)
    if (symbol.asset) suggestion.offer(text(name));
  sink_.error(fit.name_span, codes::kUnknownName, join({"there is no asset `", text(s.name), "`"}),
              suggestion.hintOr(join({"import it: `import \"", text(s.name), ".glb\" as ", text(s.name), ";`"})));
}

}  // namespace sgm
