#pragma once
// Warns of cuts that have no effect, because no content precedes them.

#include "grammar/syntax/program.h"
#include "grammar/text/sink.h"

namespace sgm {

/// Warns of each cut in `body` that has no preceding content in its block. follows: true if content precedes the whole
/// body, so that even a cut at its beginning has an effect. Precondition: the body is checked and StmtNode::layer_level
/// is set.
void warnOfIdleCuts(const Program& program, StmtId body, bool follows, DiagnosticSink& sink);

}  // namespace sgm
