#pragma once
// Compiles text to a Program. Grammar text is untrusted: size, depth, count and time are limited.

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "grammar/syntax/program.h"
#include "grammar/text/diagnostics.h"
#include "grammar/text/limits.h"

namespace sgm {

/// The program exists exactly if no diagnostic is an error. Diagnostics are in order of file and place.
struct CompileResult {
  std::shared_ptr<const Program> program;
  std::vector<Diagnostic> diagnostics;
  std::vector<SourceFile> files;  ///< the files read, for renderDiagnostic
};

/// Thread-safe: no state is kept between calls. `path` is only for messages. May throw std::bad_alloc.
CompileResult compileGrammar(std::string_view text, std::string_view path, const CompileOptions& options = {});

/// `sgm fmt`: the canonical layout of one file, with its comments; formatting it again changes nothing. Needs only
/// correct syntax.
struct FormatResult {
  std::optional<std::string> text;
  std::vector<Diagnostic> diagnostics;
};
FormatResult formatGrammar(std::string_view text, std::string_view path, const CompileLimits& limits = {});

/// All diagnostics of a result, rendered one after another.
std::string renderDiagnostics(const CompileResult& result);

}  // namespace sgm
