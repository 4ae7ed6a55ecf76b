#pragma once
// A grammar file, read and compiled, with its messages.

#include <optional>
#include <string>

#include "grammar/check_file.h"
#include "tools/support/console.h"

namespace sgm::cli {

/// Reads a text of at most the compiler's own limit. Errors: io, limit.
Result<std::string> readGrammarText(const std::string& file);

/// Compiles the file; imports come from its folder. Errors (io, limit) only if the file itself cannot be read: problems
/// in the text are in the diagnostics.
Result<CompileResult> compileFile(const std::string& file);

/// The same for a file that may be a library for others to import.
Result<CheckResult> checkFileOnDisk(const std::string& file);

/// As compileFile, but prints every message to stderr as "file:line:column: error: ..." with the line and a caret.
/// Without a program, `status` is the exit status.
struct LoadedGrammar {
  std::shared_ptr<const Program> program;
  Exit status = Exit::done;
};
LoadedGrammar loadGrammar(const std::string& file);

}  // namespace sgm::cli
