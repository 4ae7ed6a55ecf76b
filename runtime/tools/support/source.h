#pragma once
// Reads and compiles a grammar file, and prints the compiler's messages.

#include <optional>
#include <string>

#include "grammar/check_file.h"
#include "tools/support/console.h"

namespace sgm::cli {

/// Reads a grammar file, up to the size that the compiler accepts. Errors: io, limit.
Result<std::string> readGrammarText(const std::string& file);

/// Compiles a grammar file; its imports are read from its directory. Errors: io or limit if the file cannot be read.
/// Errors in the grammar itself are in the diagnostics of the result.
Result<CompileResult> compileFile(const std::string& file);

/// Like compileFile(), but also accepts a library: a file that contains only rules for other files to import.
Result<CheckResult> checkFileOnDisk(const std::string& file);

/// The result of loadGrammar(), which compiles a file like compileFile() and prints all messages to stderr, each with
/// its source line and a caret. After an error, `program` is null and `status` is the exit status.
struct LoadedGrammar {
  std::shared_ptr<const Program> program;
  Exit status = Exit::done;
};
LoadedGrammar loadGrammar(const std::string& file);

}  // namespace sgm::cli
