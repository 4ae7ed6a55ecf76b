#pragma once
// The proof of reach: bounds how far the shapes of each layer extend from their cell, by an abstract interpretation
// (Cousot and Cousot) of its rules over intervals. A rule is evaluated once for each tuple of argument ranges, with
// cached results, so that the cost of a recursion grows with its depth, not with its number of leaves.

#include "grammar/syntax/program.h"
#include "grammar/text/limits.h"
#include "grammar/text/sink.h"

namespace sgm {

/// Proves how far each layer's shapes may extend from their cell. Sets Layer::bound, and the box of a finite domain if
/// none is declared. Reports layers for which the proof fails. limits.bound_steps limits the steps of each attempt.
/// Precondition: names are resolved (check/check.h), and the program has no errors.
void checkReach(Program& program, const CompileLimits& limits, DiagnosticSink& sink);

}  // namespace sgm
