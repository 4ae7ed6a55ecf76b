#pragma once
// The extents of calls, of rules and of their alternatives.

#include <cstdint>
#include <vector>

#include "grammar/range/extent.h"
#include "grammar/reach/reach_context.h"

namespace sgm::reach {

/// The author of a call: a layer, the head of a rule for its depth or minsize, or a statement.
enum class CallSite : uint8_t { start, instead, statement };

/// The extent of a call of a rule or primitive, in the caller's scope; nothing if the id is kNoId.
Extent boundCall(ExprId id, CallSite site, const RangeFrame& frame, ReachContext& context);

/// The extent of a rule without overrides: of all alternatives that may be chosen with these arguments.
Extent boundAlternatives(uint32_t rule, const std::vector<RangeValue>& args, const RangeFrame& caller,
                         ReachContext& context);

}  // namespace sgm::reach
