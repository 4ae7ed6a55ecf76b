#pragma once
// Cuts without anything to cut from.

#include "grammar/syntax/program.h"
#include "grammar/text/sink.h"

namespace sgm {

/// Warns of cuts before which their block has nothing. follows: the statements of the body add to content before it.
/// Precondition: a checked body; StmtNode::layer_level is set.
void warnOfIdleCuts(const Program& program, StmtId body, bool follows, DiagnosticSink& sink);

}  // namespace sgm
