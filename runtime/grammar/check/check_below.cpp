// Queries of the layers below: probes and queries.

#include <algorithm>

#include "grammar/check/check.h"
#include "grammar/text/codes.h"

namespace sgm {

uint32_t Checker::layerBelow(NameId name, const Span& span, std::string_view verb) {
  Suggestion suggestion(text(name));
  uint32_t found = kNoId;
  for (uint32_t l = 0; l < program_.layers.size(); ++l) {
    if (program_.layers[l].name == name) found = l;
    suggestion.offer(text(program_.layers[l].name));
  }
  if (found == kNoId && layers_known_ && !mayBeLost(0, name)) {
    const std::string hint = suggestion.hint();
    sink_.error(span, codes::kUnknownName, join({"unknown layer `", text(name), "`"}),
                hint.empty() ? "name a layer of this file" : hint);
  }
  if (found == kNoId) return found;
  if (override_ == kNoId)
    asked_.push_back({rule_, found, span, verb});
  else
    override_asked_[override_].push_back({0, found, span, verb});
  return found;
}

Type Checker::query(ExprId id) {
  const ExprNode n = node(id);
  const Type answer{ValueKind::boolean, kRatio, false, false};
  if (n.children.count > 0) {
    const ExprId radius = child(n, 0);
    demand(radius, ValueKind::number, kLength, "the radius of a query");
    if (const auto metres = fold(radius, 0); metres && *metres < 0)
      sink_.error(node(radius).span, codes::kValueRange, "the radius of a query is 0m or more",
                  "such as `query clear 2m of`");
  }
  if (scope_.field) {
    sink_.error(n.span, codes::kStage,
                "a query is answered once, when shapes are derived, and a field is evaluated at every point",
                "ask in the rule, `let open = query ...;`, and pass that to the field as an argument");
    return answer;
  }
  if (!scope_.rule) {
    sink_.error(n.span, codes::kWrongUse, "a query is known inside rules only: it asks about the scope's place",
                "ask in a rule, and pass the answer to a let as an argument");
    return answer;
  }
  const uint32_t layer = layerBelow(n.name, n.span, "queries");
  node(id).ref = Ref::layer;
  node(id).id = layer;
  return answer;
}

/// A rule that queries a layer may be derived only in layers that use it.
void Checker::layersAsked() {
  if (asked_.empty()) return;
  for (const Layer& layer : program_.layers) {
    if (node(layer.start).ref != Ref::rule) continue;
    std::vector<bool> reached(program_.rules.size(), false);
    std::vector<uint32_t> stack{node(layer.start).id};
    while (!stack.empty()) {
      const uint32_t rule = stack.back();
      stack.pop_back();
      if (reached[rule]) continue;
      reached[rule] = true;
      stack.insert(stack.end(), program_.rules[rule].calls.begin(), program_.rules[rule].calls.end());
    }
    for (const AskedLayer& asked : asked_) {
      if (!reached[asked.rule]) continue;
      if (std::find(layer.uses.begin(), layer.uses.end(), asked.layer) != layer.uses.end()) continue;
      const NameId name = program_.layers[asked.layer].name;
      if (name == layer.name)
        sink_.error(asked.span, codes::kLayerUses, join({"layer `", text(layer.name), "` ", asked.verb, " itself"}),
                    "a layer reads lower layers only: derive what it asks about in a layer of its own");
      else
        sink_.error(asked.span, codes::kLayerUses,
                    join({"layer `", text(layer.name), "` ", asked.verb, " `", text(name), "` and does not use it"}),
                    join({"write `uses ", text(name), "` in its head"}));
    }
  }
}

}  // namespace sgm
