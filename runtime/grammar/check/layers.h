#pragma once
// Checks layers: the edges of their cells, their order, and the layers that they use.

#include "grammar/check/rule_uses.h"
#include "grammar/check/types.h"

namespace sgm {

/// Adds the layers to the program, each after the layers that it uses. Sets Symbols::areLayersKnown() on success.
/// Precondition: checkDomain() has run.
void checkLayers(CheckContext& check, Symbols& symbols, Types& types);

/// Reports an error if the derivation of a layer reaches a probe or a query of a layer that its `uses` does not name,
/// such as the layer itself. Precondition: Rule::calls is complete.
void checkAskedLayers(CheckContext& check, const RuleUses& uses);

}  // namespace sgm
