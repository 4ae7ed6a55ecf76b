#pragma once
// Loads a file and its imports (grammar files and assets). Imports may only come from below the root file's folder, or
// from the embedded standard library.

#include <string>
#include <string_view>
#include <vector>

#include "grammar/syntax/name_table.h"
#include "grammar/syntax/program.h"
#include "grammar/syntax/syntax.h"
#include "grammar/text/limits.h"
#include "grammar/text/sink.h"

namespace sgm {

/// Returns the reason why a path may not be imported; empty if it is valid. See ImportResolver::read for the rules.
std::string importPathProblem(std::string_view path);

/// Whether a valid path refers to an asset (.glb).
bool isAssetPath(std::string_view path);

/// Returns the path of `import`, which is written in the file `from`, relative to the root's folder. Precondition: both
/// paths are valid.
std::string importedPath(std::string_view from, std::string_view import);

/// Parses the root, whose text must be in program.modules[0], and all its imports. Modules are in the order in which
/// they are first imported; a file or asset that is imported several times is loaded once.
std::vector<ModuleSyntax> loadModules(Program& program, NameTable& names, const CompileOptions& options,
                                      DiagnosticSink& sink, std::vector<SourceFile>& files);

}  // namespace sgm
