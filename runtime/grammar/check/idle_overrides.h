#pragma once
// Overrides of uses that never occur.

#include "grammar/syntax/program.h"
#include "grammar/text/sink.h"

namespace sgm {

/// Warns of overrides of a use that the rule before it in the path never derives. Precondition: Rule::overrides is
/// complete.
void warnOfIdleOverrides(const Program& program, DiagnosticSink& sink);

}  // namespace sgm
