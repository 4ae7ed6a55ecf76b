#include "grammar/check/layers.h"

#include <algorithm>
#include <cmath>

#include "grammar/check/declared_constants.h"
#include "grammar/text/codes.h"

namespace sgm {

namespace {

constexpr size_t kMaxLayers = 256;

/// Sorts the layers so that each layer comes after the layers that it uses.
void sortLayers(CheckContext& check, Symbols& symbols) {
  const uint32_t before = check.sink.errorCount();
  const std::vector<LayerDecl>& decls = check.syntax[0].layers;
  const size_t count = decls.size();
  std::vector<std::vector<uint32_t>> uses(count);
  for (size_t l = 0; l < count; ++l)
    for (const NamedPlace& use : decls[l].uses) {
      Suggestion suggestion(check.text(use.name));
      uint32_t found = kNoId;
      for (uint32_t other = 0; other < count; ++other) {
        suggestion.offer(check.text(decls[other].name));
        if (decls[other].name == use.name) found = other;
      }
      if (found == kNoId && symbols.mayBeLost(0, use.name))
        continue;
      else if (found == kNoId)
        check.sink.error(use.span, codes::kUnknownName, join({"unknown layer `", check.text(use.name), "`"}),
                         suggestion.hintOr("name a layer of this file"));
      else if (found == l)
        check.sink.error(use.span, codes::kLayerCycle, join({"layer `", check.text(use.name), "` uses itself"}),
                         "a layer reads lower layers only");
      else if (std::find(uses[l].begin(), uses[l].end(), found) == uses[l].end())
        uses[l].push_back(found);
    }
  if (check.sink.errorCount() > before) return;
  // Repeatedly takes the first layer for which all layers that it uses are already taken. This keeps the order of
  // declaration where possible.
  std::vector<uint32_t> order, place(count, kNoId);
  while (order.size() < count) {
    uint32_t next = kNoId;
    for (uint32_t l = 0; l < count && next == kNoId; ++l)
      if (place[l] == kNoId &&
          std::all_of(uses[l].begin(), uses[l].end(), [&](uint32_t u) { return place[u] != kNoId; }))
        next = l;
    if (next == kNoId) {
      for (uint32_t l = 0; l < count && next == kNoId; ++l)
        if (place[l] == kNoId) next = l;
      for (const NamedPlace& use : decls[next].uses)
        for (uint32_t u : uses[next])
          if (decls[u].name == use.name && place[u] == kNoId) {
            check.sink.error(use.span, codes::kLayerCycle,
                             join({"layers `", check.text(decls[next].name), "` and `", check.text(use.name),
                                   "` use each other in a circle"}),
                             "a layer reads lower layers only");
            return;
          }
      return;
    }
    place[next] = static_cast<uint32_t>(order.size());
    order.push_back(next);
  }
  std::pmr::vector<Layer> sorted(check.program.layers.get_allocator());
  for (uint32_t l : order) {
    for (uint32_t u : uses[l]) check.program.layers[l].uses.push_back(place[u]);
    std::sort(check.program.layers[l].uses.begin(), check.program.layers[l].uses.end());
    sorted.push_back(std::move(check.program.layers[l]));
  }
  check.program.layers = std::move(sorted);
  symbols.setLayersKnown();
}

void addLayer(CheckContext& check, Types& types, const LayerDecl& l) {
  constexpr int64_t kLargest = int64_t{1} << 30;
  Layer layer(check.program.layers.get_allocator().resource());
  layer.name = l.name;
  layer.start = l.start;
  layer.span = l.span;
  layer.cell_expr = l.cell;
  layer.reach_expr = l.reach;
  const auto cell = checkWholeUnits(check, types, l.cell, "the cell of a layer"),
             reach = checkWholeUnits(check, types, l.reach, "the reach of a layer");
  if (cell && (*cell < 1 || *cell > kLargest))
    check.sink.error(check.node(l.cell).span, codes::kValueRange, "a cell is from one unit to 1048 km long",
                     "such as cell 32m");
  else if (reach && (*reach < 0 || *reach > kLargest))
    check.sink.error(check.node(l.reach).span, codes::kValueRange, "a reach is from 0 to 1048 km long",
                     "such as reach 8m");
  else if (cell && reach) {
    // Every chunk loads all cells within the layer's reach, so the cost of a sample grows with the cube of reach /
    // cell.
    if (*reach > *cell * check.limits.neighbours)
      check.sink.error(
          check.node(l.reach).span, codes::kReachTooLarge,
          join({"the reach is more than ", std::to_string(check.limits.neighbours), " cells"}),
          join({"make the cell at least ",
                metresText(static_cast<double>(*reach) / kUnitsPerMetre / check.limits.neighbours), " long"}));
    layer.reach = static_cast<int32_t>(*reach);
    for (int axis = 0; axis < 3; ++axis)
      layer.cell[axis] = check.program.domain.axes[static_cast<size_t>(axis)] ? static_cast<int32_t>(*cell) : 0;
  }
  if (l.detail != kNoId) {
    // Unlike a cell's edge, a detail need not be a whole number of units; it is rounded.
    std::optional<double> detail = checkConstant(check, types, l.detail, kLength, "the detail of a layer");
    if (detail) detail = std::floor(*detail * kUnitsPerMetre + 0.5);
    if (detail && (*detail < 1 || *detail > kLargest))
      check.sink.error(check.node(l.detail).span, codes::kValueRange, "a detail is from one unit to 1048 km long",
                       "such as detail 4m");
    else if (detail)
      layer.coarsest_cell = static_cast<int32_t>(*detail);
  }
  for (const Layer& other : check.program.layers)
    if (other.name == layer.name)
      check.sink.error(l.span, codes::kDuplicate, join({"layer `", check.text(layer.name), "` is declared twice"}),
                       "give it another name");
  check.program.layers.push_back(std::move(layer));
}

}  // namespace

void checkLayers(CheckContext& check, Symbols& symbols, Types& types) {
  const uint32_t before = check.sink.errorCount();
  const ModuleSyntax& root = check.syntax[0];
  const DomainDecl& decl = root.domain;
  Domain& domain = check.program.domain;
  if (root.start == kNoId && root.layers.empty()) {
    Span span;
    span.line = span.column = span.end_line = span.end_column = 1;
    const bool derives = std::any_of(root.items.begin(), root.items.end(), [](const Item& item) {
      return item.kind == ItemKind::alternative || item.kind == ItemKind::domain;
    });
    if (derives && !check.library && !check.lossy)
      check.sink.error(span, codes::kNoStart, "nothing says where derivation starts", "add `start Rule;` or a layer");
    return;
  }
  if (root.start != kNoId && !root.layers.empty())
    check.sink.error(root.start_span, codes::kNoStart, "a grammar starts at the top or in its layers, not both",
                     "remove this start, or the layers");
  if (root.start != kNoId && decl.infinite)
    check.sink.error(root.start_span, codes::kDomain, "an infinite domain is derived by layers",
                     "add `layer name cell 100m reach 50m { start Rule; }`");
  if (!root.layers.empty() && !decl.infinite && !decl.box && !check.lossy)
    check.sink.error(root.layers[0].span, codes::kDomain, "layers need an infinite domain or one with a box",
                     "write `domain infinite;` or `domain finite box(...)`");
  if (root.layers.size() > kMaxLayers)
    check.sink.error(root.layers[kMaxLayers].span, codes::kTooLarge,
                     join({"the program has more than ", std::to_string(kMaxLayers), " layers"}),
                     "put rules of several layers into one");
  if (check.sink.errorCount() > before) return;
  if (root.start != kNoId) {
    Layer main(check.program.layers.get_allocator().resource());
    main.name = check.names.intern("main");
    main.start = root.start;
    main.span = root.start_span;
    if (!domain.box.empty())
      for (int axis = 0; axis < 3; ++axis) main.cell[axis] = domain.box.hi[axis] - domain.box.lo[axis];
    check.program.layers.push_back(std::move(main));
    symbols.setLayersKnown();
    return;
  }
  for (const LayerDecl& layer : root.layers) addLayer(check, types, layer);
  sortLayers(check, symbols);
}

void checkAskedLayers(CheckContext& check, const RuleUses& uses) {
  if (uses.asked.empty()) return;
  for (const Layer& layer : check.program.layers) {
    if (check.node(layer.start).ref != Ref::rule) continue;
    std::vector<bool> reached(check.program.rules.size(), false);
    std::vector<uint32_t> stack{check.node(layer.start).id};
    while (!stack.empty()) {
      const uint32_t rule = stack.back();
      stack.pop_back();
      if (reached[rule]) continue;
      reached[rule] = true;
      stack.insert(stack.end(), check.program.rules[rule].calls.begin(), check.program.rules[rule].calls.end());
    }
    for (const AskedLayer& asked : uses.asked) {
      if (!reached[asked.rule]) continue;
      if (std::find(layer.uses.begin(), layer.uses.end(), asked.layer) != layer.uses.end()) continue;
      const NameId name = check.program.layers[asked.layer].name;
      if (name == layer.name)
        check.sink.error(asked.span, codes::kLayerUses,
                         join({"layer `", check.text(layer.name), "` ", asked.verb, " itself"}),
                         "a layer reads lower layers only: derive what it asks about in a layer of its own");
      else
        check.sink.error(asked.span, codes::kLayerUses,
                         join({"layer `", check.text(layer.name), "` ", asked.verb, " `", check.text(name),
                               "` and does not use it"}),
                         join({"write `uses ", check.text(name), "` in its head"}));
    }
  }
}

}  // namespace sgm
