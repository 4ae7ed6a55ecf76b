#pragma once
// The rules and layers that bodies use: what the check of statements finds out for later passes.

#include <string_view>
#include <vector>

#include "grammar/syntax/ast.h"

namespace sgm {

/// A scale around a call; `copied`: applied once for each copy.
struct ScaleAround {
  ExprId factor = kNoId;
  bool copied = false;
};

/// A call of a rule by a rule, for the checks of recursion, layers and reach.
struct RuleCall {
  uint32_t from = kNoId;  ///< kNoId: the block of an override
  uint32_t alternative = 0;
  uint32_t to = 0;
  ExprId call = kNoId;
  bool escape = false;  ///< for depth or minsize
  bool shrunk = false;  ///< inside of size
  std::vector<ScaleAround> scales;
};

/// A probe or a query.
struct AskedLayer {
  uint32_t rule = kNoId;  ///< kNoId: the block of an override
  uint32_t layer = 0;
  Span span;
  std::string_view verb;  ///< the action of the rule on the layer: `probes`
};

/// The rules that bodies call and the layers that they ask, in the order of the check.
struct RuleUses {
  std::vector<RuleCall> calls;
  std::vector<AskedLayer> asked;
};

}  // namespace sgm
