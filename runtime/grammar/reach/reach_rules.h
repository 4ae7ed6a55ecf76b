#pragma once
// Computes the extents of calls, of rules and of their alternatives.

#include <cstdint>
#include <vector>

#include "grammar/range/extent.h"
#include "grammar/reach/reach_context.h"

namespace sgm::reach {

/// Where a call is written: as a layer's start, in a rule's head as the replacement at its depth or minsize limit, or
/// in a statement.
enum class CallSite : uint8_t { start, instead, statement };

/// Returns the extent of a call of a rule or primitive, in the caller's scope; an empty extent for kNoId.
Extent boundCall(ExprId id, CallSite site, const RangeFrame& frame, ReachContext& context);

/// Returns the extent of a rule, ignoring overrides: of all alternatives that may be chosen for these arguments.
Extent boundAlternatives(uint32_t rule, const std::vector<RangeValue>& args, const RangeFrame& caller,
                         ReachContext& context);

}  // namespace sgm::reach
