#pragma once
// Loads a file and its imports, files and assets, within the sandbox: below the root's folder, or from the embedded
// standard library.

#include <string>
#include <string_view>
#include <vector>

#include "grammar/syntax/name_table.h"
#include "grammar/syntax/program.h"
#include "grammar/syntax/syntax.h"
#include "grammar/text/limits.h"
#include "grammar/text/sink.h"

namespace sgm {

/// The reason why a path may not be imported; empty if it may. The rule is that of ImportResolver::read.
std::string importPathComplaint(std::string_view path);

/// Whether a valid path is that of an asset.
bool isAssetPath(std::string_view path);

/// The path of `import`, written in the file `from`, relative to the root's folder. Precondition: both are valid paths.
std::string importedPath(std::string_view from, std::string_view import);

/// Parses the root (program.modules[0], with its text) and all its imports. Modules are in the order of their first
/// mention; a module or an asset that two files import is loaded once.
std::vector<ModuleSyntax> loadModules(Program& program, NameTable& names, const CompileOptions& options,
                                      DiagnosticSink& sink, std::vector<SourceFile>& files);

}  // namespace sgm
