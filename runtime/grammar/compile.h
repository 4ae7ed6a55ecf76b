#pragma once
// Text to Program: the front door of the language. Grammar text is untrusted: size, depth, count and time are capped.

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "grammar/syntax/program.h"
#include "grammar/text/diagnostics.h"
#include "grammar/text/limits.h"

namespace sgm {

/// The program is there exactly where no diagnostic is an error. Diagnostics are in order of file and place.
struct CompileResult {
  std::shared_ptr<const Program> program;
  std::vector<Diagnostic> diagnostics;
  std::vector<SourceFile> files;  ///< what was read, for renderDiagnostic
};

/// Thread-safe: no state is kept between calls. `path` is only for messages. May throw std::bad_alloc.
CompileResult compileGrammar(std::string_view text, std::string_view path, const CompileOptions& options = {});

/// `sgm fmt`: the canonical layout of one file, comments kept; a fixed point. Needs correct syntax only.
struct FormatResult {
  std::optional<std::string> text;
  std::vector<Diagnostic> diagnostics;
};
FormatResult formatGrammar(std::string_view text, std::string_view path, const CompileLimits& limits = {});

/// All diagnostics of a result, rendered one after another.
std::string renderDiagnostics(const CompileResult& result);

}  // namespace sgm
