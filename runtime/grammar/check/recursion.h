#pragma once
// Rules that may call themselves without end.

#include <vector>

#include "grammar/check/rule_uses.h"
#include "grammar/syntax/program.h"
#include "grammar/text/limits.h"
#include "grammar/text/sink.h"

namespace sgm {

/// Reports an error for every rule that may call itself without end. Sets ExprNode::circular.
void checkRecursion(Program& program, const std::vector<RuleCall>& calls, const CompileLimits& limits,
                    DiagnosticSink& sink);

}  // namespace sgm
