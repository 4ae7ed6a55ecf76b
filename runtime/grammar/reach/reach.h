#pragma once
// The proof of reach: an abstract interpretation of each layer's rules over intervals. Rules are evaluated once for
// each tuple of argument ranges, with cached results, so that recursion costs its depth, not its number of leaves.

#include "grammar/syntax/program.h"
#include "grammar/text/limits.h"
#include "grammar/text/sink.h"

namespace sgm {

/// Proves how far each layer's shapes may extend from their cell. Sets Layer::bound, and a finite domain's box if it is
/// not written; reports layers for which the proof fails. limits.bound_steps is the limit of steps for each attempt.
/// Precondition: names are resolved (check/check.h), and the program has no errors.
void checkReach(Program& program, const CompileLimits& limits, DiagnosticSink& sink);

}  // namespace sgm
