#pragma once
// Recursive descent over the text of one file.

#include <cstdint>

#include "grammar/syntax/name_table.h"
#include "grammar/syntax/program.h"
#include "grammar/syntax/syntax.h"
#include "grammar/text/limits.h"
#include "grammar/text/sink.h"

namespace sgm {

/// Parses program.modules[module], which has its text, and adds its comments, declarations and syntax tree to the
/// program. Continues after errors, which it reports: ModuleSyntax says what of the text is missing in the result.
ModuleSyntax parseModule(Program& program, NameTable& names, uint32_t module, const CompileLimits& limits,
                         DiagnosticSink& sink);

}  // namespace sgm
