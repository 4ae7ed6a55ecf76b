#pragma once
// Warns of overrides whose target never occurs.

#include "grammar/syntax/program.h"
#include "grammar/text/sink.h"

namespace sgm {

/// Warns of override paths with a step that the rule of the previous step never derives. Precondition: Rule::overrides
/// is complete.
void warnOfIdleOverrides(const Program& program, DiagnosticSink& sink);

}  // namespace sgm
