#pragma once
// Detects unbounded recursion of rules.

#include <vector>

#include "grammar/check/rule_uses.h"
#include "grammar/syntax/program.h"
#include "grammar/text/limits.h"
#include "grammar/text/sink.h"

namespace sgm {

/// Reports an error for every rule that may call itself without end. Sets ExprNode::circular of calls that may lead
/// back to their own rule.
void checkRecursion(Program& program, const std::vector<RuleCall>& calls, const CompileLimits& limits,
                    DiagnosticSink& sink);

}  // namespace sgm
