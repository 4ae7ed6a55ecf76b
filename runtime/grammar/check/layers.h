#pragma once
// Layers: their cells, their order, and the layers that they use.

#include "grammar/check/rule_uses.h"
#include "grammar/check/types.h"

namespace sgm {

/// Adds the layers to the program, each after those that it uses. Symbols::areLayersKnown() tells whether that
/// succeeded. Precondition: checkDomain() has run.
void checkLayers(CheckContext& check, Symbols& symbols, Types& types);

/// Requires that a rule that probes or queries a layer is derived only in layers that use it. Precondition: Rule::calls
/// is complete.
void checkAskedLayers(CheckContext& check, const RuleUses& uses);

}  // namespace sgm
