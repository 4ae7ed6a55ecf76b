#pragma once
// The parser for one file: recursive descent.

#include <cstdint>

#include "grammar/syntax/name_table.h"
#include "grammar/syntax/program.h"
#include "grammar/syntax/syntax.h"
#include "grammar/text/limits.h"
#include "grammar/text/sink.h"

namespace sgm {

/// Parses the text of program.modules[module], and adds its comments, declarations and syntax tree to the program.
/// Reports errors and continues after them: ModuleSyntax tells which parts of the text failed to parse.
ModuleSyntax parseModule(Program& program, NameTable& names, uint32_t module, const CompileLimits& limits,
                         DiagnosticSink& sink);

}  // namespace sgm
