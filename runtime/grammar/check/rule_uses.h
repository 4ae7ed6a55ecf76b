#pragma once
// The rules and layers that bodies use, collected by the check of statements for later passes.

#include <string_view>
#include <vector>

#include "grammar/syntax/ast.h"

namespace sgm {

/// A `scale` transform that encloses a call.
struct ScaleAround {
  ExprId factor = kNoId;  ///< the expression for the factor of the `scale` transform
  bool copied = false;    ///< in a `repeat`: the factor applies once more for each further copy
};

/// A call of a rule, for the checks of recursion, layers and reach.
struct RuleCall {
  uint32_t from = kNoId;  ///< the rule whose body contains the call; kNoId: the block of an override
  uint32_t alternative = 0;
  uint32_t to = 0;
  ExprId call = kNoId;
  /// true for a call after `->`: it replaces the rule's body once the rule's `depth` or `minsize` is reached
  bool escape = false;
  bool shrunk = false;  ///< true if a `size`, a split or another division around the call has made the scope smaller
  std::vector<ScaleAround> scales;  ///< the `scale` transforms around the call, outermost first
};

/// A probe or a query of a layer.
struct AskedLayer {
  uint32_t rule = kNoId;  ///< the rule that contains the probe or query; kNoId: the block of an override
  uint32_t layer = 0;
  Span span;
  std::string_view verb;  ///< for messages: "probes" or another verb for what the rule does with the layer
};

/// The calls, probes and queries in all bodies, in the order in which the bodies were checked.
struct RuleUses {
  std::vector<RuleCall> calls;
  std::vector<AskedLayer> asked;
};

}  // namespace sgm
