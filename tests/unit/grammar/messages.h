#pragma once
// Converts the compiler's diagnostics to text, for tests that compare every message word for word.

#include <span>
#include <string>

#include "catch.h"
#include "compile_text.h"

namespace sgm::test {

/// All diagnostics, one on each line: "3:17 unit-mismatch: message | hint | note: note"; warnings contain the word
/// "warning".
inline std::string inWords(const CompileResult& result) {
  std::string out;
  for (const Diagnostic& d : result.diagnostics) {
    if (!out.empty()) out += '\n';
    out.append(std::to_string(d.line)).append(":").append(std::to_string(d.column)).append(" ");
    out.append(d.severity == Severity::warning ? "warning " : "").append(d.code).append(": ").append(d.message);
    if (!d.hint.empty()) out.append(" | ").append(d.hint);
    for (const std::string& note : d.notes) out.append(" | note: ").append(note);
  }
  return out;
}

/// Whether a diagnostic says what to write instead: it has a hint, or names what the parser expected.
inline bool saysWhatToWrite(const Diagnostic& d) { return !d.hint.empty() || d.message.starts_with("expected "); }

struct MessageCase {
  const char* expected;  ///< expected diagnostics in the form of inWords()
  const char* text;
};

/// Text that every case has before and after its own text.
struct Around {
  std::string before, after;
};

inline void checkMessages(std::span<const MessageCase> cases, const Around& around = {}) {
  for (const MessageCase& c : cases) {
    const CompileResult result = compileText(around.before + c.text + around.after);
    INFO(renderDiagnostics(result));
    CHECK(inWords(result) == c.expected);
    for (const Diagnostic& d : result.diagnostics) {
      CHECK(saysWhatToWrite(d));
      CHECK(d.end_column > d.column);
    }
  }
}

}  // namespace sgm::test
