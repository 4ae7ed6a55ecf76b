#pragma once
// Compiles grammar text to a Program. The text is untrusted: its size, nesting, number of nodes and compile time are
// limited.

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "grammar/syntax/program.h"
#include "grammar/text/diagnostics.h"
#include "grammar/text/limits.h"

namespace sgm {

/// program: null if and only if a diagnostic is an error. Diagnostics are sorted by file and position.
struct CompileResult {
  std::shared_ptr<const Program> program;
  std::vector<Diagnostic> diagnostics;
  std::vector<SourceFile> files;  ///< all files that were read, for renderDiagnostic()
};

/// Thread-safe: no state is kept between calls. path: file name for messages; not opened. May throw std::bad_alloc.
CompileResult compileGrammar(std::string_view text, std::string_view path, const CompileOptions& options = {});

/// Result of `sgm fmt`: one file in canonical layout, with its comments. Formatting is idempotent and needs only
/// correct syntax. text: nullopt after a syntax error.
struct FormatResult {
  std::optional<std::string> text;
  std::vector<Diagnostic> diagnostics;
};
FormatResult formatGrammar(std::string_view text, std::string_view path, const CompileLimits& limits = {});

/// Returns all diagnostics of a result, rendered and concatenated.
std::string renderDiagnostics(const CompileResult& result);

}  // namespace sgm
