#pragma once
// Loads a file and what it imports, other files and assets, within the sandbox: below the root's folder, or the
// embedded standard library.

#include <string>
#include <string_view>
#include <vector>

#include "grammar/parse/parser.h"
#include "grammar/text/limits.h"
#include "grammar/text/sink.h"

namespace sgm {

/// Why a path may not be imported; empty where it may. The rule is ImportResolver::read's.
std::string importPathComplaint(std::string_view path);

/// Whether a good path is an asset's.
bool isAssetPath(std::string_view path);

/// The path of `import`, written in the file `from`, as seen from the root's folder. Both are good paths.
std::string importedPath(std::string_view from, std::string_view import);

/// Parses the root (program.modules[0], text already there) and all it imports. Modules come out in the order in which
/// they are first named; a module or an asset that two files import is loaded once.
std::vector<ModuleSyntax> loadModules(Program& program, NameTable& names, const CompileOptions& options,
                                      DiagnosticSink& sink, std::vector<SourceFile>& files);

}  // namespace sgm
