#pragma once
// Diagnostics of a grammar: the problem, its position and a hint. Plain values; safe to copy between threads.

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace sgm {

/// A range of text in one source file. Lines and columns count from 1, columns in bytes. end_column is one past the
/// last byte, on the line `end_line`. begin and end are byte offsets from the start of the file.
struct Span {
  uint32_t file = 0;  ///< index of the file in Program::modules (or CompileResult::files)
  uint32_t begin = 0, end = 0;
  int line = 0, column = 0;
  int end_line = 0, end_column = 0;
};

enum class Severity : uint8_t { error, warning };

struct Diagnostic {
  Severity severity = Severity::error;
  std::string code;     ///< stable kebab-case name, such as "unit-mismatch"; the list is in codes.h
  std::string message;  ///< one line, without a full stop at the end
  std::string file;     ///< file name as passed by the caller, or the path of an import
  int line = 0, column = 0, end_column = 0;
  std::string hint;                ///< a suggestion how to correct the text; may be empty
  std::vector<std::string> notes;  ///< related positions and facts, one line each
};

/// Returns "file:line:column: error: message", the source line, a line with a caret, the hint and the notes, each
/// ending with a line feed. source: the text of the diagnostic's file; if empty, source line and caret are omitted.
std::string renderDiagnostic(const Diagnostic& diagnostic, std::string_view source);

/// Returns a summary such as "1 error, 2 warnings".
std::string countDiagnostics(const std::vector<Diagnostic>& diagnostics);

}  // namespace sgm
