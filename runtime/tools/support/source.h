#pragma once
// A grammar file, read and compiled, with its messages.

#include <optional>
#include <string>

#include "grammar/check_file.h"
#include "tools/support/console.h"

namespace sgm::cli {

/// Reads a text of at most the compiler's own limit. Errors: io, limit.
Result<std::string> readGrammarText(const std::string& file);

/// Compiles the file; imports come from its folder. Error (io, limit) only where the file itself cannot be read: what
/// is wrong in the text stands in the diagnostics.
Result<CompileResult> compileFile(const std::string& file);

/// The same of a file that may be a library for others to import.
Result<CheckResult> checkFileOnDisk(const std::string& file);

/// As compileFile, and prints every message to stderr as "file:line:column: error: ..." with the line and a caret. The
/// status to end with where there is no program.
struct LoadedGrammar {
  std::shared_ptr<const Program> program;
  Exit status = Exit::done;
};
LoadedGrammar loadGrammar(const std::string& file);

}  // namespace sgm::cli
