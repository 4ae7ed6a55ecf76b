// Checks the statements that only a root file may have, outside of its rules and layers.

#include <cmath>

#include "base/hash.h"
#include "grammar/check/arguments.h"
#include "grammar/check/declared_constants.h"
#include "grammar/text/codes.h"

namespace sgm {

namespace {

constexpr int64_t kWidestEdge = int64_t{16} * 1000 * kUnitsPerMetre;

}  // namespace

void numberAssetMaterials(CheckContext& check) {
  for (Asset& asset : check.program.assets)
    for (const std::pmr::string& name : asset.material_names)
      asset.materials.push_back(name.empty() ? uint16_t{0}
                                             : check.tableIndex(check.program.materials, check.names.intern(name), {}));
}

void checkSeed(CheckContext& check, Types& types) {
  const ModuleSyntax& root = check.syntax[0];
  if (root.seed != kNoId) {
    const ExprNode& seed = check.node(root.seed);
    if (seed.kind == ExprKind::text) {
      check.program.seed = hashText(check.text(seed.name));
    } else if (const auto value = checkConstant(check, types, root.seed, kRatio, "a seed")) {
      if (*value < 0 || *value != std::floor(*value) || *value > 1e9)
        check.sink.error(seed.span, codes::kValueRange, "a seed is a whole number (0 or more) or a text",
                         "such as seed 7 or seed \"block-17\"");
      else
        check.program.seed = static_cast<uint64_t>(*value);
    }
  }
}

void checkDomain(CheckContext& check, Types& types) {
  const ModuleSyntax& root = check.syntax[0];
  check.program.unit = root.unit;
  const DomainDecl& decl = root.domain;
  Domain& domain = check.program.domain;
  domain.written = decl.present;
  domain.infinite = decl.infinite;
  domain.axes = decl.axes;
  domain.solid = decl.solid;
  domain.density = decl.density;
  if (decl.density_edge != kNoId) {
    const auto edge = checkWholeUnits(check, types, decl.density_edge, "the edge of a density");
    if (edge && (*edge < 1 || *edge > kWidestEdge))
      check.sink.error(check.node(decl.density_edge).span, codes::kValueRange,
                       "the edge of a density is from one unit to 16 km wide", "such as edge 20m");
    else if (edge)
      domain.density_edge = static_cast<int32_t>(*edge);
  }
  domain.span = decl.span;
  if (decl.material != kNoId) domain.material = check.tableIndex(check.program.materials, decl.material, decl.span);
  if (!decl.box) return;
  ExprId edges[3] = {kNoId, kNoId, kNoId};
  const size_t required = decl.box_args.count == 1 ? 1 : 3;
  if (!bindWords(check, decl.box_args, decl.span, "box", {"x", "y", "z"}, required, edges)) return;
  for (int axis = 0; axis < 3; ++axis) {
    const ExprId edge = edges[required == 1 ? 0 : axis];
    const auto units = checkWholeUnits(check, types, edge, "an edge of the domain");
    if (!units) return;
    if (*units < 2 || *units > (int64_t{1} << 31) - 4096) {
      check.sink.error(check.node(edge).span, codes::kValueRange,
                       "an edge of the domain is from 2 units to 2097 km long", "such as box(200m)");
      return;
    }
    domain.box.lo[axis] = static_cast<int32_t>(-*units / 2);
    domain.box.hi[axis] = static_cast<int32_t>(domain.box.lo[axis] + *units);
  }
}

void checkExpectations(CheckContext& check, Symbols& symbols, Types& types) {
  for (Expectation& e : check.program.expectations) {
    const Dim dim = e.measure == Measure::volume ? kVolume : e.measure == Measure::area ? kArea : kRatio;
    const bool counts = e.measure != Measure::watertight;
    if (!counts && (e.compared || e.low != kNoId))
      check.sink.error(e.span, codes::kWrongUse, "`watertight` holds or not; it is not compared",
                       "write `watertight;` alone");
    if (counts && e.expect && !e.compared && e.low == kNoId)
      check.sink.error(e.span, codes::kSyntax, "an `expect` of a number needs something to compare with",
                       "such as == 1 or in 1..10");
    if (e.of != kNoId && e.measure != Measure::components)
      check.sink.error(e.span, codes::kWrongUse, "only `components` takes `air` or `solid`",
                       "leave the parentheses out");
    if (const auto above =
            e.above == kNoId ? std::nullopt : checkConstant(check, types, e.above, kVolume, "the size of a piece")) {
      e.above_number = *above;
      if (*above < 0)
        check.sink.error(check.node(e.above).span, codes::kValueRange, "the size of a piece is 0m3 or more",
                         "such as components(solid above 2m3)");
    }
    if (const auto value =
            e.value == kNoId ? std::nullopt : checkConstant(check, types, e.value, dim, "the value to compare with"))
      e.value_number = *value;
    if (const auto low =
            e.low == kNoId ? std::nullopt : checkConstant(check, types, e.low, dim, "the low end of a range"))
      e.low_number = *low;
    if (const auto high =
            e.high == kNoId ? std::nullopt : checkConstant(check, types, e.high, dim, "the high end of a range"))
      e.high_number = *high;
    if (e.per_name == kNoId) continue;
    const Symbol* const found = symbols.find(0, e.per_name);
    if (found == nullptr && symbols.mayBeLost(0, e.per_name)) continue;
    if (found == nullptr || found->ref != Ref::rule) {
      Suggestion suggestion(check.text(e.per_name));
      for (const Rule& rule : check.program.rules) suggestion.offer(check.text(rule.name));
      check.sink.error(e.span, codes::kUnknownName, join({"unknown rule `", check.text(e.per_name), "`"}),
                       suggestion.hintOr("name a rule of this file"));
    } else {
      e.per = found->id;
    }
  }
}

}  // namespace sgm
