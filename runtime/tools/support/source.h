#pragma once
// Reads and compiles a grammar file, and prints the compiler's messages.

#include <optional>
#include <string>

#include "grammar/check_file.h"
#include "tools/support/console.h"

namespace sgm::cli {

/// Reads a text of at most the size that the compiler accepts. Errors: io, limit.
Result<std::string> readGrammarText(const std::string& file);

/// Compiles a file; its imports are searched in its folder. Errors (io, limit) only if the file itself cannot be read:
/// errors in the text are diagnostics of the result.
Result<CompileResult> compileFile(const std::string& file);

/// As compileFile(), but also accepts a library, a file that has only rules for other files to import.
Result<CheckResult> checkFileOnDisk(const std::string& file);

/// Compiles a file as compileFile() does, and prints every message to stderr as "file:line:column: error: ..." with the
/// source line and a caret. If `program` is null, `status` is the exit status.
struct LoadedGrammar {
  std::shared_ptr<const Program> program;
  Exit status = Exit::done;
};
LoadedGrammar loadGrammar(const std::string& file);

}  // namespace sgm::cli
